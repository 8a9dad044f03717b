#include "tools/flaneur/plot/plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "tools/flaneur/plot/svg_pieces.h"

namespace flaneur {

namespace {

constexpr double k_wide = 900, k_high = 540;
constexpr double k_left = 76, k_right = 190, k_top = 84, k_bottom = 62;
constexpr double k_letter = 6.6, k_line = 15;  // pixels of a name's letter, and between names

// Okabe & Ito, Color Universal Design, 2008, without yellow, which is lost on white.
constexpr std::array k_colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                  "#e69f00", "#56b4e9", "#000000"};

constexpr const char* k_style =
    ".title{font-size:17px;font-weight:600}.sub{font-size:11px;fill:#666}.axis{font-size:12px;fill:#444}"
    ".tick{font-size:11px;fill:#777}.name{font-size:12px}.end{font-size:12px;fill:inherit}.lead{stroke:#bbb;"
    "fill:none}.right{text-anchor:end}.middle{text-anchor:middle}"
    ".grid{stroke:#e4e4e4;stroke-width:1;fill:none}.level{stroke:#888;stroke-dasharray:6 4;fill:none}"
    ".line{fill:none;stroke-width:2;stroke-linejoin:round}.faint{stroke:#999;stroke-dasharray:3 3}";

// One axis: from values to shares of its length.
struct Scale {
    double low = 0, high = 1;
    bool is_log = false;
    double of(double value) const {
        return is_log ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
    }
};

bool can_show(double value, bool is_log) { return std::isfinite(value) && (!is_log || value > 0); }

Scale scale_of(const std::vector<double>& values, bool is_log) {
    Scale scale{0, 1, is_log};
    if (values.empty()) return is_log ? Scale{1, 10, true} : scale;
    auto [low, high] = std::minmax_element(values.begin(), values.end());
    if (is_log) {
        // To the next of 1, 2, 5, 10 ..
        auto rounded = [](double value, bool up) {
            const double ten = std::pow(10, std::floor(std::log10(value)));
            double best = up ? 10 * ten : ten;
            for (const double step : {1.0, 2.0, 5.0}) {
                if (up && step * ten >= value * (1 - 1e-9)) return step * ten;
                if (!up && step * ten <= value * (1 + 1e-9)) best = step * ten;
            }
            return best;
        };
        scale.low = rounded(*low, false);
        scale.high = rounded(*high, true);
        if (scale.high <= scale.low) scale.high = 10 * scale.low;
        return scale;
    }
    scale.low = std::min(0.0, *low);
    scale.high = *high > scale.low ? *high : scale.low + 1;
    const double step = grid_step(100 * (scale.high - scale.low)) / 100;
    scale.high = std::ceil(scale.high / step - 1e-9) * step;
    return scale;
}

std::vector<double> ticks_of(const Scale& scale) {
    std::vector<double> ticks;
    if (!scale.is_log) {
        const double step = grid_step(100 * (scale.high - scale.low)) / 100;
        for (double v = std::ceil(scale.low / step) * step; v <= scale.high * (1 + 1e-9); v += step)
            ticks.push_back(std::fabs(v) < step / 2 ? 0 : v);
        return ticks;
    }
    const double decades = std::log10(scale.high / scale.low);
    for (double ten = std::pow(10, std::floor(std::log10(scale.low))); ten <= scale.high; ten *= 10)
        for (const double step : {1.0, 2.0, 5.0})
            if ((step == 1 || decades < 3.5) && step * ten >= scale.low * (1 - 1e-9) &&
                step * ten <= scale.high * (1 + 1e-9))
                ticks.push_back(step * ten);
    return ticks;
}

// Room for a name in so many pixels.
std::string cut(const std::string& text, double pixels) {
    const auto most = static_cast<size_t>(pixels / k_letter);
    if (text.size() <= most) return text;
    size_t end = most - 2;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;  // within a letter
    return text.substr(0, end) + "..";
}

std::string mark_at(size_t shape, double x, double y, const char* colour) {
    std::string mark;
    switch (shape % 3) {
        case 0:
            mark = printed("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3\"", x, y);
            break;
        case 1:
            mark = printed("<path d=\"M%.1f %.1fl3.5 6h-7z\"", x, y - 3.5);
            break;
        default:
            mark = printed("<path d=\"M%.1f %.1fh5.4v5.4h-5.4z\"", x - 2.7, y - 2.7);
    }
    return mark.append(" fill=\"").append(colour).append("\"/>\n");
}

struct LineName {
    double end, y;  // of the line, and of the name
    std::string text;
    const char* colour;
};

// Names beside the ends of their lines, moved apart so that none lies on another as long as there is room,
// all within the plot.
std::string names_at(std::vector<LineName> names, double x, double low, double high) {
    std::stable_sort(names.begin(), names.end(), [](auto& a, auto& b) { return a.y < b.y; });
    const double apart = std::min(k_line, (high - low) / static_cast<double>(names.size()));
    double least = low;
    for (LineName& name : names) {
        name.y = std::max(name.y, least);
        least = name.y + apart;
    }
    double most = high;
    for (size_t i = names.size(); i-- > 0;) {
        names[i].y = std::min(names[i].y, most);
        most = names[i].y - apart;
    }
    std::string svg;
    for (const LineName& name : names) {
        svg +=
            printed("<path class=\"lead\" d=\"M%.1f %.1fL%.1f %.1f\"/>\n", x + 2, name.end, x + 10, name.y);
        svg.append("<g fill=\"").append(name.colour).append("\">");
        svg += svg_label(x + 14, name.y + 4, "end", cut(name.text, k_right - 18)) + "</g>\n";
    }
    return svg;
}

}  // namespace

