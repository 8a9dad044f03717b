// Terrain under a map.
#include "assets/terrain/terrain.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "assets/osm/map.h"

namespace flaneur {

namespace {

// Elevation files are too coarse for shores: the land rises from a quay's height over so many metres.
constexpr float k_quay = 1.2f, k_shore = 60;

struct Heights {
    int columns = 0, rows = 0;
    std::vector<float> values;
};

// For each corner of the squares, about how far the nearest one in the sea is: steps to the side count one,
// across the root of two (a chamfer, within 8 %), smoothed.
Heights distance_to_sea(const GroundPlan& plan, const Rings& sea, int columns, int rows) {
    Heights d{columns, rows,
              std::vector<float>(static_cast<size_t>(columns) * static_cast<size_t>(rows), 1e9f)};
    // Corner by corner along a row, the sea begins and ends where its shore is crossed.
    for (int row = 0; row < rows; ++row) {
        double z = static_cast<double>(plan.low.z) + row * static_cast<double>(plan.cell);
        std::vector<double> crossings;
        for (const Ring& ring : sea) {
            for (size_t i = 0; i < ring.size(); ++i) {
                Vec2 a = to_metres(ring[i]), b = to_metres(ring[(i + 1) % ring.size()]);
                double az = static_cast<double>(a.z), bz = static_cast<double>(b.z);
                if ((az <= z) == (bz <= z)) continue;
                crossings.push_back(static_cast<double>(a.x) +
                                    (z - az) / (bz - az) *
                                        (static_cast<double>(b.x) - static_cast<double>(a.x)));
            }
        }
        std::sort(crossings.begin(), crossings.end());
        for (size_t i = 0; i + 1 < crossings.size(); i += 2) {
            auto column = [&](double x) {
                return (x - static_cast<double>(plan.low.x)) / static_cast<double>(plan.cell);
            };
            int from = static_cast<int>(std::ceil(std::max(0.0, column(crossings[i]))));
            int to = static_cast<int>(
                std::floor(std::min(column(crossings[i + 1]), static_cast<double>(columns - 1))));
            for (int c = from; c <= to; ++c)
                d.values[static_cast<size_t>(row) * static_cast<size_t>(columns) + static_cast<size_t>(c)] =
                    0;
        }
    }
    auto pass = [&](int first, int last, int step) {
        auto at = [&](int c, int r) -> float& {
            return d.values[static_cast<size_t>(r) * static_cast<size_t>(columns) + static_cast<size_t>(c)];
        };
        bool down = step > 0;
        for (int r = down ? 0 : rows - 1; r != (down ? rows : -1); r += step) {
            for (int c = first; c != last; c += step) {
                auto reach = [&](int dc, int dr, float length_of_step) {
                    int nc = c + dc, nr = r + dr;
                    if (nc < 0 || nr < 0 || nc >= columns || nr >= rows) return;
                    at(c, r) = std::min(at(c, r), at(nc, nr) + length_of_step * plan.cell);
                };
                reach(-step, 0, 1);
                reach(0, -step, 1);
                reach(-step, -step, 1.41421356f);
                reach(step, -step, 1.41421356f);
            }
        }
    };
    pass(0, columns, 1);
    pass(columns - 1, -1, -1);
    // Steps of a whole square would show as teeth of the shore.
    for (int times = 0; times < 2; ++times) {
        std::vector<float> sharp = d.values;
        for (int r = 0; r < rows; ++r) {
            for (int c = 0; c < columns; ++c) {
                float sum = 0;
                for (int dr = -1; dr <= 1; ++dr) {
                    for (int dc = -1; dc <= 1; ++dc) {
                        int near_r = std::clamp(r + dr, 0, rows - 1),
                            near_c = std::clamp(c + dc, 0, columns - 1);
                        sum += sharp[static_cast<size_t>(near_r) * static_cast<size_t>(columns) +
                                     static_cast<size_t>(near_c)];
                    }
                }
                d.values[static_cast<size_t>(r) * static_cast<size_t>(columns) + static_cast<size_t>(c)] =
                    sum / 9;
            }
        }
    }
    return d;
}

}  // namespace

Result<void> raise_ground(OsmImport& in, const std::string& path) {
    const Projection& project = in.project;
    GroundPlan& plan = in.plan;
    float side = plan.cell;
    auto longitude = [&](float x) {
        return project.longitude + static_cast<double>(x) / project.metres_per_longitude;
    };
    auto latitude = [&](float z) {
        return project.latitude - static_cast<double>(z) / project.metres_per_latitude;
    };
    Result<Terrain> terrain = read_terrain(
        path, {longitude(plan.low.x), latitude(plan.high.z), longitude(plan.high.x), latitude(plan.low.z)});
    if (!terrain) return terrain.error();
    Rings sea;
    for (const Area& area : plan.areas) {
        if (area.kind == Surface::water) sea.insert(sea.end(), area.rings.begin(), area.rings.end());
    }
    int columns = static_cast<int>((plan.high.x - plan.low.x) / side) + 2;
    int rows = static_cast<int>((plan.high.z - plan.low.z) / side) + 2;
    Heights away = distance_to_sea(plan, sea, columns, rows);
    plan.terrain = [&](Vec2 p) {
        float height = height_at(*terrain, longitude(p.x), latitude(p.z));
        if (sea.empty()) return height;
        auto place = [side](float v, int count) {
            return std::clamp(static_cast<int>(v / side + 0.5f), 0, count - 1);
        };
        float distance =
            away.values[static_cast<size_t>(place(p.z - plan.low.z, rows)) * static_cast<size_t>(columns) +
                        static_cast<size_t>(place(p.x - plan.low.x, columns))];
        float t = clamp(distance / k_shore, 0, 1);
        return k_quay + std::max(0.0f, height - k_quay) * t * t * (3 - 2 * t);
    };
    facet_terrain(plan);
    if (!sea.empty()) return {};
    // Far from the sea, y = 0 is the lowest ground.
    float lowest = 1e9f;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            Vec2 step{static_cast<float>(column), static_cast<float>(row)};
            lowest = std::min(lowest, plan.terrain(plan.low + step * side));
        }
    }
    plan.terrain = [raised = std::move(plan.terrain), lowest](Vec2 p) { return raised(p) - lowest; };
    return {};
}

float lowest_ground(const GroundPlan& plan, const Region& region) {
    float lowest = 1e9f;
    for (Point p : region.outer) lowest = std::min(lowest, terrain_at(plan, to_metres(p)));
    return lowest;
}

}  // namespace flaneur
