#include "sim/traced/traced.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/base/spans.h"
#include "sim/base/zone.h"
#include "sim/crowd/places.h"
#include "sim/world.h"

namespace flaneur {

// Ticks from a motion to what the gait is told that it is wished for: feet land where it leads.
static constexpr uint32_t k_foreseen = 18;
static constexpr float k_brakes = 1;  // m/s2, that slow one down

TracePoint trace_at(const Traces& traces, const TracedWay& way, uint32_t tick) {
    const uint32_t since = std::min(std::max(tick, way.begin), way.end) - way.begin;
    const float seconds = static_cast<float>(way.stretch) * k_tick;
    const TraceKnot* k = &traces.knots[way.knots + since / way.stretch];
    const float u = static_cast<float>(since % way.stretch) / static_cast<float>(way.stretch), v = 1 - u;
    const float value[4] = {v * v * v / 6, (3 * u * u * u - 6 * u * u + 4) / 6,
                            (3 * v * v * v - 6 * v * v + 4) / 6, u * u * u / 6};
    const float slope[4] = {-v * v / 2, (3 * u * u - 4 * u) / 2, (4 * v - 3 * v * v) / 2, u * u / 2};
    TracePoint p;
    Vec3 goes{};
    for (int i = 0; i < 4; ++i) {
        p.at += k[i].at * value[i];
        p.heading += k[i].heading * value[i];
        goes += k[i].at * (slope[i] / seconds);
        p.turn_rate += k[i].heading * (slope[i] / seconds);
    }
    p.velocity = on_ground(goes);
    p.heading = wrap_angle(p.heading);
    return p;
}

static void set_motion(World& w, uint32_t i, const TracedWay& way, uint32_t tick) {
    const Traces& traces = *w.traced.traces;
    const TracePoint now = trace_at(traces, way, tick), then = trace_at(traces, way, tick + k_foreseen);
    CrowdMotion& m = w.crowd.motion;
    Vec3 at = now.at;
    if (const auto hit = ground_at(w.around, at, k_trace_step, 2 * k_trace_step)) {
        at.y = hit->height;
        m.under[i] = *hit;
    }
    m.position[i] = at;
    m.velocity[i] = now.velocity;
    m.wish[i] = then.velocity;
    m.heading[i] = now.heading;
    m.turn_rate[i] = now.turn_rate;
    const float less = length(now.velocity) - length(then.velocity);
    m.brakes[i] = less > 0 ? std::max(less / (static_cast<float>(k_foreseen) * k_tick), k_brakes) : 0;
    m.filed[i] = filed_at(at);
}

// The fastest that one walks on a way; 0 of who runs there, as all can.
static float fastest_walk_on(const Traces& traces, const TracedWay& way) {
    constexpr float k_runs = 2.2f;  // m/s
    constexpr uint32_t k_often = 12;
    float most = 0;
    for (uint32_t tick = way.begin; tick <= way.end; tick += k_often)
        most = std::max(most, length(trace_at(traces, way, tick).velocity));
    return most < k_runs ? most : 0;
}

// One of the usual people who walks as fast as is asked. Of those whose height is known, the nearest of some
// by chance.
static Walker draw_traced(const World& w, const TracedWay& way) {
    constexpr uint32_t k_tries = 24;
    constexpr float k_near = 0.05f;                     // of its height, as bodies of a kind differ anyway
    constexpr float k_too_slow = 100, k_pushes = 1e6f;  // worse than any height
    const float fastest = fastest_walk_on(*w.traced.traces, way);
    Walker best;
    float least = 1e9f;
    for (uint32_t t = 0; t < k_tries; ++t) {
        Walker walker = draw_walker(w.folk, {w.seed, way.id, t, Purpose::body});
        const float height = w.kinds[walker.body].body.height;
        const float off = way.height > 0 ? std::fabs(way.height / height - 1) : 0;
        const float lacks = std::max(fastest - w.folk[walker.body].most, 0.0f);
        const float worth = walker.ahead > 0 ? k_pushes : std::max(off, k_near) + k_too_slow * lacks;
        if (worth >= least) continue;
        best = walker, least = worth;
        if (way.height > 0)
            best.scale = clamp(way.height / height, 1 / k_most_trace_scale, k_most_trace_scale);
        if (worth <= k_near) break;
    }
    return best;
}

static void come(World& w, uint32_t number, uint32_t tick) {
    const TracedWay& way = w.traced.traces->ways[number];
    const TracePoint at = trace_at(*w.traced.traces, way, tick);
    Walker walker = draw_traced(w, way);
    walker.heading = at.heading;
    walker.errand = Errand::arrive;
    const auto place = nearest(*w.navmesh, 0, at.at, {2, 3, 2});
    walker.place = {at.at, place ? place->polygon : 0};
    if (!place) walker.place.polygon = nearest(*w.navmesh, 0, at.at, {1000, 1000, 1000})->polygon;
    const uint32_t i = add_walker(w.crowd, w.around, walker);
    w.traced.way_of[i] = number;
    set_motion(w, i, way, tick);
    start_body(w, i);
}

// How much is seen of one, of k_shown.
static uint32_t shown_of(const TracedWay& way, uint32_t tick) {
    const uint32_t since = tick > way.seen ? tick - way.seen : 0,
                   left = way.gone > tick ? way.gone - tick : 0;
    return std::min({since, left, k_shown});
}

static void show(Crowd& c, uint32_t i, const TracedWay& way, uint32_t tick) {
    const auto at = take_away(c.passages, i);
    const uint32_t shown = shown_of(way, tick);
    if (shown == k_shown && shown_of(way, tick - 1) == k_shown) return;
    const bool comes = way.gone > tick + k_shown;
    c.passages.insert(at, {i, comes ? Passage::Kind::appear : Passage::Kind::vanish, shown, {}});
}

static void come_and_go(World& w, uint32_t tick) {
    const std::vector<TracedWay>& ways = w.traced.traces->ways;
    Crowd& c = w.crowd;
    for (uint32_t i = 0; i < c.count; ++i) {
        if (!is_there(c, i) || tick <= ways[w.traced.way_of[i]].end) continue;
        remove_walker(c, i);
        end_body(w, i);
    }
    for (uint32_t& next = w.traced.next; next < ways.size() && ways[next].begin <= tick; ++next)
        if (tick <= ways[next].end && c.slots.living.size() < c.capacity) come(w, next, tick);
    for (const WalkerId id : c.slots.living) show(c, id.index, ways[w.traced.way_of[id.index]], tick);
}

void follow_traces(World& w, std::shared_ptr<const Traces> traces) {
    w.traced.traces = std::move(traces);
    w.traced.next = 0;
    w.traced.way_of.assign(w.crowd.capacity, 0);
    w.gait.canes.reserve(w.crowd.capacity);
    w.newcomer.canes.reserve(1);
    w.crowd.passages.reserve(w.crowd.capacity);
    w.drive = drive_traced;
    come_and_go(w, 0);
    // The ticks before the first one.
    w.tick = 0 - k_trace_lead;
    while (w.tick != 0) step(w);
}

void drive_traced(World& w) {
    // The tick that is done when this one is.
    const uint32_t tick = w.tick + 1 + k_trace_lead;
    {
        FLANEUR_ZONE("come", w.stage_ms[static_cast<int>(Stage::come)]);
        come_and_go(w, tick);
    }
    FLANEUR_ZONE("move", w.stage_ms[static_cast<int>(Stage::move)]);
    Crowd& c = w.crowd;
    parallel_for(*w.workers, c.count, 4 * k_block, [&](size_t begin, size_t end, int) {
        for (size_t k = begin; k < end; ++k)
            if (const auto i = static_cast<uint32_t>(k); is_there(c, i))
                set_motion(w, i, w.traced.traces->ways[w.traced.way_of[i]], tick);
    });
}

}  // namespace flaneur