std::string stacked(const std::vector<std::string>& pictures) {
    double width = 0, height = 0;
    std::string inner;
    for (const std::string& picture : pictures) {
        double wide = 0, high = 0;
        const size_t box = picture.find("viewBox=");
        if (std::sscanf(picture.c_str() + box, "viewBox=\"0 0 %lf %lf\"", &wide, &high) != 2) continue;
        inner += printed("<svg y=\"%.0f\"", height) + picture.substr(std::string_view("<svg").size());
        width = std::max(width, wide);
        height += high;
    }
    return svg_begin(width, height, {}) + inner + "</svg>\n";
}

std::string short_number(double value) {
    if (!std::isfinite(value)) return "-";
    const double size = std::fabs(value);
    if (size >= 1000) {
        std::string digits = printed("%.0f", size);
        for (size_t at = digits.size(); at > 3;)
            digits.insert(digits.begin() + static_cast<std::ptrdiff_t>(at -= 3), ',');
        if (value < 0) digits.insert(digits.begin(), '-');
        return digits;
    }
    if (size >= 100 || size == 0) return printed("%.0f", value);
    std::string text = printed(size >= 10 ? "%.1f" : size >= 1 ? "%.2f" : "%.3g", value);
    if (text.find('.') == std::string::npos || text.find('e') != std::string::npos) return text;
    while (text.ends_with('0')) text.pop_back();
    if (text.ends_with('.')) text.pop_back();
    return text;
}

std::string plot_svg(const LinePlot& plot) {
    std::vector<PlotLine> lines = plot.lines;
    std::vector<double> xs, ys;
    for (PlotLine& line : lines) {
        std::erase_if(line.points, [&](const PlotPoint& p) {
            return !can_show(p.x, plot.x.is_log) || !can_show(p.y, plot.y.is_log);
        });
        for (const PlotPoint& p : line.points) xs.push_back(p.x), ys.push_back(p.y);
    }
    std::string svg = svg_begin(k_wide, k_high, k_style);
    svg += svg_label(k_left, 28, "title", cut(plot.title, 1.2 * (k_wide - k_left)));
    svg += svg_label(k_left, 48, "sub", cut(plot.note, 1.2 * (k_wide - k_left)));
    if (xs.empty()) return svg + svg_label(k_left, k_top + 30, "axis", "Nothing was measured.") + "</svg>\n";
    for (const PlotLevel& level : plot.levels)
        if (can_show(level.y, plot.y.is_log)) ys.push_back(level.y);
    const Scale across = scale_of(xs, plot.x.is_log), up = scale_of(ys, plot.y.is_log);
    const double right = k_wide - k_right, floor = k_high - k_bottom;
    auto px = [&](double x) { return k_left + (right - k_left) * across.of(x); };
    auto py = [&](double y) { return floor - (floor - k_top) * up.of(y); };
    for (const double x : ticks_of(across)) {
        svg += printed("<path class=\"grid\" d=\"M%.1f %.1fV%.1f\"/>\n", px(x), k_top, floor);
        svg += svg_label(px(x), floor + 17, "tick middle", short_number(x));
    }
    for (const double y : ticks_of(up)) {
        svg += printed("<path class=\"grid\" d=\"M%.1f %.1fH%.1f\"/>\n", k_left, py(y), right);
        svg += svg_label(k_left - 8, py(y) + 4, "tick right", short_number(y));
    }
    svg += svg_label((k_left + right) / 2, floor + 40, "axis middle", plot.x.title);
    svg += svg_label(8, k_top - 10, "axis", plot.y.title);
    std::vector<LineName> names;
    for (const PlotLevel& level : plot.levels) {
        if (!can_show(level.y, plot.y.is_log)) continue;
        svg += printed("<path class=\"level\" d=\"M%.1f %.1fH%.1f\"/>\n", k_left, py(level.y), right);
        svg += svg_label(k_left + 8, py(level.y) + 14, "tick", level.name);
    }
    size_t number = 0;
    for (const PlotLine& line : lines) {
        const size_t own = line.is_faint ? 0 : number++;
        if (line.points.empty()) continue;
        const char* colour = line.is_faint ? "#888" : k_colours[own % k_colours.size()];
        if (line.marks == PlotMarks::cloud) {
            svg.append("<g fill=\"").append(colour).append("\" fill-opacity=\"0.25\">\n");
            for (const PlotPoint& p : line.points)
                svg += printed("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"2\"/>\n", px(p.x), py(p.y));
            svg += "</g>\n";
        } else {
            std::string path = "M";
            for (const PlotPoint& p : line.points) path += printed("%.1f %.1f ", px(p.x), py(p.y));
            svg += line.is_faint ? "<path class=\"line faint\" d=\""
                                 : std::string("<path class=\"line\" stroke=\"") + colour + "\" d=\"";
            svg += path + "\"/>\n";
            if (!line.is_faint && line.marks == PlotMarks::each)
                for (const PlotPoint& p : line.points) svg += mark_at(own, px(p.x), py(p.y), colour);
        }
        const double end = py(line.points.back().y);
        names.push_back({end, end, line.name, colour});
    }
    return svg + names_at(std::move(names), right, k_top, floor) + "</svg>\n";
}

