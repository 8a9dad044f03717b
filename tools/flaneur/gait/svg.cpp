#include <algorithm>
#include <cmath>

#include "tools/flaneur/gait/report.h"
#include "tools/flaneur/plot/svg_pieces.h"

namespace flaneur {

namespace {

constexpr int k_columns = 4;
constexpr double k_wide = 210, k_high = 130;  // of a plot, pixels
constexpr double k_left_margin = 46, k_gap_x = 44, k_gap_y = 76, k_head = 74, k_foot = 20;

struct Panel {
    double x, y, low, high;  // of the plot's corner; of the values
    double px(double percent) const { return x + k_wide * percent / 100; }
    double py(double value) const { return y + k_high * (high - value) / (high - low); }
};

std::string line(const Panel& p, const Cycle& c, const char* style) {
    std::string text = std::string("<path class=\"") + style + "\" d=\"M";
    for (size_t i = 0; i < c.size(); ++i)
        text += printed("%.1f %.1f ", p.px(static_cast<double>(i)), p.py(c[i]));
    return text + "\"/>\n";
}

std::string band(const Panel& p, const Cycle& mean, const Cycle& sd) {
    std::string text = "<path class=\"band\" d=\"M";
    for (size_t i = 0; i < mean.size(); ++i)
        text += printed("%.1f %.1f ", p.px(static_cast<double>(i)), p.py(mean[i] + sd[i]));
    for (size_t i = mean.size(); i-- > 0;)
        text += printed("%.1f %.1f ", p.px(static_cast<double>(i)), p.py(mean[i] - sd[i]));
    return text + "Z\"/>\n";
}

// What the bars say about the curve, in a line.
std::string caption(const Report& report, const std::string& name) {
    std::string text;
    for (const Verdict& v : report.verdicts) {
        std::string quantity = v.bar.quantity;
        if (quantity == name + ".rmse") {
            text = printed("RMSE %.1f°, bar %.1f°", v.value, v.bar.high);
            if (v.bar.stretch > 0) text += printed(", stretch %.1f°", v.bar.stretch);
            text += v.pass ? "" : ": missed";
        }
    }
    return text;
}

}  // namespace

std::string curves_svg(const Report& report) {
    auto count = static_cast<int>(k_named_curves.size());
    int rows = (count + k_columns - 1) / k_columns;
    double width = k_left_margin + k_columns * (k_wide + k_gap_x);
    double height = k_head + rows * (k_high + k_gap_y) + k_foot;
    std::string svg =
        svg_begin(width, height,
                  ".title{font-size:18px;font-weight:600}.sub{font-size:11px;fill:#666}"
                  ".name{font-size:13px;font-weight:600}.unit{font-size:10px;fill:#888}"
                  ".tick{font-size:10px;fill:#888}.right{text-anchor:end}.middle{text-anchor:middle}"
                  ".grid{stroke:#e4e4e4;stroke-width:1}.zero{stroke:#b8b8b8;stroke-width:1}"
                  ".event{stroke:#b8b8b8;stroke-width:1;stroke-dasharray:3 3}"
                  ".band{fill:#d5e3f0;stroke:none}.norm{fill:none;stroke:#7da3c7;stroke-width:1.5}"
                  ".walk{fill:none;stroke:#c8442c;stroke-width:2;stroke-linejoin:round}");
    svg += svg_label(k_left_margin, 30, "title", report.title);
    svg +=
        svg_label(k_left_margin, 50, "sub",
                  "One gait cycle, contact to contact of one foot; mean of both sides; dashed: toe-off. Red: "
                  "this walk. "
                  "Blue: people on level ground at natural speed, and their standard deviation.");
    double toe_off = value_of(report.quantities, "stance.pct");
    for (int i = 0; i < count; ++i) {
        const NamedCurve& c = k_named_curves[static_cast<size_t>(i)];
        const Cycle& walk = report.curves.*c.curve;
        int column = i % k_columns, row = i / k_columns;
        Panel p{k_left_margin + column * (k_wide + k_gap_x), k_head + row * (k_high + k_gap_y) + 32, walk[0],
                walk[0]};
        for (size_t k = 0; k < k_percents; ++k) {
            double norm = c.norm ? (*c.norm)[k] : walk[k], sd = c.sd ? (*c.sd)[k] : 0;
            p.low = std::min({p.low, walk[k], norm - sd});
            p.high = std::max({p.high, walk[k], norm + sd});
        }
        double room = std::max((p.high - p.low) * 0.06, 0.5);
        p.low -= room, p.high += room;
        double step = grid_step(p.high - p.low);
        svg += svg_label(p.x, p.y - 20, "name", c.title);
        svg += svg_label(p.x, p.y - 7, "unit", c.unit);
        for (double v = std::ceil(p.low / step) * step; v <= p.high; v += step) {
            bool zero = std::fabs(v) < step / 2;
            svg += printed(zero ? "<path class=\"zero\" d=\"M%.1f %.1fH%.1f\"/>\n"
                                : "<path class=\"grid\" d=\"M%.1f %.1fH%.1f\"/>\n",
                           p.x, p.py(v), p.x + k_wide);
            svg += svg_label(p.x - 6, p.py(v) + 3.5, "tick right", printed("%.0f", zero ? 0.0 : v));
        }
        if (std::isfinite(toe_off)) {
            svg +=
                printed("<path class=\"event\" d=\"M%.1f %.1fV%.1f\"/>\n", p.px(toe_off), p.y, p.y + k_high);
        }
        if (c.norm && c.sd) svg += band(p, *c.norm, *c.sd);
        if (c.norm) svg += line(p, *c.norm, "norm");
        svg += line(p, walk, "walk");
        for (int percent : {0, 50, 100})
            svg += svg_label(p.px(percent), p.y + k_high + 13, "tick middle", printed("%.0f %%", percent));
        svg += svg_label(p.x, p.y + k_high + 28, "tick", caption(report, c.name));
    }
    svg += svg_label(k_left_margin, height - 18, "sub",
                     "Norms: Winter 1991 and Fukuchi, Fukuchi & Duarte 2018 (CC BY 4.0), pooled.");
    return svg + "</svg>\n";
}

}  // namespace flaneur
