// What hangs on fronts and stands on roofs.
#include <algorithm>
#include <cmath>

#include "assets/district/district.h"
#include "assets/plan/roofs.h"
#include "sim/base/math.h"

namespace flaneur {

namespace {

// A front as those see it who stand before it.
struct DressedWall {
    Vec2 left, along, out;
    float width;

    DressedWall(Vec2 a, Vec2 b) : left(b), along(normalize_or(a - b, {1, 0})), width(length(a - b)) {
        out = {-along.z, along.x};
    }
    Vec3 at(float right, float ahead, float y) const {
        return at_height(left + along * right + out * ahead, y);
    }
};

// A window in the roof: its front, cheeks and top.
void add_dormer(City& city, const DressedWall& wall, float middle, float back, float depth, float y,
                uint32_t building) {
    constexpr float k_half = 0.85f, k_height = 1.75f;
    Vec3 a = wall.at(middle - k_half, -back, y), b = wall.at(middle + k_half, -back, y);
    city.ground.faces.push_back({a, b, y + k_height, y + k_height, FaceKind::facade, building});
    float top = y + k_height, ridge = top + 0.45f;
    Vec3 al = wall.at(middle - k_half, -back, top), bl = wall.at(middle + k_half, -back, top);
    Vec3 ar = wall.at(middle - k_half, -back - depth, top), br = wall.at(middle + k_half, -back - depth, top);
    add_quad(city, wall.at(middle - k_half, -back - depth, y), a, al, ar, building);
    add_quad(city, b, wall.at(middle + k_half, -back - depth, y), br, bl, building);
    Vec3 front = wall.at(middle, -back + 0.15f, ridge), rear = wall.at(middle, -back - depth, ridge);
    Vec3 eaves_a = wall.at(middle - k_half - 0.12f, -back + 0.15f, top - 0.05f),
         eaves_b = wall.at(middle + k_half + 0.12f, -back + 0.15f, top - 0.05f);
    add_quad(city, eaves_a, front, rear, wall.at(middle - k_half - 0.12f, -back - depth, top - 0.05f),
             building);
    add_quad(city, front, eaves_b, wall.at(middle + k_half + 0.12f, -back - depth, top - 0.05f), rear,
             building);
    auto first = static_cast<uint32_t>(city.roof_vertices.size());
    city.roof_vertices.insert(city.roof_vertices.end(), {eaves_a, eaves_b, front});
    city.roof_indices.insert(city.roof_indices.end(), {first, first + 1, first + 2});
    city.roof_buildings.push_back(building);
}

// A slab with a low wall around it.
void add_balcony(City& city, const DressedWall& wall, float from, float to, float y, uint32_t slab,
                 uint32_t rail) {
    constexpr float k_deep = 0.95f, k_slab = 0.16f, k_rail = 0.92f, k_thick = 0.07f;
    Vec2 middle = wall.left + wall.along * ((from + to) * 0.5f);
    float half = (to - from) * 0.5f;
    add_box(city, at_height(middle + wall.out * (k_deep * 0.5f), y - k_slab), wall.along,
            {half, k_deep * 0.5f}, k_slab, slab);
    add_quad(city, wall.at(from, 0, y - k_slab), wall.at(to, 0, y - k_slab), wall.at(to, k_deep, y - k_slab),
             wall.at(from, k_deep, y - k_slab), slab);
    add_box(city, at_height(middle + wall.out * (k_deep - k_thick * 0.5f), y), wall.along,
            {half, k_thick * 0.5f}, k_rail, rail);
    for (float end : {from + k_thick * 0.5f, to - k_thick * 0.5f}) {
        add_box(city, at_height(wall.left + wall.along * end + wall.out * (k_deep * 0.5f), y), wall.along,
                {k_thick * 0.5f, k_deep * 0.5f}, k_rail, rail);
    }
}

void add_awning(City& city, const DressedWall& wall, float from, float to, float foot, uint32_t cloth) {
    constexpr float k_high = 3.0f, k_low = 2.55f, k_out = 1.25f, k_hem = 0.2f;
    Vec3 a = wall.at(from, 0.02f, foot + k_high), b = wall.at(to, 0.02f, foot + k_high);
    Vec3 c = wall.at(to, k_out, foot + k_low), e = wall.at(from, k_out, foot + k_low);
    Vec3 ch = c - Vec3{0, k_hem, 0}, eh = e - Vec3{0, k_hem, 0};
    add_quad(city, a, e, c, b, cloth);
    add_quad(city, a, b, c, e, cloth);
    add_quad(city, e, eh, ch, c, cloth);
    add_quad(city, e, c, ch, eh, cloth);
}

// How far a pitched roof of a house `width` wide and `depth` deep rises above its eaves, `right` and `back`
// metres from the corner of its front.
float rise(const House& house, float width, float depth, float right, float back) {
    float aside = std::min(right, width - right), behind = std::min(back, depth - back);
    float ridge = std::min(width, depth) * 0.5f, from_edge = std::min(aside, behind);
    if (house.roof == RoofKind::gable) {
        ridge = (house.gable_across ? width : depth) * 0.5f;
        from_edge = house.gable_across ? aside : behind;
    }
    return house.roof_height * std::min(from_edge / ridge, 1.0f);
}

// An upright box as of add_box, where all of its foot is over the house.
void add_on_roof(City& city, const House& house, Vec3 foot, Vec2 along, Vec2 half, float height,
                 uint32_t building) {
    Vec2 at = on_ground(foot), u = along * half.x, v = Vec2{-along.z, along.x} * half.z;
    Ring box =
        positive({to_point(at - u - v), to_point(at + u - v), to_point(at + u + v), to_point(at - u + v)});
    if (area(subtract({box}, {house.footprint})) < 0.01) add_box(city, foot, along, half, height, building);
}

}  // namespace

void dress_roof(District& d, Dice& dice, const House& house, uint32_t building, Vec2 a, Vec2 b, float depth) {
    DressedWall wall(a, b);
    float eaves = d.city.buildings[building].top;
    bool pitched = house.roof == RoofKind::gable || house.roof == RoofKind::hip;
    if (pitched) {
        int chimneys = 1 + dice.pick(2);
        for (int i = 0; i < chimneys; ++i) {
            float in = house.roof == RoofKind::hip ? 0.26f * wall.width : 0.06f * wall.width + 0.5f;
            float right = i == 0 ? in : wall.width - in, back = depth * dice.between(0.35f, 0.6f);
            float sunk = std::max(rise(house, wall.width, depth, right, back) - 0.8f, 0.0f);
            add_on_roof(d.city, house, wall.at(right, -back, eaves + sunk), wall.out, {0.75f, 0.33f},
                        house.roof_height + 0.9f - sunk, building);
        }
    }
    bool takes_dormers =
        house.roof == RoofKind::mansard || (house.roof == RoofKind::gable && !house.gable_across);
    if (takes_dormers && wall.width > 5 && dice.chance(0.75f)) {
        float bays = std::max(1.0f, std::floor(wall.width / 2.7f + 0.5f)), bay = wall.width / bays;
        bool every = house.roof == RoofKind::mansard && dice.chance(0.4f);
        float steep = pitched ? house.roof_height / (depth * 0.5f) : 1 / 0.55f;
        float back = pitched ? 1.0f : 0.3f, y = eaves + steep * back - (pitched ? 0.15f : 0.2f);
        for (float i = 0; i < bays; i += 1) {
            bool end = i < 1 || i > bays - 1.5f;
            if (end && (house.roof == RoofKind::mansard || bays > 3)) continue;
            if (!every && static_cast<int>(i) % 2 == 0) continue;
            add_dormer(d.city, wall, (i + 0.5f) * bay, back, pitched ? 1.9f / steep + 0.3f : 1.6f, y,
                       building);
        }
    }
    if (pitched) return;
    float floor = eaves + (house.roof == RoofKind::mansard ? house.roof_height : 0);
    float aside = dice.between(0.35f, 0.65f), share = dice.between(0.45f, 0.6f);
    Vec2 half{dice.between(1, 1.8f), dice.between(0.9f, 1.4f)};
    float height = dice.between(1.6f, 2.4f);
    if (wall.width > 6)
        add_on_roof(d.city, house, wall.at(aside * wall.width, -depth * share, floor), wall.along, half,
                    height, building);
    add_on_roof(d.city, house, wall.at(0.5f, -depth * 0.55f, floor - 0.2f), wall.out, {0.7f, 0.3f}, 1.7f,
                building);
}

void dress_front(District& d, Dice& dice, const House& house, float foot, Vec2 a, Vec2 b) {
    DressedWall wall(a, b);
    float bays = std::max(1.0f, std::floor(wall.width / 2.7f + 0.5f)), bay = wall.width / bays;
    uint32_t stone = trim(d, Trim::stone), metal = trim(d, Trim::metal);
    float manner = dice.unit();
    int floors = static_cast<int>(house.eaves / house.storey);
    if (house.shop) {
        auto cloth = trim(d, static_cast<Trim>(static_cast<int>(Trim::burgundy) + dice.pick(4)));
        float door = std::floor(bays * 0.5f);
        for (float i = 0; i < bays; i += 1) {
            bool drawn = dice.chance(0.6f);
            if (i == door || !drawn || manner < 0.35f) continue;
            add_awning(d.city, wall, (i + 0.06f) * bay, (i + 0.94f) * bay, foot, cloth);
        }
    }
    if (floors < 4 || bays < 3) return;
    if (manner > 0.72f) {
        // One long balcony on the second floor and perhaps one under the eaves.
        for (int storey : {2, floors - 1}) {
            if (storey > 2 && (manner < 0.86f || storey < 4)) continue;
            add_balcony(d.city, wall, 0.6f, wall.width - 0.6f,
                        foot + static_cast<float>(storey) * house.storey, stone, metal);
        }
    } else if (manner > 0.5f) {
        float middle = std::floor(bays * 0.5f);
        for (int storey = 1; storey < floors; ++storey) {
            for (float i : {middle - 1, middle + 1}) {
                if (i < 0 || i > bays - 1) continue;
                add_balcony(d.city, wall, (i + 0.12f) * bay, (i + 0.88f) * bay,
                            foot + static_cast<float>(storey) * house.storey, stone, stone);
            }
        }
    }
}

}  // namespace flaneur
