#include "tools/flaneur/validate/flow.h"

#include <algorithm>
#include <cmath>

#include "assets/measures/lines.h"
#include "assets/measures/moments.h"
#include "sim/base/math.h"

namespace flaneur {
namespace {

constexpr double k_speed_window = 0.2;  // seconds before and after
constexpr CutOff k_flow_cells{3, 24};
constexpr float k_far = 1e5f;  // metres, beyond which nobody is

}  // namespace

std::vector<FlowSample> flow_samples(const Trajectories& tracks, const Rectangle& zone, double every,
                                     double first, double last) {
    const std::vector<WalkablePolygon> outline = {
        {{zone.low, {zone.high.x, zone.low.z}, zone.high, {zone.low.x, zone.high.z}}, {}}};
    const MeasuredArea area = measured_area(outline, tracks.area, k_flow_cells);
    const CellGround ground = cell_ground(tracks.area, k_flow_cells);
    const TrackTable table = track_table(tracks);
    const auto window = static_cast<uint32_t>(std::max(1L, std::lround(k_speed_window * wide(tracks.fps))));
    const std::vector<float> speeds = speeds_of(velocities(table, window, AtEnds::single_sided));
    const WorkersPtr alone = make_workers(1);
    std::vector<FlowSample> samples;
    for (double at = first; at <= last; at += every) {
        const auto frame = static_cast<uint32_t>(std::lround(at * wide(tracks.fps)));
        for (const AreaMoment& m : area_moments(table, area, ground, speeds, {frame, frame}, *alone)) {
            if (m.covered <= 0) continue;
            samples.push_back({frame / wide(tracks.fps), m.people, m.classic, m.voronoi,
                               speed_where_covered(m), std::isnan(m.mean_speed) ? 0 : m.mean_speed});
        }
    }
    return samples;
}

std::vector<double> crossings_at(const Trajectories& tracks, float x) {
    std::vector<double> seconds;
    // Who looks to the south has the east to the left.
    for (const LineCrossed& c : line_crossings(track_table(tracks), {{x, -k_far}, {x, k_far}}, {}))
        if (c.to_left) seconds.push_back(c.frames / wide(tracks.fps));
    std::sort(seconds.begin(), seconds.end());
    return seconds;
}

MeanFlow mean_of(std::span<const FlowSample> samples) {
    MeanFlow mean;
    for (const FlowSample& s : samples) {
        mean.classic += s.classic;
        mean.density += s.density;
        mean.speed += s.speed;
        mean.mean_speed += s.mean_speed;
    }
    mean.samples = samples.size();
    const auto count = static_cast<double>(std::max<size_t>(samples.size(), 1));
    return {mean.classic / count, mean.density / count, mean.speed / count, mean.mean_speed / count,
            mean.samples};
}

}  // namespace flaneur
