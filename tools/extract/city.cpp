#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <vector>

#include "assets/cities.h"
#include "assets/colour.h"
#include "assets/props/props.h"
#include "assets/skin.h"
#include "sim/base/rng.h"
#include "tools/extract/convert.h"
#include "tools/extract/extract.h"
#include "tools/extract/ids.h"
#include "tools/extract/parts.h"

namespace flaneur {

namespace {

constexpr uint32_t k_ground_colours[k_surface_count] = {
    rgb(0x45474a),  // road
    rgb(0xa39e95),  // sidewalk
    rgb(0xd9d5cc),  // crossing: its stripes
    rgb(0xb0a48f),  // plaza
    rgb(0xa99c84),  // path
    rgb(0xa8a195),  // steps
    rgb(0x6f8a4c),  // grass
    rgb(0x3d5560),  // water
    rgb(0x6a635c),  // track: ballast
};
constexpr uint32_t k_ground_materials[k_surface_count] = {
    k_material_road,  k_material_sidewalk, k_material_crossing, k_material_plaza,  k_material_path,
    k_material_steps, k_material_grass,    k_material_water,    k_material_ballast};
constexpr uint32_t k_sleepers = rgb(0x8a8178);
constexpr uint32_t k_kerb = rgb(0x8c8984), k_riser = rgb(0x9a948a), k_garden_wall = rgb(0xb5a88f);
constexpr uint32_t k_flat_roof = rgb(0x8b8983), k_cornice = rgb(0xb5ac9c), k_tile_roof = rgb(0xb5694a),
                   k_slate_roof = rgb(0x5b626b);

CityVertex vertex(Vec3 position, Vec3 normal, uint32_t colour, glm::vec2 uv, uint32_t material,
                  uint16_t extra = 0) {
    CityVertex v{};
    v.position = to_glm(position);
    v.colour = colour;
    v.uv = uv;
    v.normal[0] = packed(normal.x);
    v.normal[1] = packed(normal.y);
    v.normal[2] = packed(normal.z);
    v.material = static_cast<uint16_t>(material);
    v.extra = extra;
    return v;
}

uint32_t add_vertex(CityMesh& mesh, const CityVertex& v) {
    mesh.vertices.push_back(v);
    return static_cast<uint32_t>(mesh.vertices.size() - 1);
}

// Of a mesh that is given by places and triangles: which vertices stand at each place, so that triangles that
// look alike share them.
struct Welds {
    static constexpr uint32_t k_none = ~0u;
    uint32_t first;                // vertex of the mesh that was welded
    std::vector<uint32_t> last;    // of each place: the vertex there that was added last
    std::vector<uint32_t> before;  // of each vertex from `first` on: the one before it at its place
};

Welds welds_of(const CityMesh& mesh, size_t places) {
    return {static_cast<uint32_t>(mesh.vertices.size()), std::vector(places, Welds::k_none), {}};
}

bool is_same(const CityVertex& a, const CityVertex& b) {
    using Bytes = std::array<std::byte, sizeof(CityVertex)>;
    return std::bit_cast<Bytes>(a) == std::bit_cast<Bytes>(b);
}

void add_welded(CityMesh& mesh, Welds& welds, uint32_t place, const CityVertex& v) {
    uint32_t same = welds.last[place];
    while (same != Welds::k_none && !is_same(mesh.vertices[same], v)) same = welds.before[same - welds.first];
    if (same == Welds::k_none) {
        welds.before.push_back(welds.last[place]);
        same = welds.last[place] = add_vertex(mesh, v);
    }
    mesh.indices.push_back(same);
}

void add_ground(CityMesh& mesh, const City& city) {
    Welds welds = welds_of(mesh, city.ground.vertices.size());
    for (size_t t = 0; t < city.ground.kinds.size(); ++t) {
        const uint32_t* corners = &city.ground.indices[3 * t];
        Vec3 p[3];
        for (size_t k = 0; k < 3; ++k) p[k] = city.ground.vertices[corners[k]];
        Vec3 normal = normalize_or(cross(p[1] - p[0], p[2] - p[0]), {0, 1, 0});
        bool bare = city.ground_axes[t] == Vec2{};
        Surface kind = city.ground.kinds[t];
        if (bare && kind != Surface::track) kind = Surface::road;
        bool has_sleepers = kind == Surface::track && !bare;
        auto look = static_cast<size_t>(kind);
        for (size_t k = 0; k < 3; ++k) {
            glm::vec2 uv{p[k].x, p[k].z};
            if (kind == Surface::crossing || has_sleepers)
                uv = {dot(on_ground(p[k]), city.ground_axes[t]), 0};
            CityVertex v = vertex(p[k], normal, has_sleepers ? k_sleepers : k_ground_colours[look], uv,
                                  has_sleepers ? k_material_sleepers : k_ground_materials[look]);
            v.id = id_of(IdKind::ground, static_cast<uint32_t>(kind));
            add_welded(mesh, welds, corners[k], v);
        }
    }
}

static_assert(k_bay == k_bay_width);

// Which bay of which facade has the door that a destination stands before; -1: none.
std::vector<int> find_doors(const City& city) {
    constexpr float k_before = 1.6f;
    std::vector<int> doors(city.ground.faces.size(), -1);
    for (const Destination& place : city.destinations) {
        if (place.kind != DestinationKind::door && place.kind != DestinationKind::shop) continue;
        std::optional<WallPoint> wall =
            closest_wall(city.ground, place.position + Vec3{0, 1.2f, 0}, k_before);
        if (!wall || city.ground.faces[wall->face].kind != FaceKind::facade) continue;
        const Face& f = city.ground.faces[wall->face];
        float width = length(on_ground(f.b - f.a)), u = length(on_ground(wall->point - f.a));
        float bays = std::max(std::round(width / k_bay), 1.0f);
        doors[wall->face] = static_cast<int>(clamp(u / width * bays, 0, bays - 1));
    }
    return doors;
}

WindowKind windows_of(const Building& b) {
    constexpr uint8_t k_brick = 3, k_concrete = 4, k_dark_brick = 8;
    constexpr float k_hall = 4.5f;  // storeys from here on are those of halls and churches
    float drawn = random_unit({b.seed, 3, 0, Purpose::look});
    if (b.storey > k_hall) return WindowKind::arched;
    if (b.style == k_concrete) return WindowKind::wide;
    if (b.style == k_brick || b.style == k_dark_brick)
        return drawn < 0.6f ? WindowKind::arched : WindowKind::sash;
    return drawn < 0.3f ? WindowKind::shuttered : WindowKind::sash;
}

// What has no facade is no house but a wall, and its roof a coping.
std::vector<uint8_t> find_houses(const City& city) {
    std::vector<uint8_t> is_house(city.buildings.size(), 0);
    for (const Face& f : city.ground.faces) {
        if (f.kind == FaceKind::facade && f.building < is_house.size()) is_house[f.building] = 1;
    }
    return is_house;
}

uint32_t id_of_building(const std::vector<uint8_t>& is_house, uint32_t building) {
    return id_of(building < is_house.size() && is_house[building] ? IdKind::house : IdKind::wall, building);
}

uint32_t id_of_face(const std::vector<uint8_t>& is_house, const Face& f) {
    switch (f.kind) {
        case FaceKind::facade:
            return id_of(IdKind::house, f.building);
        case FaceKind::kerb:
            return id_of(IdKind::ground, k_kerb_number);
        case FaceKind::riser:
            return id_of(IdKind::ground, static_cast<uint32_t>(Surface::steps));
        case FaceKind::garden_wall:
            break;
    }
    return id_of_building(is_house, f.building);
}

constexpr float k_foot_shade = 0.84f;  // of sRGB

// Those of `remnants` that are of `index`, which comes later with each call; none: it is whole.
const Remnant* next_remnant(const std::vector<Remnant>& remnants, size_t& next, size_t index) {
    return next < remnants.size() && remnants[next].of == index ? &remnants[next++] : nullptr;
}

void add_fan(CityMesh& mesh, const std::vector<uint32_t>& corners) {
    for (size_t k = 2; k < corners.size(); ++k)
        mesh.indices.insert(mesh.indices.end(), {corners[0], corners[k - 1], corners[k]});
}

void add_faces(CityMesh& mesh, const City& city, const Skin& skin, const std::vector<uint8_t>& is_house) {
    std::vector<int> doors = find_doors(city);
    size_t next = 0;
    for (size_t i = 0; i < city.ground.faces.size(); ++i) {
        const Face& f = city.ground.faces[i];
        Vec3 along = f.b - f.a;
        float width = length(on_ground(along));
        Vec3 normal = normalize_or(cross(Vec3{along.x, 0, along.z}, Vec3{0, 1, 0}), {0, 0, 1});
        uint32_t colour = f.kind == FaceKind::kerb    ? k_kerb
                          : f.kind == FaceKind::riser ? k_riser
                                                      : k_garden_wall;
        uint32_t material = k_material_stone;
        uint16_t extra = 0;
        uint32_t house = 0;
        float foot = std::min(f.a.y, f.b.y);
        if (f.kind == FaceKind::facade) {
            material = k_material_facade;
            if (f.building < city.buildings.size()) {
                const Building& b = city.buildings[f.building];
                house = b.seed;
                float tone = 0.94f + 0.12f * random_unit({b.seed, 0, 0, Purpose::colour});
                colour = shaded(b.wall_colour ? b.wall_colour : k_wall_colours[b.style % k_wall_colour_count],
                                tone);
                // A window in the roof is one storey.
                float high = f.a_top - f.a.y;
                bool is_dormer = f.a.y > b.top && high < b.storey;
                float storey = is_dormer ? high : clamp(b.storey, 1, 20);
                if (b.finish == Finish::glass) storey = k_all_glass;
                if (b.finish == Finish::plain) storey = k_no_windows;
                if (b.finish == Finish::stone) material = k_material_stone;
                extra = facade_extra(storey, is_shop_front(city, f), doors[i], windows_of(b));
                // Storeys are counted from the ground at the door; walls go down to the lowest.
                if (b.base > foot && b.base < foot + 3) foot = b.base;
            } else {
                colour = k_wall_colours[0];
                extra = facade_extra(3.2f, false);
            }
        }
        if (f.kind == FaceKind::garden_wall && f.building < city.buildings.size() &&
            city.buildings[f.building].wall_colour)
            colour = city.buildings[f.building].wall_colour;
        // Walls see less sky at their foot; facades are drawn so.
        float foot_shade = f.kind == FaceKind::facade ? 1 : k_foot_shade;
        uint32_t low = f.kind == FaceKind::facade ? colour : shaded(colour, k_foot_shade);
        auto corner = [&](Vec3 at, float y, float u) {
            CityVertex v = vertex({at.x, y, at.z}, normal, colour, {u, y - foot}, material, extra);
            v.house = house;
            v.id = id_of_face(is_house, f);
            return add_vertex(mesh, v);
        };
        const Remnant* remnant = next_remnant(skin.faces, next, i);
        if (remnant && remnant->pieces.empty()) continue;
        uint32_t a = corner(f.a, f.a.y, 0), b = corner(f.b, f.b.y, width);
        mesh.vertices[a].colour = mesh.vertices[b].colour = low;
        uint32_t c = corner(f.b, f.b_top, width), d = corner(f.a, f.a_top, 0);
        if (!remnant) {
            add_fan(mesh, {a, b, c, d});
            continue;
        }
        // Windows are fitted to what is joined by triangles, if only by some without extent: to all that is
        // left or, where a door has its bay, to the whole wall.
        std::optional<uint32_t> joint;
        if (doors[i] >= 0) {
            joint = a;
            mesh.indices.insert(mesh.indices.end(), {a, c, c});
        }
        for (const std::vector<Vec3>& piece : remnant->pieces) {
            std::vector<uint32_t> fan;
            for (Vec3 p : piece) {
                float u = dot(on_ground(p - f.a), on_ground(along)) / std::max(width, 1e-6f),
                      share = u / width;
                fan.push_back(corner(p, p.y, u));
                float bottom = lerp(f.a.y, f.b.y, share), top = lerp(f.a_top, f.b_top, share);
                float up = clamp((p.y - bottom) / std::max(top - bottom, 1e-3f), 0, 1);
                mesh.vertices[fan.back()].colour = shaded(colour, lerp(foot_shade, 1, up));
            }
            if (joint) mesh.indices.insert(mesh.indices.end(), {*joint, fan[0], fan[0]});
            joint = fan[0];
            add_fan(mesh, fan);
        }
    }
}

void add_roofs(CityMesh& mesh, const City& city, const Skin& skin, const std::vector<uint8_t>& is_house) {
    Welds welds = welds_of(mesh, city.roof_vertices.size());
    size_t next = 0;
    for (size_t t = 0; t < city.roof_buildings.size(); ++t) {
        const uint32_t* corners = &city.roof_indices[3 * t];
        Vec3 p[3];
        for (size_t k = 0; k < 3; ++k) p[k] = city.roof_vertices[corners[k]];
        Vec3 normal = normalize_or(cross(p[1] - p[0], p[2] - p[0]), {0, 1, 0});
        uint32_t building = city.roof_buildings[t];
        uint32_t seed = building < city.buildings.size() ? city.buildings[building].seed : 0;
        RandomKey key{seed, 1, 0, Purpose::colour};
        bool slate = random_unit(key) < 0.4f;
        uint32_t colour = normal.y > 0.95f ? k_flat_roof : slate ? k_slate_roof : k_tile_roof;
        if (normal.y < 0.3f) colour = k_cornice;
        if (building >= is_house.size() || !is_house[building]) colour = k_garden_wall;
        bool is_cornice = building < is_house.size() && is_house[building] && normal.y < 0.3f;
        if (building < city.buildings.size() && city.buildings[building].roof_colour && !is_cornice)
            colour = city.buildings[building].roof_colour;
        colour = shaded(colour, random_between(key, 0.9f, 1.08f, 1));
        const Remnant* remnant = next_remnant(skin.roofs, next, t);
        auto corner = [&](Vec3 at) {
            CityVertex v = vertex(at, normal, colour, {at.x, at.z}, k_material_roof);
            v.id = id_of_building(is_house, building);
            return v;
        };
        for (size_t k = 0; k < 3 && !remnant; ++k) add_welded(mesh, welds, corners[k], corner(p[k]));
        if (!remnant) continue;
        for (const std::vector<Vec3>& piece : remnant->pieces) {
            std::vector<uint32_t> fan;
            for (Vec3 q : piece) {
                welds.before.push_back(Welds::k_none);
                fan.push_back(add_vertex(mesh, corner(q)));
            }
            add_fan(mesh, fan);
        }
    }
}

struct PartLook {
    uint32_t colour, material;
};

PartLook look_of(PropPart part) {
    switch (part) {
        case PropPart::leaves:
            return {rgb(0x6f8a4c), k_material_leaves};
        case PropPart::trunk:
            return {rgb(0x6b5a48), k_material_trunk};
        case PropPart::metal:
            return {rgb(0x3c4044), k_material_metal};
        case PropPart::wood:
            return {rgb(0x8a6a48), k_material_trunk};
        case PropPart::light:
            return {rgb(0xf2ead8), k_material_metal};
        case PropPart::paint:
            return {rgb(0xa9adb0), k_material_metal};
        case PropPart::glass:
            return {rgb(0x1c2226), k_material_metal};
        case PropPart::tyre:
            return {rgb(0x222325), k_material_trunk};
        case PropPart::alloy:
            return {rgb(0x9a9c9e), k_material_metal};
        case PropPart::stone:
            return {rgb(0xc3b8a3), k_material_stone};
        case PropPart::bronze:
            return {rgb(0x54604f), k_material_metal};
        case PropPart::water:
            return {rgb(0x3d5560), k_material_water};
        case PropPart::foam:
            return {rgb(0xd5e0e4), k_material_metal};
        case PropPart::red:
            return {rgb(0x8e2a24), k_material_metal};
        case PropPart::green:
            return {rgb(0x3f8f62), k_material_metal};
        case PropPart::sign:
            return {rgb(0xc59a3d), k_material_metal};
        case PropPart::white:
            return {rgb(0xd8d6d0), k_material_metal};
        case PropPart::drive_red:
            return {rgb(0xff2417), k_material_lens};
        case PropPart::walk_red:
            return {rgb(0xff2a1a), k_material_lens};
        case PropPart::drive_amber:
            return {rgb(0xffa512), k_material_lens};
        case PropPart::drive_green:
        case PropPart::walk_green:
            return {rgb(0x1dff8a), k_material_lens};
    }
    return {rgb(0xffffff), k_material_metal};
}

// White, silver, greys and blacks, and a few quiet colours.
constexpr uint32_t k_car_colours[] = {rgb(0xd4d3cf), rgb(0xa9adb0), rgb(0x6c7074), rgb(0x2a2c2f),
                                      rgb(0x8e9498), rgb(0x2f3d57), rgb(0x5f2a30), rgb(0x56614f),
                                      rgb(0xb3a68c), rgb(0x3b4650)};
// Leaves in the light are yellower, those in the crown's shade bluer.
uint32_t leaf_colour(uint32_t leaves, float shade) {
    float light = clamp((shade - 0.5f) * 1.6f, 0, 1);
    auto channel = [&](int shift, float dark, float bright) {
        float value = static_cast<float>(leaves >> shift & 0xffu) * shade * lerp(dark, bright, light);
        return static_cast<uint32_t>(clamp(value, 0, 255)) << shift;
    };
    return 0xff000000u | channel(0, 0.86f, 1.1f) | channel(8, 0.98f, 1.02f) | channel(16, 1.12f, 0.86f);
}

// From fresh to deep green.
constexpr uint32_t k_leaves[] = {rgb(0x87994e), rgb(0x718d48), rgb(0x5f7d45), rgb(0x557348)};

constexpr glm::vec2 k_within{0.45f, 0.45f};  // of a slab, clear of its joints

// Parked cars have their lamps off.
bool is_lit_sign(PropKind kind, PropPart part) {
    if (kind == PropKind::shelter) return part == PropPart::light;
    return kind == PropKind::signal && (part == PropPart::red || part == PropPart::green);
}

// When a lens is lit, as CityVertex::uv has it.
glm::vec2 timing_of(const LampPlan& plan, PropPart lens) {
    uint32_t from = plan.walk_ends, until = plan.walk;
    if (lens == PropPart::walk_green) from = plan.walk, until = plan.walk_ends;
    if (lens == PropPart::drive_green) from = plan.drive, until = plan.drive_ends;
    const uint32_t stops = (plan.drive_ends + k_amber) % plan.cycle;
    if (lens == PropPart::drive_amber) from = plan.drive_ends, until = stops;
    if (lens == PropPart::drive_red) from = stops, until = plan.drive;
    auto steps = [](uint32_t low, uint32_t high) {
        const uint32_t first = low / k_lamp_ticks, last = high / k_lamp_ticks;
        return static_cast<float>(first) + static_cast<float>(last) * k_lens_unit;
    };
    return {steps(plan.shift, plan.cycle), steps(from, until)};
}

IdKind id_kind(PropKind kind) {
    if (kind == PropKind::tree) return IdKind::tree;
    return kind == PropKind::car ? IdKind::car : IdKind::prop;
}

void add_props(CityMesh& mesh, const City& city) {
    mesh.seen_from.assign(mesh.indices.size() / 3, SeenFrom::anywhere);
    for (uint32_t number = 0; number < city.props.size(); ++number) {
        const Prop& prop = city.props[number];
        const uint32_t crossing =
            prop.kind == PropKind::signal ? crossing_of_post(city.crossings, prop.position) : k_no_lamp;
        const LampPlan* plan =
            crossing == k_no_lamp ? nullptr : &city.crossings.plans[city.crossings.all[crossing].plan];
        auto make = [&](PropMesh& to) {
            if (plan)
                add_working_signal(to, prop, heads_of(prop, city.crossings.all[crossing]));
            else
                add_prop(to, prop);
        };
        PropMesh made;
        make(made);
        mesh.seen_from.resize(mesh.seen_from.size() + made.indices.size() / 3, SeenFrom::near);
        PropMesh coarse;
        coarse.is_far = true;
        make(coarse);
        mesh.seen_from.resize(mesh.seen_from.size() + coarse.indices.size() / 3, SeenFrom::far);
        RandomKey key{prop.seed, 2, 0, Purpose::colour};
        uint32_t leaves =
            shaded(k_leaves[random_bits(key, 0) % std::size(k_leaves)], random_between(key, 0.92f, 1.08f, 2));
        uint32_t paint = k_car_colours[random_bits(key, 1) % std::size(k_car_colours)];
        for (const PropMesh* some : {&made, &coarse}) {
            auto first = static_cast<uint32_t>(mesh.vertices.size());
            for (const auto& v : some->vertices) {
                auto [colour, material] = look_of(v.part);
                if (v.part == PropPart::paint) colour = paint;
                if (v.part == PropPart::light && prop.kind == PropKind::lamp) material = k_material_light;
                if (is_lit_sign(prop.kind, v.part)) material = k_material_signal;
                colour = v.part == PropPart::leaves ? leaf_colour(leaves, v.shade) : shaded(colour, v.shade);
                const glm::vec2 uv = material == k_material_lens ? timing_of(*plan, v.part) : k_within;
                CityVertex drawn = vertex(v.position, v.normal, colour, uv, material);
                drawn.id = id_of(id_kind(prop.kind), number);
                add_vertex(mesh, drawn);
            }
            for (uint32_t i : some->indices) mesh.indices.push_back(first + i);
        }
    }
}

}  // namespace

// Shops look onto streets and squares, not onto gardens and yards.
bool is_shop_front(const City& city, const Face& f) {
    if (f.building >= city.buildings.size() || !city.buildings[f.building].has_shop) return false;
    Vec2 along = on_ground(f.b) - on_ground(f.a);
    Vec2 out = normalize_or(Vec2{-along.z, along.x}, {1, 0});
    Vec2 before = lerp(on_ground(f.a), on_ground(f.b), 0.5f) + out * 1.5f;
    std::optional<GroundHit> hit = ground_at(city.ground, at_height(before, f.a.y), 3, 3);
    return !hit || (hit->kind != Surface::grass && hit->kind != Surface::path);
}

CityMesh extract_city(const City& city) {
    CityMesh mesh;
    if (!city.scenery.holds_ground) add_ground(mesh, city);
    const Skin skin = skin_of(city);
    const std::vector<uint8_t> is_house = find_houses(city);
    add_faces(mesh, city, skin, is_house);
    add_roofs(mesh, city, skin, is_house);
    add_shades(city, mesh);
    add_scenery(city.scenery, mesh);
    add_props(mesh, city);
    return mesh;
}

SceneMeshes extract_scene(const City& city, const std::vector<Character>& characters) {
    SceneMeshes scene;
    scene.city = extract_city(city);
    for (const Character& c : characters) scene.people.push_back(extract_character(c));
    return scene;
}

}  // namespace flaneur
