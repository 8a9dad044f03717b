#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "sim/base/math.h"
#include "sim/base/parallel_for.h"
#include "tools/extract/convert.h"
#include "tools/extract/extract.h"
#include "tools/extract/parts.h"

namespace flaneur {

namespace {

constexpr float k_texel = 0.5f;        // metres, in cities of up to so many texels
constexpr float k_most_texels = 2048;  // along an edge
constexpr float k_reach = 4;           // of a lamp, times its height
constexpr float k_body = 1.0f;         // above the ground, where light on walls and people is taken, metres
constexpr float k_into_walls = 0.9f;   // metres that light goes on in them, for pictures between texels
constexpr float k_shop_height = 1.5f, k_shop_reach = 9;  // metres
constexpr float k_shop_light = 1.3f;                     // of a bay, at one metre

constexpr float k_unseen_height = 6, k_unseen_apart = 30, k_before_houses = 2.5f;  // metres

struct Source {
    Vec3 at;
    Vec3 out;            // a shop's light goes out of its wall; zero: all round
    float reach, light;  // metres; at one metre
};

Vec3 outwards(const Face& f) {
    Vec2 along = on_ground(f.b) - on_ground(f.a);
    return at_height(normalize_or(Vec2{-along.z, along.x}, {1, 0}), 0);
}

// Places in squares, of which those about another are soon found.
struct PlacesNear {
    static constexpr float k_side = 32;  // at least as long as what is near; a power of two divides exactly
    std::map<std::pair<int, int>, std::vector<Vec2>> squares;

