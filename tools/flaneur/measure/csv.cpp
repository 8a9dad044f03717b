#include "tools/flaneur/measure/csv.h"

#include <algorithm>
#include <cstdio>

#include "assets/files/file.h"
#include "sim/base/math.h"

namespace flaneur {
namespace {

template <class... Values>
void add(std::string& text, const char* form, Values... values) {
    char row[192];
    std::snprintf(row, sizeof row, form, values...);
    text.append(row);
}

}  // namespace

std::string line_csv(const LineCount& line) {
    std::string text = "time_s,walker,direction,speed_m_per_s,x_m,z_m\n";
    for (const LineCrossing& c : line.crossings)
        add(text, "%.4f,%u,%s,%.3f,%.3f,%.3f\n", c.seconds, c.person, c.to_right ? "right" : "left",
            wide(c.speed), wide(c.at.x), wide(c.at.z));
    return text;
}

std::string zone_csv(const ZoneCount& zone) {
    std::string text = "time_s,people,density_per_m2,voronoi_density_per_m2,mean_speed_m_per_s\n";
    for (const ZoneSample& s : zone.samples) {
        add(text, "%.2f,%u,%.4f,%.4f,", s.tick / 60.0, s.people, wide(s.density), wide(s.voronoi));
        if (s.people > 0) add(text, "%.3f", wide(s.speed));
        text.push_back('\n');
    }
    return text;
}

std::string told_counts(const Counts& counts) {
    std::string text;
    for (const LineCount& line : counts.lines) {
        const Flow flow = flow_of(line, counts.tick, 1e9);
        add(text, "%s: %u to the left, %u to the right, %.2f people/min, %.4f people/(m s)\n",
            line.line.name.c_str(), flow.left, flow.right, flow.per_minute, flow.per_metre_second);
    }
    for (const ZoneCount& zone : counts.zones) {
        double people = 0, voronoi = 0;
        for (const ZoneSample& s : zone.samples) people += s.people, voronoi += wide(s.voronoi);
        const double n = std::max<double>(static_cast<double>(zone.samples.size()), 1);
        add(text, "%s: %.1f m2, %.2f people on average, %.4f people/m2 (Voronoi %.4f)\n",
            zone.zone.name.c_str(), zone.area, people / n, people / n / zone.area, voronoi / n);
    }
    return text;
}

std::string csv_path(const std::string& path, const std::string& name) {
    std::string stem = has_ending(path, ".csv") ? path.substr(0, path.size() - 4) : path;
    return stem.append("-").append(name).append(".csv");
}

}  // namespace flaneur
