#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "tools/flaneur/measures/measures.h"
#include "tools/flaneur/measures/put.h"
#include "tools/flaneur/plot/heat.h"
#include "tools/flaneur/plot/plot.h"

namespace flaneur {
namespace {

constexpr size_t k_most_marks = 1500;              // of a cloud: more are thinned out
constexpr double k_most_ttc = 8, k_ttc_bin = 0.2;  // seconds

std::string area_svg(const MeasuredFile& m) {
    const double fps = wide(m.tracks.fps);
    LinePlot density{.title = put_values("Density in an area of %.1f m2", m.area.square_metres),
                     .note = put_values("Voronoi cells cut off at %g m", m.options.cut_off),
                     .x = {"seconds"},
                     .y = {"people / m2"}};
    LinePlot speed{.title = "Speed there",
                   .note = put_values("over %u frames before and after", m.options.frame_step),
                   .x = {"seconds"},
                   .y = {"m/s"}};
    PlotLine classic{"counted", {}}, voronoi{"Voronoi", {}}, mean{"mean of those inside", {}},
        covered{"Voronoi", {}};
    for (const AreaMoment& a : m.moments) {
        const double at = a.frame / fps;
        classic.points.push_back({at, a.classic}), voronoi.points.push_back({at, a.voronoi});
        mean.points.push_back({at, a.mean_speed}), covered.points.push_back({at, speed_where_covered(a)});
    }
    for (PlotLine* line : {&classic, &voronoi, &mean, &covered}) line->marks = PlotMarks::none;
    density.lines = {std::move(classic), std::move(voronoi)};
    speed.lines = {std::move(mean), std::move(covered)};
    return stacked({plot_svg(density), plot_svg(speed)});
}

std::string fundamental_svg(const MeasuredFile& m) {
    LinePlot speed{
        .title = "Fundamental diagram: speed over density",
        .note = "every moment and the mean of each quarter of a person to a square metre; Weidmann 1993",
        .x = {"people / m2"},
        .y = {"m/s"}};
    LinePlot flow{.title = "Flow over density",
                  .note = "density times speed, through a metre of width",
                  .x = {"people / m2"},
                  .y = {"people / (m s)"}};
    double most = 1;
    const std::pair<DensityMethod, const char*> methods[] = {{DensityMethod::voronoi, "Voronoi (D)"},
                                                             {DensityMethod::classic, "counted (C)"}};
    for (const auto& [method, name] : methods) {
        const std::vector<FundamentalPoint> points = fundamental_points(m.moments, method);
        for (const FundamentalPoint& p : points) most = std::max(most, p.density);
        PlotLine mean{name, {}}, through{name, {}};
        for (const FundamentalBin& b : fundamental_bins(points, k_fundamental_bin)) {
            mean.points.push_back({b.density, b.speed});
            through.points.push_back({b.density, b.flow});
        }
        if (method == DensityMethod::voronoi) {
            PlotLine cloud{"moments", {}}, flows{"moments", {}};
            const size_t every = points.size() / k_most_marks + 1;
            for (size_t k = 0; k < points.size(); k += every) {
                cloud.points.push_back({points[k].density, points[k].speed});
                flows.points.push_back({points[k].density, points[k].density * points[k].speed});
            }
            cloud.marks = flows.marks = PlotMarks::cloud;
            speed.lines.push_back(std::move(cloud)), flow.lines.push_back(std::move(flows));
        }
        speed.lines.push_back(std::move(mean)), flow.lines.push_back(std::move(through));
    }
    PlotLine weidmann{"Weidmann", {}, true}, their_flow{"Weidmann", {}, true};
    for (double density = 0.1; density <= std::min(most, 5.4); density += 0.05) {
        weidmann.points.push_back({density, weidmann_speed(density)});
        their_flow.points.push_back({density, density * weidmann_speed(density)});
    }
    speed.lines.push_back(std::move(weidmann)), flow.lines.push_back(std::move(their_flow));
    return stacked({plot_svg(speed), plot_svg(flow)});
}

std::string service_svg(const MeasuredFile& m) {
    BarPlot plot{
        .title = "Levels of service by Fruin, 1971",
        .note = put_values("of the area's density by Voronoi cells, over %zu frames", m.moments.size()),
        .unit = "% of the time"};
    for (const MeasuredTable& table : tables_of(m))
        for (size_t k = 0; table.name == "service" && k < table.labels.size(); ++k) {
            const double share = 100 * table.columns[1].values[k];
            plot.groups.push_back({table.labels[k], {share}, put_values("%.1f %%", share)});
        }
    return bars_svg(plot);
}

std::string profile_svg(const MeasuredFile& m) {
    const Profiles& p = *m.profiles;
    std::vector<std::vector<std::pair<double, double>>> outlines;
    auto outline = [&](const std::vector<Vec2>& ring) {
        outlines.emplace_back();
        for (Vec2 corner : ring) outlines.back().emplace_back(wide(corner.x), -wide(corner.z));
    };
    for (const WalkablePolygon& polygon : m.walkable) {
        outline(polygon.outer);
        for (const std::vector<Vec2>& hole : polygon.holes) outline(hole);
    }
    auto map = [&](const char* title, const char* unit, const std::vector<float>& values) {
        return heat_svg(
            {.title = title,
             .note = put_values("mean of %zu frames, squares of %g m", p.frames, wide(p.grid.square)),
             .unit = unit,
             .x = wide(p.grid.low.x),
             .y = -wide(p.grid.low.z),
             .square = wide(p.grid.square),
             .columns = static_cast<size_t>(p.grid.columns),
             .values = values,
             .outlines = outlines});
    };
    // Where nobody ever was is white.
    std::vector<float> density = p.density, flow = p.flow;
    for (size_t k = 0; k < density.size(); ++k)
        if (density[k] <= 0) density[k] = flow[k] = std::nanf("");
    return stacked({map("Density", "people / m2", density), map("Speed", "m/s", p.speed),
                    map("Flow", "people / (m s)", flow)});
}

std::string ttc_svg(const MeasuredFile& m) {
    std::vector<double> bins(static_cast<size_t>(k_most_ttc / k_ttc_bin + 0.5));
    double known = 0, touching = 0;
    for (const NextCollision& e : m.next_collisions) {
        if (std::isnan(e.seconds)) continue;
        ++known;
        if (e.seconds <= 0) {
            ++touching;
            continue;
        }
        const double bin = wide(e.seconds) / k_ttc_bin;
        if (bin < static_cast<double>(bins.size())) ++bins[static_cast<size_t>(bin)];
    }
    LinePlot plot{
        .title = "Time to collision",
        .note = put_values("each person's least in each frame; of discs of %g m, %.1f %% touch already",
                           m.options.radius, 100 * touching / std::max(known, 1.0)),
        .x = {"seconds"},
        .y = {"% of people and frames, in each fifth of a second"}};
    PlotLine line{"time to collision", {}};
    for (size_t k = 0; k < bins.size(); ++k)
        line.points.push_back(
            {(static_cast<double>(k) + 0.5) * k_ttc_bin, 100 * bins[k] / std::max(known, 1.0)});
    plot.lines = {std::move(line)};
    return plot_svg(plot);
}

std::string dwell_svg(const MeasuredFile& m) {
    LinePlot plot{.title = "Time in the area",
                  .note = put_values("%zu stays", m.sojourns.size()),
                  .x = {"seconds"},
                  .y = {"% that stay as long at most"}};
    std::vector<double> seconds;
    for (const Sojourn& s : m.sojourns) seconds.push_back(seconds_of(s, m.tracks.fps));
    std::sort(seconds.begin(), seconds.end());
    PlotLine line{"stays", {}};
    line.marks = PlotMarks::none;
    const auto count = static_cast<double>(seconds.size());
    for (size_t k = 0; k < seconds.size(); ++k)
        line.points.push_back({seconds[k], 100 * static_cast<double>(k + 1) / count});
    plot.lines = {std::move(line)};
    return plot_svg(plot);
}

std::string lines_svg(const MeasuredFile& m) {
    const double fps = wide(m.tracks.fps);
    LinePlot nt{.title = "People who have crossed (N-t)",
                .note = "each person's first crossing",
                .x = {"seconds"},
                .y = {"people"}};
    LinePlot flow{.title = "Flow",
                  .note = put_values("over %g s", m.options.flow_seconds),
                  .x = {"seconds"},
                  .y = {"people / s"}};
    for (const MeasuredLineFlow& l : m.lines) {
        PlotLine steps{l.line.name, {}}, rates{l.line.name, {}};
        steps.marks = PlotMarks::none;
        double passed = 0;
        for (const LineCrossed& c : l.first) {
            steps.points.push_back({c.frame / fps, passed});
            steps.points.push_back({c.frame / fps, ++passed});
        }
        for (const FlowInterval& i : l.flows)
            rates.points.push_back({(i.first + i.last) / (2 * fps), i.flow});
        nt.lines.push_back(std::move(steps)), flow.lines.push_back(std::move(rates));
    }
    std::vector<std::string> pictures = {plot_svg(nt), plot_svg(flow)};
    if (m.options.passing > 0) {
        LinePlot passing{.title = "Those who walk through",
                         .note = put_values("%g m to the left of each line (B)", m.options.passing),
                         .x = {"people / m2"},
                         .y = {"m/s"}};
        for (const MeasuredLineFlow& l : m.lines) {
            PlotLine cloud{l.line.name, {}};
            cloud.marks = PlotMarks::cloud;
            for (const PassedThrough& p : l.passages) cloud.points.push_back({p.density, p.speed});
            passing.lines.push_back(std::move(cloud));
        }
        pictures.push_back(plot_svg(passing));
    }
    return stacked(pictures);
}

}  // namespace

std::vector<MeasuredChart> charts_of(const MeasuredFile& m) {
    std::vector<MeasuredChart> charts;
    const bool all = asks_for_all(m.options);
    if (all || m.options.voronoi) charts.push_back({"area", area_svg(m)});
    if (all || m.options.fundamental) charts.push_back({"fundamental", fundamental_svg(m)});
    if (all || m.options.service) charts.push_back({"service", service_svg(m)});
    if (m.profiles) charts.push_back({"profile", profile_svg(m)});
    if (all || m.options.ttc) charts.push_back({"ttc", ttc_svg(m)});
    if (all || m.options.dwell) charts.push_back({"dwell", dwell_svg(m)});
    if (!m.lines.empty()) charts.push_back({"lines", lines_svg(m)});
    return charts;
}

std::string stacked_charts(const MeasuredFile& m) {
    std::vector<std::string> pictures;
    for (MeasuredChart& chart : charts_of(m)) pictures.push_back(std::move(chart.svg));
    return stacked(pictures);
}

}  // namespace flaneur