std::string bars_svg(const BarPlot& plot) {
    constexpr double k_names = 230, k_bar = 13, k_gap = 9, k_notes = 190, k_below = 46;
    const size_t columns = std::max<size_t>(plot.columns.size(), 1);
    const double group_high = k_bar * static_cast<double>(columns) + k_gap;
    const double legend = columns > 1 ? 20 : 0, top = k_top + legend;
    const double floor = top + group_high * static_cast<double>(plot.groups.size());
    std::vector<double> values{0};
    for (const BarGroup& group : plot.groups)
        for (const double value : group.values)
            if (std::isfinite(value)) values.push_back(value);
    const Scale across = scale_of(values, false);
    auto px = [&](double x) { return k_names + (k_wide - k_names - k_notes) * across.of(x); };
    std::string svg = svg_begin(k_wide, floor + k_below, k_style);
    svg += svg_label(14, 28, "title", cut(plot.title, 1.2 * k_wide));
    svg += svg_label(14, 48, "sub", cut(plot.note, 1.2 * k_wide));
    for (size_t c = 0; columns > 1 && c < columns; ++c) {
        const double each = (k_wide - 28) / static_cast<double>(columns),
                     x = 14 + each * static_cast<double>(c);
        svg += mark_at(2, x + 4, k_top - 4, k_colours[c % k_colours.size()]);
        svg += svg_label(x + 14, k_top, "name", cut(plot.columns[c], each - 20));
    }
    for (const double x : ticks_of(across)) {
        svg += printed("<path class=\"grid\" d=\"M%.1f %.1fV%.1f\"/>\n", px(x), top, floor);
        svg += svg_label(px(x), floor + 15, "tick middle", short_number(x));
    }
    svg += svg_label((px(across.low) + px(across.high)) / 2, floor + 34, "axis middle", plot.unit);
    double y = top + k_gap / 2;
    for (const BarGroup& group : plot.groups) {
        svg += svg_label(k_names - 8, y + (group_high - k_gap) / 2 + 4, "name right",
                         cut(group.name, k_names - 16));
        double end = px(0);
        for (size_t c = 0; c < std::min(columns, group.values.size()); ++c) {
            if (!std::isfinite(group.values[c])) continue;
            const double a = px(std::min(group.values[c], 0.0)), b = px(std::max(group.values[c], 0.0));
            svg += printed("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"", a,
                           y + k_bar * static_cast<double>(c), b - a, k_bar - 2);
            svg.append(k_colours[c % k_colours.size()]).append("\"/>\n");
            end = std::max(end, b);
        }
        if (!group.note.empty())
            svg += svg_label(end + 8, y + (group_high - k_gap) / 2 + 4, "tick",
                             cut(group.note, k_wide - end - 8));
        y += group_high;
    }
    return svg + "</svg>\n";
}

}  // namespace flaneur
