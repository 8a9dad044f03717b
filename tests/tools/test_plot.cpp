#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <regex>

#include "tools/flaneur/plot/plot.h"
#include "tools/flaneur/plot/svg_pieces.h"

namespace flaneur {
namespace {

// Whether tags close in the order in which they open, and nothing between them has < or & of its own.
bool is_well_formed(const std::string& svg) {
    std::vector<std::string> open;
    for (size_t at = svg.find('<'); at != std::string::npos; at = svg.find('<', at + 1)) {
        const size_t end = svg.find('>', at);
        if (end == std::string::npos || svg.find('<', at + 1) < end) return false;
        const std::string tag = svg.substr(at + 1, end - at - 1);
        const std::string name =
            tag.substr(tag.starts_with('/'), tag.find_first_of(" /", 1) - tag.starts_with('/'));
        if (tag.starts_with('/')) {
            if (open.empty() || open.back() != tag.substr(1)) return false;
            open.pop_back();
        } else if (!tag.ends_with('/')) {
            open.push_back(name);
        }
    }
    static const std::regex loose("&(?!(lt|gt|amp|quot|#39);)");
    return open.empty() && !std::regex_search(svg, loose) && svg.find("nan") == std::string::npos &&
           svg.find("inf") == std::string::npos;
}

// Whether all places of texts, marks, and lines, which use absolute coordinates but for marks, are within.
bool is_within(const std::string& svg) {
    double width = 0, height = 0;
    if (std::sscanf(svg.c_str() + svg.find("viewBox="), "viewBox=\"0 0 %lf %lf\"", &width, &height) != 2)
        return false;
    auto all = [&](const std::regex& pattern, double most) {
        for (std::sregex_iterator it(svg.begin(), svg.end(), pattern), none; it != none; ++it) {
            const double value = std::stod((*it)[1]);
            if (value < 0 || value > most) return false;
        }
        return true;
    };
    static const std::regex x("[ c]x=\"([-0-9.]+)\""), y("[ c]y=\"([-0-9.]+)\""), right("H([-0-9.]+)"),
        down("V([-0-9.]+)");
    if (!all(x, width) || !all(y, height) || !all(right, width) || !all(down, height)) return false;
    static const std::regex pair("([-0-9.]+) ([-0-9.]+)");
    static const std::regex path("class=\"line[^>]*d=\"M([^\"]*)\"");
    for (std::sregex_iterator it(svg.begin(), svg.end(), path), none; it != none; ++it) {
        const std::string points = (*it)[1];
        for (std::sregex_iterator p(points.begin(), points.end(), pair); p != none; ++p) {
            const double px = std::stod((*p)[1]), py = std::stod((*p)[2]);
            if (px < 0 || px > width || py < 0 || py > height) return false;
        }
    }
    return true;
}

size_t count_of(const std::string& text, const std::string& part) {
    size_t count = 0;
    for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

LinePlot some_plot() {
    return {.title = "a < b & \"c\"",
            .note = "d > e",
            .x = {"walkers", true},
            .y = {"ms", true},
            .lines = {{"think", {{100, 0.02}, {1e3, 0.3}, {1e6, 900}}},
                      {"move & steer", {{100, 0.021}, {1e6, 901}}}},
            .levels = {{"1/60 s", 16.7}}};
}

TEST(Plot, IsWellFormedAndWithinItsBox) {
    const std::string svg = plot_svg(some_plot());
    EXPECT_TRUE(is_well_formed(svg)) << svg;
    EXPECT_TRUE(is_within(svg)) << svg;
    EXPECT_EQ(count_of(svg, "class=\"line\""), 2u);
    EXPECT_EQ(count_of(svg, "class=\"level\""), 1u);
    EXPECT_NE(svg.find("move &amp; steer"), std::string::npos);
}

TEST(Plot, LeavesOutWhatALogarithmHasNot) {
    LinePlot plot = some_plot();
    plot.lines[0].points.push_back({-5, 1});
    plot.lines[0].points.push_back({5, 0});
    plot.lines[1].points.push_back({5, std::numeric_limits<double>::quiet_NaN()});
    plot.lines[1].points.push_back({5, std::numeric_limits<double>::infinity()});
    EXPECT_EQ(plot_svg(plot), plot_svg(some_plot()));
}

TEST(Plot, OfNothingSaysSo) {
    LinePlot plot = some_plot();
    plot.lines.clear();
    const std::string svg = plot_svg(plot);
    EXPECT_TRUE(is_well_formed(svg));
    EXPECT_NE(svg.find("Nothing was measured"), std::string::npos);
}

TEST(Plot, HoldsOnePointAndManyLines) {
    LinePlot plot{.title = "one", .x = {"threads"}, .y = {"ms"}, .lines = {{"a", {{1, 1}}}}};
    EXPECT_TRUE(is_within(plot_svg(plot)));
    for (int i = 0; i < 40; ++i) plot.lines.push_back({std::string(200, 'w'), {{1, 1}, {2, 1}}});
    const std::string svg = plot_svg(plot);
    EXPECT_TRUE(is_well_formed(svg));
    EXPECT_TRUE(is_within(svg));
}

// Names at the ends of lines that end together.
TEST(Plot, NamesDoNotLieOnEachOther) {
    const std::string svg = plot_svg(some_plot());
    static const std::regex name("y=\"([-0-9.]+)\" class=\"end\"");
    std::vector<double> ys;
    for (std::sregex_iterator it(svg.begin(), svg.end(), name), none; it != none; ++it)
        ys.push_back(std::stod((*it)[1]));
    ASSERT_EQ(ys.size(), 2u);
    std::sort(ys.begin(), ys.end());
    for (size_t i = 1; i < ys.size(); ++i) EXPECT_GE(ys[i] - ys[i - 1], 12);
}

TEST(Bars, AreWithinTheirBox) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    const BarPlot plot{
        "costs", "a & b", "ms", {"here", "there"}, {{"shadows", {5, -1}, "FLIP 0.1"}, {"x", {none, 3}, ""}}};
    const std::string svg = bars_svg(plot);
    EXPECT_TRUE(is_well_formed(svg)) << svg;
    EXPECT_TRUE(is_within(svg)) << svg;
    EXPECT_EQ(count_of(svg, "<rect"), 1u + 3u);
}

TEST(Stacked, IsAsHighAsAll) {
    const std::string svg = stacked({plot_svg(some_plot()), plot_svg(some_plot())});
    EXPECT_TRUE(is_well_formed(svg));
    EXPECT_NE(svg.find("viewBox=\"0 0 900 1080\""), std::string::npos);
}

TEST(ShortNumber, TellsThreeDigits) {
    EXPECT_EQ(short_number(1'000'000), "1,000,000");
    EXPECT_EQ(short_number(1000), "1,000");
    EXPECT_EQ(short_number(16.666), "16.7");
    EXPECT_EQ(short_number(2), "2");
    EXPECT_EQ(short_number(0.25), "0.25");
    EXPECT_EQ(short_number(20), "20");
    EXPECT_EQ(short_number(0), "0");
    EXPECT_EQ(short_number(-1234), "-1,234");
}

}  // namespace
}  // namespace flaneur
