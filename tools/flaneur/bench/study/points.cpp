#include <algorithm>
#include <cmath>

#include "tools/flaneur/bench/study/study.h"

namespace flaneur {

std::vector<PlotPoint> medians(const std::vector<StudyPoint>& points, const std::string& stage) {
    std::vector<PlotPoint> out;
    for (const StudyPoint& point : points)
        for (const Series& series : point.figures.series)
            if (series.name == stage && !series.ms.empty())
                out.push_back({point.at, quantile(series.ms, 0.5)});
    return out;
}

std::vector<uint32_t> sweep_points(uint32_t first, uint32_t last, int steps) {
    std::vector<uint32_t> points;
    for (int i = 0; i < steps; ++i) {
        const double share = steps > 1 ? static_cast<double>(i) / (steps - 1) : 1;
        points.push_back(static_cast<uint32_t>(std::lround(first * std::pow(1.0 * last / first, share))));
    }
    if (steps == 0) {
        points.push_back(first);
        for (uint64_t ten = 1; ten <= last; ten *= 10)
            for (const uint64_t step : {1, 2, 5})
                if (step * ten > first && step * ten < last)
                    points.push_back(static_cast<uint32_t>(step * ten));
        points.push_back(last);
    }
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
}

std::vector<int> thread_points(int most) {
    std::vector<int> points;
    for (int n = 1; n < most; n += std::max(1, n / 4)) points.push_back(n);
    points.push_back(most);
    return points;
}

}  // namespace flaneur
