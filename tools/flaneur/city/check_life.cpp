#include "tools/flaneur/city/check_life.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sim/base/math.h"
#include "sim/base/spans.h"
#include "sim/deeds/bend.h"
#include "sim/pastimes/pastimes.h"

namespace flaneur {

namespace {

constexpr float k_walks = 0.4f, k_still = 0.1f;  // m/s
constexpr float k_far = 3, k_level = 2;          // metres

float far_between(const World& w, uint32_t a, uint32_t b) {
    return length(on_ground(w.crowd.motion.position[a] - w.crowd.motion.position[b]));
}

bool goes_on(const World& w, uint32_t i) {
    const Crowd& c = w.crowd;
    const bool is_led_by_another =
        !c.fellows.empty() && c.fellows[i].group != k_no_group && c.fellows[i].leads == 0;
    return length(c.motion.velocity[i]) > k_walks && !own_of(c.called, i) && !own_of(c.passages, i) &&
           (is_led_by_another || c.journeys[i].corner < c.journeys[i].corner_count) &&
           !waits_at_kerb(c.kerbs, i) && c.motion.under[i].normal.y > 0.99f && !is_down(c, i);
}

float hands_apart(const World& w, uint32_t i) {
    const Bearing& own = w.company.bearings[i];
    auto palm = [&](uint32_t who, Side side) {
        const Someone body{w.gait.people[who / k_block], static_cast<int>(who % k_block)};
        return palm_of(body_pose_of(w.poses, who), body, side).place;
    };
    const Vec3 held = palm(i, own_side(own));
    return std::min(length(palm(own.holds, k_left) - held), length(palm(own.holds, k_right) - held));
}

void look_at_pair(const World& w, const Group& g, LifeTally& t) {
    const uint32_t a = g.members[0].index, b = g.members[1].index;
    if (g.does != Together::walks || g.narrow > 0.2f || g.waits != 0 || !goes_on(w, a) || !goes_on(w, b))
        return;
    if (far_between(w, a, b) > 2) return;      // one catches up
    constexpr uint32_t k_comes_back = 5 * 60;  // ticks, of a child that has run ahead
    for (const uint32_t i : {a, b})
        if (w.tick < w.company.bearings[i].runs_until + k_comes_back) return;
    const Vec2 off = on_ground(w.crowd.motion.position[b] - w.crowd.motion.position[a]);
    t.abreast.push_back(std::fabs(cross(g.ahead, off)));
    // A throng bends the shape (Zanlungo 2014).
    constexpr float k_open = 0.3f;  // strangers to a square metre
    if (g.crowded < k_open) t.ahead.push_back(std::fabs(dot(g.ahead, off)));
}

void look_at_groups(const World& w, LifeTally& t) {
    if (!is_on(w.company)) return;
    for (const Group& g : w.company.groups) {
        if (g.count == 0 || g.does == Together::meets) continue;
        ++t.groups[std::min(g.count, 4u)];
        if (g.count == 2) look_at_pair(w, g, t);
        if (g.does != Together::ring || !has_arrived(w.crowd, g.members[g.leader].index)) continue;
        for (uint32_t k = 0; k < g.count; ++k) {
            float nearest = 1e9f;
            for (uint32_t m = 0; m < g.count; ++m)
                if (m != k)
                    nearest = std::min(nearest, far_between(w, g.members[k].index, g.members[m].index));
            t.rings.push_back(nearest);
        }
    }
    for (const WalkerId id : w.crowd.slots.living) {
        const Bearing& own = w.company.bearings[id.index];
        if (own.holds != k_nobody && own.grip >= 1 && w.crowd.at_once[id.index / k_block] == 1)
            t.hands = std::max(t.hands, hands_apart(w, id.index));
    }
}

void look_at_walkers(const World& w, LifeTally& t) {
    const Crowd& c = w.crowd;
    for (const WalkerId id : c.slots.living) {
        const uint32_t i = id.index;
        if (is_creature(w.herd, i) || is_led(c, i)) continue;
        ++t.people;
        const Group* group = group_of(w.company, c, i);
        const bool is_with = group != nullptr && group->does != Together::meets;
        t.in_groups += is_with;
        const Pastime* pastime = own_of(w.pastimes->all, i);
        const bool phones = pastime && pastime->phone != PhoneUse::none && w.tick < pastime->phone_until;
        t.on_phones += phones;
        const bool is_usual = !pastime || pastime->haste == Haste::usual;
        if (!phones && is_usual && goes_on(w, i))
            t.speeds[is_with ? group->count : 1].push_back(length(c.motion.velocity[i]));
    }
}

// Who has just started is told by the lamp that it starts at.
void look_at_kerbs(const World& w, LifeTally& t) {
    const Crowd& c = w.crowd;
    if (!minds_lamps(c.kerbs)) return;
    t.waited.resize(c.capacity, k_no_kerb);
    for (const WalkerId id : c.slots.living) {
        const uint32_t i = id.index, before = t.waited[i];
        const KerbWait& own = c.kerbs.waits[i];
        const bool stands = own.spot != k_no_spot && length(c.motion.velocity[i]) < k_still;
        t.waited[i] = stands ? own.kerb : k_no_kerb;
        if (before != k_no_kerb && own.kerb == k_no_kerb) {
            const Lamp lamp = lamp_at(plan_of(*c.kerbs.map, before), w.tick);
            if (lamp.light == Light::green) t.starts.push_back(static_cast<float>(lamp.since) * k_tick);
        }
        if (!stands) continue;
        float nearest = k_far;
        for (const WalkerId other : c.slots.living)
            if (other.index != i && c.kerbs.waits[other.index].kerb == own.kerb &&
                c.kerbs.waits[other.index].spot != k_no_spot)
                nearest = std::min(nearest, far_between(w, i, other.index));
        if (nearest < k_far) t.at_kerb.push_back(nearest);
    }
}

void look_at_pastimes(const World& w, LifeTally& t) {
    t.sat_since.resize(w.crowd.capacity, k_never);
    for (const Pastime& p : w.pastimes->all) {
        const bool sits = p.what == Staying::sits && p.phase == StayPhase::stays;
        t.sitting += sits;
        if (sits && t.sat_since[p.walker] != p.began)
            t.sat.push_back(static_cast<float>(std::max(p.until, p.began) - p.began) * k_tick / 60);
        t.sat_since[p.walker] = sits ? p.began : k_never;
        if (p.what != Staying::queues || p.phase != StayPhase::stays || p.rank == 0) continue;
        for (const Pastime& q : w.pastimes->all)
            if (q.what == Staying::queues && q.place == p.place && q.phase == StayPhase::stays &&
                q.rank + 1 == p.rank)
                t.in_line.push_back(far_between(w, p.walker, q.walker));
    }
}

void look_at_vehicles(const World& w, LifeTally& t) {
    const Roadway& r = w.crowd.roadway;
    if (!has_traffic(r)) return;
    for (const WalkerId id : w.crowd.slots.living) {
        const uint32_t i = id.index;
        const Vec3 at = w.crowd.motion.position[i];
        const float radius = w.crowd.identity.radius[i];
        for_boxes_near(r, on_ground(at), radius, [&](uint32_t k) {
            if (std::fabs(r.boxes[k].y - at.y) < k_level)
                t.hit = std::max(t.hit, radius - off_box(r.boxes[k], on_ground(at)).far);
        });
    }
    for (uint32_t a = 0; a < r.boxes.size(); ++a)
        for_boxes_near(r, r.boxes[a].middle, r.boxes[a].half_length, [&](uint32_t b) {
            if (b <= a || r.numbers[a] == r.numbers[b]) return;
            if (std::fabs(r.boxes[a].y - r.boxes[b].y) > k_level) return;
            t.crashes += overlap(r.boxes[a], r.boxes[b], 0);
        });
}

float quantile(std::vector<float>& values, double part) {
    if (values.empty()) return 0;
    const auto at =
        values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

double mean(const std::vector<float>& values) {
    const double sum = std::accumulate(values.begin(), values.end(), 0.0);
    return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

Finding within(std::string name, double value, double least, double most) {
    Finding finding{std::move(name), value, least, true, {}};
    finding.most = most;
    return finding;
}

double percent(uint64_t part, uint64_t whole) {
    return whole ? 100 * static_cast<double>(part) / static_cast<double>(whole) : 0;
}

// Moussaid et al. 2010, Zanlungo et al. 2014, Costa 2010: bands about what they found.
void tell_groups(LifeTally& t, std::vector<Finding>& out) {
    const uint64_t all = t.groups[2] + t.groups[3] + t.groups[4];
    out.push_back(within("in groups, % of people", percent(t.in_groups, t.people), 50, 75));
    out.push_back(within("pairs, % of groups", percent(t.groups[2], all), 60, 80));
    out.push_back(within("threes, % of groups", percent(t.groups[3], all), 10, 30));
    out.push_back(within("fours, % of groups", percent(t.groups[4], all), 3, 15));
    out.push_back(within("speed of who goes alone, m/s", mean(t.speeds[1]), 1.15, 1.45));
    out.push_back(within("speed in pairs, m/s", mean(t.speeds[2]), 1.05, 1.3));
    std::vector<float> many = t.speeds[3];
    many.insert(many.end(), t.speeds[4].begin(), t.speeds[4].end());
    out.push_back(within("speed in threes and fours, m/s", mean(many), 0.95, 1.2));
    out.push_back(within("abreast in pairs, m", quantile(t.abreast, 0.5), 0.65, 0.85));
    out.push_back({"ahead in pairs, m, of 95 in 100", quantile(t.ahead, 0.95), 0.5, false, {}});
    out.push_back(within("apart in talking circles, m", quantile(t.rings, 0.5), 0.6, 1.2));
    out.push_back({"hands that hold each other apart, m", t.hands, 0.01, false, {}});
}

}  // namespace

bool is_lively(const World& w) {
    return is_on(w.company) || w.alongside || is_any(w.pastimes->shares) || has_traffic(w.vehicles);
}

void look_at_life(const World& w, LifeTally& t) {
    look_at_walkers(w, t);
    look_at_groups(w, t);
    look_at_kerbs(w, t);
    look_at_pastimes(w, t);
    look_at_vehicles(w, t);
}

std::vector<Finding> life_findings(const World& w, LifeTally& t) {
    std::vector<Finding> out;
    if (is_on(w.company)) tell_groups(t, out);
    // Fruin 1971; Knoblauch et al. 1996.
    if (!t.at_kerb.empty()) out.push_back(within("apart at kerbs, m", quantile(t.at_kerb, 0.5), 0.6, 0.9));
    if (!t.starts.empty()) out.push_back(within("start after green, s", quantile(t.starts, 0.5), 0, 3));
    const PastimeShares& shares = w.pastimes->shares;
    if (shares.phones > 0)  // Thompson et al. 2013
        out.push_back(within("use a phone, % of people", percent(t.on_phones, t.people), 10, 30));
    if (shares.sitting > 0 && !w.pastimes->places.seats.empty()) {  // Whyte 1980
        out.push_back(within("sit, % of people", percent(t.sitting, t.people), 0.1, 15));
        if (!t.sat.empty()) out.push_back(within("stay on seats, minutes", mean(t.sat), 2, 15));
    }
    if (!t.in_line.empty()) out.push_back(within("apart in lines, m", quantile(t.in_line, 0.5), 0.5, 0.8));
    if (has_traffic(w.vehicles)) {
        out.push_back({"deepest of a vehicle in a body, m", std::max(t.hit, 0.0f), 0, false, {}});
        out.push_back({"vehicles in each other", static_cast<double>(t.crashes), 0, false, {}});
    }
    return out;
}

}  // namespace flaneur
