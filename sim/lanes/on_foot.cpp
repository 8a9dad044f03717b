// What those on foot do about vehicles.
#include <algorithm>
#include <cmath>

#include "sim/base/tick.h"
#include "sim/lanes/near.h"
#include "sim/lanes/roadway.h"

namespace flaneur {

namespace {
constexpr float k_looks = 14, k_step = 0.5f;  // metres of its way that one looks at
constexpr float k_steps_on = 0.9f;            // metres before a carriageway at which one decides
constexpr float k_island = 1.6f;              // metres between lanes on which one can wait again
constexpr float k_sets_off = 0.7f;            // seconds
constexpr float k_margin = 2;                 // seconds between who has crossed and who comes
constexpr float k_cannot_stop = 2.2f;         // seconds: who is so near a crossing does not stop any more
}  // namespace

static bool is_red(const Crossings& crossings, const Crossing& crossing, uint32_t tick) {
    return is_ruled(crossing) && lamp_at(crossings.plans[crossing.plan], tick).light != Light::green;
}

bool must_let_pass(const Roadway& r, const Walking& s) {
    const RoadRaster& raster = r.map->raster;
    auto what_at = [&](uint32_t square) {
        return square == RoadRaster::k_nowhere ? RoadRaster::k_off : raster.what[square];
    };
    const Vec2 here = on_ground(s.at);
    if (what_at(square_of(raster, here)) != RoadRaster::k_off) return false;  // is on it, and goes on
    float begins = -1, last = -1;
    bool comes = false;
    const float pace = std::max(s.speed, 0.5f);
    for (float far = k_step; far < k_looks; far += k_step) {
        const uint32_t square = square_of(raster, here + s.way * far);
        const uint16_t what = what_at(square);
        if (what == RoadRaster::k_off) {
            if (begins >= 0 ? far - last > k_island : far > k_steps_on + s.ahead) break;
            continue;
        }
        if (begins < 0) begins = far;
        last = far;
        const uint16_t ticks = r.arrival[quad_of(square)];
        if (ticks == Roadway::k_nobody_comes) continue;
        const float arrives = static_cast<float>(ticks) * k_tick, there = far / pace + k_sets_off;
        bool gives_way = false;
        if (what > RoadRaster::k_lane) {
            const Crossings& crossings = r.map->crossings;
            gives_way = !is_red(crossings, crossings.all[what - 2u], s.tick);
        }
        comes |= arrives < (gives_way ? k_cannot_stop : there + k_margin);
    }
    return comes;
}

// Whether a vehicle stands on the next step or two.
static bool is_in_way(const Roadway& r, Vec2 place, Vec2 way, float far, float radius) {
    constexpr float k_steps[] = {0.25f, 0.6f, 1.1f};  // metres
    bool is = false;
    for_boxes_near(r, place, k_steps[2] + radius, [&](uint32_t k) {
        for (const float on : k_steps)
            is |= on < far + 0.2f && off_box(r.boxes[k], place + way * on).far < radius + 0.05f;
    });
    return is;
}

// The first and the last box of the vehicle that a box is of, which has one or, in a row, more.
struct Row {
    uint32_t first, last;
};
static Row row_of(const Roadway& r, uint32_t k) {
    Row row{k, k};
    while (row.first > 0 && r.numbers[row.first - 1] == r.numbers[k]) --row.first;
    while (row.last + 1 < r.numbers.size() && r.numbers[row.last + 1] == r.numbers[k]) ++row.last;
    return row;
}

// Which way along its sections is the nearer end, off which one gets to `aim`: 1 to its front, -1 to its
// rear; 0 where section `k` is that end.
static float to_nearer_end(const Roadway& r, uint32_t k, Vec2 place, Vec2 aim) {
    const Row row = row_of(r, k);
    const VehicleBox &first = r.boxes[row.first], &last = r.boxes[row.last];
    const Vec2 front = first.middle + first.ahead * first.half_length,
               rear = last.middle - last.ahead * last.half_length;
    const bool by_front =
        length(front - place) + length(aim - front) < length(rear - place) + length(aim - rear);
    return k == (by_front ? row.first : row.last) ? 0.0f : by_front ? 1.0f : -1.0f;
}

Vec2 round_vehicles(const Roadway& r, Vec3 here, Vec2 wanted, float radius) {
    constexpr float k_sees = 3, k_clear = 0.35f, k_stands = 0.4f, k_level = 2;  // metres, m/s
    constexpr float k_creeps = 1;    // m/s, of one with sections, which takes long to be past
    constexpr float k_off = 0.15f;   // away from its side, times the way along it
    constexpr float k_blocked = 30;  // metres of a detour that it is worth to get on
    const float speed = length(wanted);
    if (speed < 0.05f) return wanted;
    const Vec2 place = on_ground(here), way = wanted / speed;
    if (!is_near_vehicles(r, place)) return wanted;
    uint32_t which = ~0u;
    float nearest = k_sees;
    for_boxes_near(r, place, k_sees, [&](uint32_t k) {
        const VehicleBox& box = r.boxes[k];
        const bool has_sections = row_of(r, k).first != row_of(r, k).last;
        if (box.speed > (has_sections ? k_creeps : k_stands) || std::fabs(box.y - here.y) > k_level) return;
        VehicleBox grown = box;
        grown.half_length += radius + k_clear / 2, grown.half_width += radius + k_clear / 2;
        for (float far = 0.2f; far < nearest; far += 0.4f)
            if (off_box(grown, place + way * far).far < 0) nearest = far, which = k;
    });
    if (which == ~0u) return wanted;
    const VehicleBox& in_way = r.boxes[which];
    // The corners that are not behind it, each a little out; the one that is least of a detour, and to which
    // no other stands in the way.
    const OnBox at = on_box(in_way, place);
    const Vec2 aim = place + way * (nearest + 2 * in_way.half_width + 1);
    if (const float end = to_nearer_end(r, which, place, aim); end != 0) {
        const Vec2 off = Vec2{in_way.ahead.z, -in_way.ahead.x} * (at.left > 0 ? k_off : -k_off);
        return normalize_or(in_way.ahead * end + off, way) * speed;
    }
    const float l = in_way.half_length + radius + k_clear, w = in_way.half_width + radius + k_clear;
    const Vec2 ahead = in_way.ahead, left{ahead.z, -ahead.x};
    Vec2 best = wanted;
    float least = 1e9f;
    const bool is_beside = std::fabs(at.left) > in_way.half_width + radius * 0.5f,
               is_beyond = std::fabs(at.ahead) > in_way.half_length + radius * 0.5f;
    for (const float z : {l, -l})
        for (const float x : {w, -w}) {
            // Beside it one goes along its side, before it along its end, and off a corner on to one of the
            // next: many cannot all go to the place of a corner.
            const bool on_its_side = x * at.left > 0, on_its_end = z * at.ahead > 0;
            const bool is_off_corner = is_beside && is_beyond;
            if (is_off_corner ? on_its_side == on_its_end : !(is_beside ? on_its_side : on_its_end)) continue;
            const Vec2 corner = in_way.middle + ahead * z + left * x, to = corner - place;
            const float blocked =
                is_in_way(r, place, normalize_or(to, way), length(to), radius) ? k_blocked : 0;
            const float detour = length(to) + length(aim - corner) + blocked;
            if (detour < least && length(to) > 0.1f) least = detour, best = normalize_or(to, way) * speed;
        }
    return best;
}

}  // namespace flaneur
