#include "assets/plan/rails.h"

#include <algorithm>
#include <cmath>

#include "assets/colour.h"
#include "assets/plan/roofs.h"

namespace flaneur {

namespace {

constexpr float k_gauge = 1.435f, k_rail = 0.07f, k_rail_height = 0.12f;  // metres
constexpr float k_look = 0.5f;  // where what lies below the rails is looked at, metres

// A rail from a to b, on ballast.
void add_rail(City& city, Vec3 a, Vec3 b, uint32_t building) {
    Vec2 along = normalize_or(on_ground(b) - on_ground(a), {1, 0});
    Vec3 side = at_height(Vec2{-along.z, along.x} * (k_rail * 0.5f), 0), up{0, k_rail_height, 0};
    Vec3 al = a - side, ar = a + side, bl = b - side, br = b + side;
    add_quad(city, al + up, ar + up, br + up, bl + up, building);
    add_quad(city, ar, br, br + up, ar + up, building);
    add_quad(city, bl, al, al + up, bl + up, building);
}

// One rail along a straight piece of track: upright where there is ballast below it, flush in what people
// walk on, and nowhere else.
void lay_rail(City& city, Vec3 a, Vec3 b, uint32_t building) {
    enum class Bed { none, ballast, street };
    float whole = length(on_ground(b) - on_ground(a));
    int steps = std::max(1, static_cast<int>(std::ceil(whole / k_look)));
    auto at = [&](int i) { return lerp(a, b, static_cast<float>(i) / static_cast<float>(steps)); };
    auto look = [&](int i, float& height) {
        Vec3 p = (at(i) + at(i + 1)) * 0.5f;
        std::optional<GroundHit> hit = ground_at(city.ground, p, 0.6f, 0.6f);
        if (!hit) return Bed::none;
        height = hit->height - p.y;  // above the straight line
        return hit->kind == Surface::track ? Bed::ballast : Bed::street;
    };
    for (int from = 0; from < steps;) {
        float off = 0;
        Bed bed = look(from, off);
        int to = from + 1;
        for (float here = 0; to < steps && look(to, here) == bed && std::fabs(here - off) < 0.02f;) ++to;
        Vec3 p = at(from), q = at(to);
        p.y += off, q.y += off;
        if (bed == Bed::ballast) add_rail(city, p, q, building);
        if (bed == Bed::street) city.grooves.push_back({p, q});
        from = to;
    }
}

}  // namespace

void lay_rails(Rails& rails, Vec3 a, Vec3 b) {
    if (rails.steel == ~0u) {
        rails.steel = static_cast<uint32_t>(rails.city.buildings.size());
        Building steel;
        steel.top = 1;
        steel.roof_colour = rgb(0x9a8f84);
        rails.city.buildings.push_back(steel);
    }
    Vec2 along = normalize_or(on_ground(b) - on_ground(a), {1, 0});
    Vec3 off = at_height(Vec2{along.z, -along.x} * (k_gauge * 0.5f), 0);
    for (float side : {-1.0f, 1.0f}) lay_rail(rails.city, a + off * side, b + off * side, rails.steel);
}

}  // namespace flaneur
