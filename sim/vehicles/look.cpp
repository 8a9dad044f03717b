// What those who drive see: people and vehicles on their way.
#include <algorithm>
#include <cmath>

#include "sim/base/spans.h"
#include "sim/crowd/places.h"
#include "sim/vehicles/drive.h"

namespace flaneur {

namespace {

constexpr float k_step = 1;  // metres of its way, between places that are looked at
constexpr float k_beside_people = 0.3f,
                k_beside_pavement = 0.06f;  // metres to each side: of those on it, off it
constexpr float k_beside_boxes = 0.12f, k_beside_bicycles = 0.9f;
constexpr float k_short = 2.5f, k_same_way = 0.6f;  // metres, of a bicycle; cosine
constexpr float k_level = 2.5f;
constexpr int k_most_people = 96, k_most_boxes = 32;
constexpr float k_foresees[] = {0, 0.45f, 0.9f, 1.4f};  // seconds that people go on as they go

struct Seeing {
    struct Person {
        Vec2 at, velocity;
        float radius, beside;
        uint32_t id;
    } people[k_most_people];
    int person_count = 0;
    uint32_t boxes[k_most_boxes];
    int box_count = 0;
};

// Those on the carriageway, or so near that one of its sections touches them.
void find_people(const Crowd& c, std::span<const VehicleBox> sections, Vec3 middle, float reach,
                 Seeing& out) {
    const Roadway& r = c.roadway;
    auto add = [&](Vec2 at, Vec2 velocity, float radius, bool is_on, uint32_t id) {
        const float beside = is_on ? k_beside_people : k_beside_pavement;
        if (out.person_count < k_most_people)
            out.people[out.person_count++] = {at, velocity, radius, beside, id};
    };
    for_seen_near(c.scratch, middle, reach, [&](uint32_t begin, uint32_t end) {
        for (uint32_t k = begin; k < end; ++k) {
            const Seen& seen = c.scratch.seen.all[k];
            const Vec2 at = on_ground(seen.position), from = at - on_ground(middle);
            if (length_squared(from) > reach * reach || std::fabs(seen.position.y - middle.y) > k_level)
                continue;
            const uint32_t square = square_of(r.map->raster, at);
            const bool is_on =
                square != RoadRaster::k_nowhere && r.map->raster.what[square] != RoadRaster::k_off;
            if (!is_on && std::ranges::none_of(
                              sections, [&](const VehicleBox& box) { return off_box(box, at).far <= 1.5f; }))
                continue;
            const Vec2 velocity = is_on ? c.motion.velocity[seen.id] : Vec2{};
            add(at, velocity, seen.radius, is_on, seen.id);
            if (seen.ahead != Vec2{}) add(at + seen.ahead, velocity, k_pram_radius, is_on, seen.id);
            if (c.downed.empty() || !is_down(c, seen.id)) continue;
            for (const LyingPart& part : own_of(c.downed, seen.id)->parts)
                if (part.radius > 0) add(at + part.from, {}, part.radius, true, seen.id);
        }
    });
}

bool is_swept(const Seeing::Person& p, const OnLane& at, float half_width) {
    const Vec2 to_left{at.along.z, -at.along.x};
    for (const float seconds : k_foresees) {
        const Vec2 from = p.at + p.velocity * seconds - on_ground(at.at);
        const float ahead = dot(from, at.along), left = dot(from, to_left);
        if (std::fabs(ahead) < k_step / 2 + p.radius && std::fabs(left) < half_width + p.radius + p.beside)
            return true;
    }
    return false;
}

// Whether one is where a section that follows will come, which in bends is inside of what the first one
// swept.
bool is_cut_off(const Seeing::Person& p, const OnLane& at, float half_width) {
    const Vec2 from = p.at - on_ground(at.at);
    return std::fabs(dot(from, at.along)) < k_step / 2 + p.radius &&
           std::fabs(cross(at.along, from)) < half_width + p.radius + k_beside_pavement;
}

// Metres that the middle of a section is inside of a bend there.
float throws(const Lanes& lanes, const Vehicle& v, float on) {
    const float half = shape_of(v).length / static_cast<float>(sections_of(v)) / 2;
    const Vec2 a = on_ground(ahead_of(lanes, v, on - half).at),
               b = on_ground(ahead_of(lanes, v, on + half).at);
    return length(lerp(a, b, 0.5f) - on_ground(ahead_of(lanes, v, on).at));
}

// Who is beside the sections that follow, on the inner side of a bend: as if so near before it that it creeps
// on, at 0.5 m/s, and people get off.
Ahead look_back(const Seeing& see, const Lanes& lanes, const Vehicle& v) {
    constexpr float k_bends = 0.03f, k_close = 1.5f;  // metres
    for (float on = -shape_of(v).length; on < 0; on += k_step) {
        const float inside = throws(lanes, v, on);
        if (inside < k_bends) continue;
        const OnLane at = ahead_of(lanes, v, on);
        for (int k = 0; k < see.person_count; ++k)
            if (is_cut_off(see.people[k], at, shape_of(v).width / 2 + inside))
                return {k_close, 0, Brakes::people, see.people[k].id};
    }
    return {};
}

}  // namespace

Ahead look_ahead(const Vehicles& vs, const Crowd& c, uint32_t number, float far) {
    const Vehicle& v = vs.all[number];
    const VehicleShape& shape = k_vehicle_shapes[static_cast<size_t>(v.kind)];
    const Roadway& r = c.roadway;
    const Lanes& lanes = vs.map->lanes;
    const std::span own(&r.boxes[vs.shown_as[number]], sections_of(v));
    const bool has_sections = own.size() > 1;
    const Vec3 middle = ahead_of(lanes, v, far / 2).at;
    Seeing see;
    if (has_sections)
        find_people(c, own, ahead_of(lanes, v, (far - shape.length) / 2).at, (far + shape.length) / 2 + 4,
                    see);
    else
        find_people(c, own, middle, far / 2 + 4, see);
    for_boxes_near(r, on_ground(middle), far / 2 + 3, [&](uint32_t k) {
        if (r.numbers[k] != number && see.box_count < k_most_boxes &&
            std::fabs(r.boxes[k].y - middle.y) < k_level)
            see.boxes[see.box_count++] = k;
    });
    if (see.person_count == 0 && see.box_count == 0) return {};
    Ahead found;
    if (has_sections && see.person_count > 0) found = look_back(see, lanes, v);
    for (float on = k_step / 2; on < far && found.why == Brakes::no; on += k_step) {
        const OnLane at = ahead_of(lanes, v, on);
        const float half = shape.width / 2 + (has_sections ? throws(lanes, v, on) : 0);
        for (int k = 0; k < see.person_count; ++k) {
            const Seeing::Person& p = see.people[k];
            if (!is_swept(p, at, half)) continue;
            const float speed = std::max(dot(p.velocity, at.along), 0.0f);
            found = {std::max(on - k_step / 2 - p.radius, 0.0f), speed, Brakes::people, p.id};
        }
        VehicleBox slice{on_ground(at.at), at.along, k_step / 2, half, 0, 0};
        for (int k = 0; k < see.box_count; ++k) {
            const VehicleBox& other = r.boxes[see.boxes[k]];
            const float along = dot(other.ahead, at.along);
            // Nobody passes a bicycle in one lane, nor does one pass others there: they would turn into each
            // other.
            const bool is_bicycle =
                std::min(shape.length, 2 * other.half_length) < k_short && along > k_same_way;
            if (!overlap(slice, other, is_bicycle ? k_beside_bicycles : k_beside_boxes)) continue;
            const float gap = std::max(on - k_step / 2, 0.0f);
            if (found.why == Brakes::people && found.gap < gap) continue;
            found = {gap, other.speed * std::max(along, 0.0f), Brakes::ahead, r.numbers[see.boxes[k]]};
        }
    }
    return found;
}

int count_on_crossing(const Crowd& c, const Crossing& crossing, Vec2 lane_at, bool insists) {
    constexpr float k_beside = 0.6f, k_kerb = 1.3f, k_comes = 0.35f, k_past = 2, k_far = 3.6f;  // metres, m/s
    const float lane = on_crossing(crossing, lane_at).over;
    const float reach = crossing.half_length + crossing.half_width + k_kerb;
    int count = 0;
    for_seen_near(c.scratch, crossing.centre, reach, [&](uint32_t begin, uint32_t end) {
        for (uint32_t k = begin; k < end; ++k) {
            const Seen& seen = c.scratch.seen.all[k];
            const OnCrossing at = on_crossing(crossing, on_ground(seen.position));
            const float beyond = std::fabs(at.over) - crossing.half_length;
            if (std::fabs(at.aside) > crossing.half_width + k_beside || beyond > k_kerb) continue;
            if (std::fabs(seen.position.y - crossing.centre.y) > k_level) continue;
            const Vec2 velocity = c.motion.velocity[seen.id];
            const float goes = dot(velocity, crossing.across), to_lane = lane - at.over;
            const Vec2 course = c.decision.course[seen.id];
            if (beyond > -0.1f) {
                // On the pavement: one who comes towards it, or waits there to get over.
                const float over = at.over > 0 ? -1.0f : 1.0f;
                const bool comes =
                    goes * over > k_comes || (dot(course, crossing.across) * over > 0.75f && beyond < 0.9f);
                count += !insists && comes && dot(course, crossing.across) * over > 0.5f;
            } else {
                // On the carriageway, and not beyond this lane and going on.
                const bool is_past = to_lane * goes < 0 && std::fabs(to_lane) > k_past;
                // Who has waited long goes past those who wait beside the lanes.
                const bool is_far = insists && (std::fabs(to_lane) > k_far ||
                                                !is_driven_on(*c.roadway.map, on_ground(seen.position)));
                count += !is_past && !is_far;
            }
        }
    });
    return count;
}

}  // namespace flaneur