    static int square(float v) { return static_cast<int>(std::floor(v / k_side)); }
    void add(Vec2 p) { squares[{square(p.x), square(p.z)}].push_back(p); }
    bool any_within(float distance, Vec2 of) const {
        for (int x = square(of.x) - 1; x <= square(of.x) + 1; ++x) {
            for (int z = square(of.z) - 1; z <= square(of.z) + 1; ++z) {
                auto found = squares.find({x, z});
                if (found == squares.end()) continue;
                for (Vec2 p : found->second)
                    if (length_squared(p - of) < distance * distance) return true;
            }
        }
        return false;
    }
};
static_assert(PlacesNear::k_side >= k_unseen_apart);

std::vector<Source> sources_of(const City& city) {
    std::vector<Source> sources;
    PlacesNear lamps;
    auto hang = [&](Vec3 head, float height) {
        sources.push_back({head, {}, k_reach * height, height * height});
        lamps.add(on_ground(head));
    };
    for (const Prop& prop : city.props) {
        if (prop.kind != PropKind::lamp) continue;
        Vec3 head = prop.position + at_height(heading_direction(prop.yaw) * 0.55f, prop.height);
        hang(head, prop.height);
    }
    // Where none are known they hang unseen over the kerb, and over what is paved before houses.
    for (const Face& f : city.ground.faces) {
        if (f.kind != FaceKind::kerb && f.kind != FaceKind::facade) continue;
        Vec3 head = lerp(f.a, f.b, 0.5f);
        if (f.kind == FaceKind::facade) {
            head = head + outwards(f) * k_before_houses;
            std::optional<GroundHit> hit = ground_at(city.ground, head, 1, 1);
            if (!hit || hit->kind == Surface::grass || !is_walked(hit->kind)) continue;
        }
        head.y += k_unseen_height;
        if (!lamps.any_within(k_unseen_apart, on_ground(head))) hang(head, k_unseen_height);
    }
    for (const Face& f : city.ground.faces) {
        if (f.kind != FaceKind::facade || !is_shop_front(city, f)) continue;
        Vec2 along = on_ground(f.b) - on_ground(f.a);
        Vec3 out = outwards(f);
        int bays = static_cast<int>(length(along) / k_bay);
        for (int i = 0; i < bays; ++i) {
            float share = (static_cast<float>(i) + 0.5f) / static_cast<float>(bays);
            Vec2 at = on_ground(f.a) + along * share + on_ground(out) * 0.1f;
            float foot = city.buildings[f.building].base;
            sources.push_back({at_height(at, foot + k_shop_height), out, k_shop_reach, k_shop_light});
        }
    }
    return sources;
}

// Illuminance of a surface at `from` that faces the source, and the way there.
struct Arriving {
    Vec3 towards;
    float light;
};
Arriving arriving(const Source& source, Vec3 from) {
    Vec3 way = source.at - from;
    float distance = std::max(length(way), 0.5f);
    Vec3 towards = way / distance;
    float fade = std::max(1 - distance * distance / (source.reach * source.reach), 0.0f);
    // Street lamps are made to throw more light far out than straight down.
    float spread = length_squared(source.out) > 0 ? std::max(-dot(towards, source.out), 0.0f)
                                                  : clamp(towards.y * 4, 0, 1) / std::max(towards.y, 0.35f);
    return {towards, source.light * spread * fade * fade / (distance * distance)};
}

bool is_lit(const City& city, const Source& source, Vec3 from) {
    Vec3 way = from - source.at;
    float distance = length(way), reach = distance - k_into_walls;
    return reach <= 0 || !raycast(city.ground, source.at, way / distance, reach);
}

}  // namespace

LampMap extract_lamps(const City& city) {
    LampMap map;
    const std::vector<Source> sources = sources_of(city);
    if (sources.empty()) return map;
    Vec2 size = city.ground.high - city.ground.low;
    map.texel = std::max(k_texel, std::max(size.x, size.z) / k_most_texels);
    map.low = {city.ground.low.x, city.ground.low.z};
    map.width = static_cast<uint32_t>(size.x / map.texel) + 1;
    map.height = static_cast<uint32_t>(size.z / map.texel) + 1;
    map.texels.assign(size_t{map.width} * map.height, glm::vec4(0));
    auto fill_row = [&](size_t row) {
        float z = map.low.y + (static_cast<float>(row) + 0.5f) * map.texel;
        std::vector<float> nearest(map.width, 1e9f);
        for (const Source& source : sources) {
            float dz = z - source.at.z, half = source.reach * source.reach - dz * dz;
            if (half <= 0) continue;
            half = std::sqrt(half);
            auto column = [&](float x) {
                return static_cast<size_t>(
                    clamp((x - map.low.x) / map.texel, 0, static_cast<float>(map.width)));
            };
            for (size_t i = column(source.at.x - half), end = column(source.at.x + half); i < end; ++i) {
                float x = map.low.x + (static_cast<float>(i) + 0.5f) * map.texel;
                glm::vec4& texel = map.texels[row * map.width + i];
                std::optional<GroundHit> hit = ground_at(city.ground, {x, source.at.y, z}, 0, 12);
                Vec3 foot{x, hit ? hit->height : source.at.y - 4, z};
                Vec3 body = foot + Vec3{0, k_body, 0};
                Arriving level = arriving(source, foot), upright = arriving(source, body);
                if (level.light + upright.light < 1e-3f || !is_lit(city, source, body)) continue;
                // Light that walls throw must not take from what they get themselves: it counts away from
                // them.
                bool is_shop = length_squared(source.out) > 0;
                float share = is_shop ? clamp((dot(body - source.at, source.out) - 0.7f) / 0.6f, 0, 1) : 1;
                texel.x += upright.light * upright.towards.x * share;
                texel.y += level.light * level.towards.y;
                texel.z += upright.light * upright.towards.z * share;
                float distance = length(source.at - foot);
                if (distance < nearest[i]) nearest[i] = distance, texel.w = foot.y;
            }
        }
    };
    WorkersPtr workers = make_workers(0);
    parallel_for(*workers, map.height, 8, [&](size_t begin, size_t end, int) {
        for (size_t row = begin; row < end; ++row) fill_row(row);
    });
    return map;
}

}  // namespace flaneur
