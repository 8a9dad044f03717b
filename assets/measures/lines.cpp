#include "assets/measures/lines.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>

#include "sim/base/math.h"
#include "sim/base/planar.h"

namespace flaneur {
namespace {

// Above 0 to the right of who looks from `a` to `b`: +z is to the right of +x.
int side_of(const MeasuredLine& line, Vec2 p) {
    const double side = crossed(line.a, line.b, p);
    return (side > 0) - (side < 0);
}

// Whether the way from `p` to `q`, which lie on different sides or on it, goes through the line between its
// ends; and at what share of the way.
std::optional<double> share_through(const MeasuredLine& line, Vec2 p, Vec2 q) {
    const double at_p = crossed(line.a, line.b, p), at_q = crossed(line.a, line.b, q);
    const double share = at_p == at_q ? 0 : at_p / (at_p - at_q);
    const Vec2 at = lerp(p, q, static_cast<float>(share)), along = line.b - line.a;
    const float place = dot(at - line.a, along);
    if (place < 0 || place > length_squared(along)) return std::nullopt;
    return share;
}

}  // namespace

std::vector<LineCrossed> line_crossings(const TrackTable& table, const MeasuredLine& line, FrameRange range) {
    std::vector<LineCrossed> crossings;
    const std::vector<Sighting>& all = table.of->sightings;
    for (size_t k = 0; k < table.ids.size(); ++k) {
        int last_side = 0;                  // where they were last that was not on the line,
        std::optional<LineCrossed> onto{};  // and how they came onto it, if they stand on it
        const Sighting* before = nullptr;
        for (uint32_t i : sightings_of(table, k)) {
            const Sighting& s = all[i];
            if (s.frame < range.first || s.frame > range.last) continue;
            const int side = side_of(line, s.at);
            if (before && last_side != 0 && side != last_side && !onto)
                if (const std::optional<double> share = share_through(line, before->at, s.at))
                    onto = LineCrossed{.id = s.id,
                                       .frames = before->frame + *share * (s.frame - before->frame),
                                       .at = lerp(before->at, s.at, static_cast<float>(*share))};
            if (side != 0) {
                if (onto && side != last_side) {
                    onto->frame = s.frame;
                    onto->to_left = side < 0;
                    onto->sighting = i;
                    crossings.push_back(*onto);
                }
                onto.reset();
                last_side = side;
            }
            before = &s;
        }
    }
    std::sort(crossings.begin(), crossings.end(), [](const LineCrossed& a, const LineCrossed& b) {
        return std::tuple(a.frame, a.id) < std::tuple(b.frame, b.id);
    });
    return crossings;
}

std::vector<LineCrossed> first_crossings(std::span<const LineCrossed> crossings) {
    std::set<uint32_t> seen;
    std::vector<LineCrossed> first;
    for (const LineCrossed& c : crossings)
        if (seen.insert(c.id).second) first.push_back(c);
    return first;
}

std::vector<FlowInterval> flow_intervals(std::span<const LineCrossed> crossings,
                                         std::span<const float> speeds, uint32_t delta, uint32_t last_frame,
                                         float fps) {
    std::vector<FlowInterval> intervals;
    if (crossings.empty() || delta == 0) return intervals;
    uint32_t begin = crossings[0].frame;
    size_t passed = 0;
    for (uint64_t frame = begin + uint64_t{delta}; frame < last_frame; frame += delta) {
        size_t next = passed;
        while (next < crossings.size() && crossings[next].frame <= frame) ++next;
        if (next == passed) continue;
        FlowInterval interval{.first = begin, .last = crossings[next - 1].frame + 1};
        interval.people = static_cast<uint32_t>(next - passed);
        interval.flow = interval.people * wide(fps) / (interval.last - interval.first);
        double sum = 0, known = 0;
        for (const LineCrossed& c : crossings.subspan(passed, next - passed))
            if (const double speed = wide(speeds[c.sighting]); !std::isnan(speed)) sum += speed, ++known;
        interval.mean_speed = sum / known;
        intervals.push_back(interval);
        begin = interval.last;
        passed = next;
    }
    return intervals;
}

std::vector<Vec2> area_beside(const MeasuredLine& line, float width) {
    const Vec2 along = (line.b - line.a) / length(line.b - line.a);
    const Vec2 aside = Vec2{along.z, -along.x} * width;
    return {line.a, line.b, line.b + aside, line.a + aside};
}

std::vector<PassedThrough> passages(const TrackTable& table, const MeasuredLine& line, float width,
                                    FrameRange range) {
    const std::vector<Vec2> corners = area_beside(line, width);
    const MeasuredLine other{corners[3], corners[2]};
    const std::vector<WalkablePolygon> outline = {{corners, {}}};
    const MeasuredArea area = measured_area(outline, {});
    const std::vector<Sighting>& all = table.of->sightings;
    // How many are inside, summed up to before each frame.
    const auto [first, last] = frames_in(table, range);
    std::vector<double> sums{0};
    for (size_t k = first; k < last; ++k) {
        size_t inside = 0;
        for (const Sighting& s : seen_in(table, k)) inside += is_in(area, s.at);
        sums.push_back(sums.back() + static_cast<double>(inside));
    }
    auto sum_before = [&, first = first, last = last](uint32_t frame) {
        const auto begin = table.frames.begin() + static_cast<std::ptrdiff_t>(first);
        const auto end = table.frames.begin() + static_cast<std::ptrdiff_t>(last);
        return sums[static_cast<size_t>(std::lower_bound(begin, end, frame) - begin)];
    };
    // 1 or 2: the line that the way from one sighting to the next touches; 0: neither.
    auto line_between = [&](uint32_t i, uint32_t j) {
        auto touches = [&](const MeasuredLine& l) {
            const int a = side_of(l, all[i].at), b = side_of(l, all[j].at);
            return a * b <= 0 && share_through(l, all[i].at, all[j].at).has_value();
        };
        return touches(line) ? 1 : touches(other) ? 2 : 0;
    };
    std::vector<PassedThrough> passages;
    for (const Sojourn& stay : sojourns(table, area, range)) {
        const auto found = std::lower_bound(table.ids.begin(), table.ids.end(), stay.id) - table.ids.begin();
        const std::span<const uint32_t> way = sightings_of(table, static_cast<size_t>(found));
        const auto at = std::lower_bound(way.begin(), way.end(), stay.first,
                                         [&](uint32_t i, uint32_t frame) { return all[i].frame < frame; });
        const auto end = at + (stay.last - stay.first);  // without a gap
        if (at == way.begin() || end + 1 == way.end() || all[end[1]].frame != stay.last + 1) continue;
        const int in_by = line_between(at[-1], at[0]), out_by = line_between(end[0], end[1]);
        if (in_by == 0 || out_by == 0 || in_by == out_by) continue;
        PassedThrough passage{.id = stay.id, .entered = stay.first, .left = stay.last + 1};
        const double frames = passage.left - passage.entered;
        passage.speed = wide(width) * wide(table.of->fps) / frames;
        passage.density =
            (sum_before(passage.left) - sum_before(passage.entered)) / frames / area.square_metres;
        passages.push_back(passage);
    }
    return passages;
}

}  // namespace flaneur
