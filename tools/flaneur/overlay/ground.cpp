#include <algorithm>
#include <cmath>

#include "tools/extract/convert.h"
#include "tools/flaneur/measure/count.h"
#include "tools/flaneur/overlay/overlay.h"
#include "tools/flaneur/overlay/shapes.h"

namespace flaneur {

namespace {

constexpr float k_cell = 0.5f;    // of the density's grid, metres
constexpr int k_half_grid = 300;  // cells from the eye to the grid's border
constexpr float k_kernel = 2;     // metres about a walker over which it counts
constexpr float k_least = 0.02f;  // people to a square metre that show

// People to a square metre about the eye, on a grid over the ground.
struct Node {
    float density = 0;
    float height = 0;  // of a walker near it
    bool is_near = false, is_known = false, has_ground = false;
};
struct DensityGrid {
    static constexpr int k_edge = 2 * k_half_grid;
    int first_x, first_z;
    std::vector<Node> nodes = std::vector<Node>(size_t{k_edge} * k_edge);

    explicit DensityGrid(glm::vec3 eye)
        : first_x(static_cast<int>(std::floor(eye.x / k_cell)) - k_half_grid),
          first_z(static_cast<int>(std::floor(eye.z / k_cell)) - k_half_grid) {}
    Node& at(int x, int z) { return nodes[static_cast<size_t>(z) * k_edge + static_cast<size_t>(x)]; }
    Vec3 place(int x, int z) {
        return {static_cast<float>(x + first_x) * k_cell, at(x, z).height,
                static_cast<float>(z + first_z) * k_cell};
    }
};

// Each walker over a disc, by a paraboloid whose volume is `weight`.
void spread(const World& world, float weight, DensityGrid& grid) {
    for (WalkerId id : world.crowd.slots.living) {
        const Vec3 p = world.crowd.motion.position[id.index];
        constexpr int reach = static_cast<int>(k_kernel / k_cell);
        const int x = static_cast<int>(std::floor(p.x / k_cell)) - grid.first_x;
        const int z = static_cast<int>(std::floor(p.z / k_cell)) - grid.first_z;
        if (x < reach || z < reach || x >= DensityGrid::k_edge - reach - 1 ||
            z >= DensityGrid::k_edge - reach - 1)
            continue;
        for (int j = z - reach; j <= z + reach + 1; ++j)
            for (int i = x - reach; i <= x + reach + 1; ++i) {
                const float dx = static_cast<float>(i + grid.first_x) * k_cell - p.x;
                const float dz = static_cast<float>(j + grid.first_z) * k_cell - p.z;
                const float near = 1 - (dx * dx + dz * dz) / (k_kernel * k_kernel);
                if (near <= 0) continue;
                Node& node = grid.at(i, j);
                node.density += weight * near * (2 / (3.14159265f * k_kernel * k_kernel));
                node.height = p.y;
                node.is_near = true;
            }
    }
}

bool is_over_ground(const World& world, DensityGrid& grid, int x, int z) {
    Node& node = grid.at(x, z);
    if (node.is_known || !node.is_near) return node.has_ground;
    node.is_known = true;
    if (const auto hit = ground_at(*world.ground, grid.place(x, z), 1.5f, 3))
        node.height = hit->height, node.has_ground = true;
    return node.has_ground;
}

// Two triangles for each cell that people are near, and whose corners are over the ground.
void fill_cells(const World& world, DensityGrid& grid, uint32_t (*colour)(float), Overlay& overlay) {
    for (int j = 0; j + 1 < DensityGrid::k_edge; ++j)
        for (int i = 0; i + 1 < DensityGrid::k_edge; ++i) {
            constexpr int corners[4][2] = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
            bool is_whole = true, is_seen = false;
            for (const auto& c : corners) {
                is_seen |= std::fabs(grid.at(i + c[0], j + c[1]).density) > k_least;
                is_whole &= grid.at(i + c[0], j + c[1]).is_near;
            }
            if (!is_seen || !is_whole) continue;
            for (const auto& c : corners) is_whole &= is_over_ground(world, grid, i + c[0], j + c[1]);
            if (!is_whole) continue;
            for (int k : {0, 1, 2, 0, 2, 3}) {
                const int x = i + corners[k][0], z = j + corners[k][1];
                overlay.fills.push_back({to_glm(grid.place(x, z)), colour(grid.at(x, z).density)});
            }
        }
}

uint32_t with_opacity(uint32_t colour, float opacity) {
    return (colour & 0xffffffu) | static_cast<uint32_t>(std::clamp(opacity, 0.0f, 1.0f) * 0.62f * 255) << 24;
}

// The fainter the fewer: whoever walks alone is hardly seen.
uint32_t density_colour(float density) {
    return with_opacity(k_fruin_colours[fruin_level(density)],
                        (density - k_least) / (k_fruin_densities[0] - k_least));
}

uint32_t difference_colour(float more) {
    return with_opacity(ink(more > 0 ? k_more_people : k_fewer_people), (std::fabs(more) - k_least) / 0.4f);
}

uint32_t lighter(uint32_t colour, float factor) {
    uint32_t out = colour & 0xff000000u;
    for (uint32_t shift = 0; shift < 24; shift += 8)
        out |= static_cast<uint32_t>(std::min(static_cast<float>(colour >> shift & 255) * factor, 255.0f))
               << shift;
    return out;
}

constexpr uint32_t k_trail_colours[] = {ink(0xf2c14e), ink(0x7cc6d6), ink(0xe88873),
                                        ink(0xa8d08d), ink(0xc9a6e0), ink(0xf3e9d2)};
constexpr float k_trail_reach = 150;  // metres from the eye

}  // namespace

void add_density(const OverlayInput& input, Overlay& overlay) {
    if (input.world.roam) return;
    DensityGrid grid(input.camera.eye);
    spread(input.world, 1, grid);
    fill_cells(input.world, grid, density_colour, overlay);
}

void add_density_difference(const OverlayInput& input, const World& other, Overlay& overlay) {
    if (input.world.roam || other.roam) return;
    DensityGrid grid(input.camera.eye);
    spread(input.world, 1, grid);
    spread(other, -1, grid);
    fill_cells(input.world, grid, difference_colour, overlay);
}

// The mesh's triangles, halved until their edges are short, each corner on the ground that its triangle is
// of.
void add_walkable(const OverlayInput& input, Overlay& overlay) {
    const World& world = input.world;
    if (world.roam) return;
    if (overlay.walkable.empty()) {
        const std::vector<Vec3> corners = navmesh_triangles(*world.navmesh);
        const std::vector<Surface> kinds = navmesh_kinds(*world.navmesh);
        constexpr float inward = 0.04f, longest = 4;  // share of the way to the middle; metres
        for (size_t i = 0; i < kinds.size(); ++i) {
            const float shade = 0.88f + 0.24f * static_cast<float>(i * 2654435761u >> 8 & 255) / 255;
            const uint32_t colour = lighter(k_surface_colours[static_cast<size_t>(kinds[i])], shade);
            std::vector<std::array<Vec3, 3>> pieces{{corners[3 * i], corners[3 * i + 1], corners[3 * i + 2]}};
            while (!pieces.empty()) {
                const auto [a, b, c] = pieces.back();
                pieces.pop_back();
                const float ab = length(b - a), bc = length(c - b), ca = length(a - c);
                if (const float most = std::max({ab, bc, ca}); most > longest && pieces.size() < 64) {
                    const auto [p, q, r] = most == ab   ? std::array{a, b, c}
                                           : most == bc ? std::array{b, c, a}
                                                        : std::array{c, a, b};
                    const Vec3 middle = (p + q) * 0.5f;
                    pieces.push_back({p, middle, r});
                    pieces.push_back({middle, q, r});
                    continue;
                }
                const Vec3 middle = (a + b + c) * (1.0f / 3);
                for (Vec3 corner : {a, b, c}) {
                    const auto hit =
                        ground_at(*world.ground, corner + (middle - corner) * inward, 0.3f, 0.6f);
                    if (hit) corner.y = hit->height;
                    overlay.walkable.push_back({to_glm(corner), colour});
                }
            }
        }
    }
    overlay.fills.insert(overlay.fills.end(), overlay.walkable.begin(), overlay.walkable.end());
}

void add_trails(const OverlayInput& input, Overlay& overlay) {
    const World& world = input.world;
    const Trails& trails = overlay.trails;
    if (trails.places.size() != size_t{world.crowd.count} * k_trail_places) return;
    const uint32_t known = std::min(trails.taken, k_trail_places);
    for (uint32_t i = 0; i < world.crowd.count; ++i) {
        if (!is_there(world.crowd, i)) continue;
        if (!(glm::length(to_glm(place_of(world, i)) - input.camera.eye) < k_trail_reach)) continue;
        const glm::vec3 over = 0.03f * (world.roam ? to_glm(world.roam->walkers.up[i]) : glm::vec3(0, 1, 0));
        Vec3 after = place_of(world, i);
        for (uint32_t age = 0; age < known; ++age) {
            const Vec3 before = trails.places[i * k_trail_places + (trails.taken - 1 - age) % k_trail_places];
            if (length(after - before) < 0.05f) continue;
            const float fresh = 1 - static_cast<float>(age) / k_trail_places;
            // It fades by width: a line thinner than a pixel is faint, and faint ones do not show where they
            // join.
            Pen pen{.pixels = 0.2f + 2.3f * fresh, .place = GizmoPlace::in_world_hidden};
            pen.colour = k_trail_colours[i % std::size(k_trail_colours)];
            add_line(overlay.lines, pen, to_glm(before) + over, to_glm(after) + over);
            after = before;
        }
    }
}

}  // namespace flaneur
