// Vehicles as meshes of a body and wheels, each of which turns about its hub.
#include "assets/props/vehicles.h"

#include <algorithm>
#include <iterator>

#include "assets/colour.h"
#include "assets/outfit.h"
#include "sim/base/levels.h"
#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/world.h"
#include "tools/extract/convert.h"
#include "tools/extract/extract.h"
#include "tools/extract/ids.h"
#include "tools/extract/rider.h"

namespace flaneur {

namespace {

// Tints of paint, of lamps at the end, and of those at the front.
enum VehicleTint : int8_t { own_colour, body_paint, end_lamps, front_lamps };

constexpr uint32_t k_paints[] = {rgb(0xd4d3cf), rgb(0xa9adb0), rgb(0x6c7074), rgb(0x33363a), rgb(0x8e9498),
                                 rgb(0x2f4166), rgb(0x7a2a30), rgb(0x56614f), rgb(0xb3a68c), rgb(0x3b4650)};
constexpr uint32_t k_van_paints[] = {rgb(0xd9d7d1), rgb(0xc9c9c6), rgb(0xd4d3cf), rgb(0x9fa6ad),
                                     rgb(0xc8b24a)};
constexpr uint32_t k_bus_paint = rgb(0xb23a30), k_tram_paint = rgb(0xd9ab2e), k_brakes = rgb(0xff2d1c),
                   k_drives = rgb(0x7d201b), k_lamps = rgb(0xf5efdf);

uint32_t colour_of(PropPart part) {
    switch (part) {
        case PropPart::glass:
            return rgb(0x1c2226);
        case PropPart::tyre:
            return rgb(0x1d1e20);
        case PropPart::alloy:
            return rgb(0xa2a4a6);
        case PropPart::metal:
            return rgb(0x2c2f32);
        default:
            return rgb(0xffffff);
    }
}

VehicleTint tint_of(PropPart part) {
    return part == PropPart::paint   ? body_paint
           : part == PropPart::red   ? end_lamps
           : part == PropPart::light ? front_lamps
                                     : own_colour;
}

void add(PersonMesh& mesh, const PropMesh& from, uint8_t joint) {
    const auto first = static_cast<uint32_t>(mesh.vertices.size());
    mesh.vertices.reserve(mesh.vertices.size() + from.vertices.size());
    for (const PropMesh::Vertex& p : from.vertices) {
        PersonVertex v{};
        v.position = to_glm(p.position);
        v.colour = shaded(colour_of(p.part), p.shade);
        v.normal[0] = packed(p.normal.x), v.normal[1] = packed(p.normal.y), v.normal[2] = packed(p.normal.z);
        v.normal[3] = tint_of(p.part);
        v.joints[0] = joint;
        v.weights[0] = 255;
        v.texture = ~0u;
        mesh.vertices.push_back(v);
    }
    for (const uint32_t index : from.indices) mesh.lods[0].push_back(first + index);
}

VehicleModel model_of(const Vehicle& v, uint32_t number, uint32_t section) {
    if (v.kind == VehicleKind::tram)
        return section == 0                         ? VehicleModel::tram_head
               : section + 1 == k_tram_sections     ? VehicleModel::tram_tail
               : 2 * section + 1 == k_tram_sections ? VehicleModel::tram_collector
                                                    : VehicleModel::tram_middle;
    if (v.kind != VehicleKind::car)
        return static_cast<VehicleModel>(static_cast<int>(VehicleModel::van) + static_cast<int>(v.kind) - 1);
    return static_cast<VehicleModel>(random_bits({1, number, 0, Purpose::colour}) % 3);
}

uint32_t paint_of(const Vehicle& v, uint32_t number) {
    const uint64_t lot = random_bits({2, number, 0, Purpose::colour});
    if (v.kind == VehicleKind::bus) return k_bus_paint;
    if (v.kind == VehicleKind::tram) return k_tram_paint;
    if (v.kind == VehicleKind::van) return k_van_paints[lot % std::size(k_van_paints)];
    return k_paints[lot % std::size(k_paints)];
}

}  // namespace

uint32_t vehicle_mesh_count(const World& world) { return world.roads ? k_vehicle_models : 0; }

std::vector<PersonMesh> extract_vehicles() {
    std::vector<PersonMesh> meshes(k_vehicle_models);
    for (int m = 0; m < k_vehicle_models; ++m) {
        const auto model = static_cast<VehicleModel>(m);
        PersonMesh& mesh = meshes[static_cast<size_t>(m)];
        mesh.lods.resize(1);
        mesh.is_thing = true;
        PropMesh body;
        add_vehicle(body, model);
        add(mesh, body, 0);
        uint8_t joint = 1;
        for (const VehicleWheel& wheel : wheels_of(model)) {
            PropMesh turning;
            add_wheel(turning, model, wheel);
            add(mesh, turning, joint++);
        }
        if (model != VehicleModel::bicycle) continue;
        PropMesh cranks;
        add_cranks(cranks);
        add(mesh, cranks, joint);
    }
    return meshes;
}

// How far bicycle and rider lean who stand with one foot on the ground, and from when on they do.
static constexpr float k_leans = 0.1f, k_foot_down = 0.9f;  // radians; m/s
static constexpr float k_metres_a_turn = 5;                 // of the cranks

namespace {

// What of a vehicle all its parts are drawn by.
struct Drawn {
    VehiclePlace at;
    Quat turn;
    float stands = 0, crank = 0;
    bool on_left = false;
};

Drawn drawn(const Vehicles& vehicles, uint32_t n, uint32_t section, float between) {
    const Vehicle& v = vehicles.all[n];
    const uint32_t at = first_section(vehicles, n) + section;
    Drawn d{place_between(vehicles.previous[at], vehicles.places[at], between), {}};
    d.turn = rotation_y(d.at.heading) * rotation_x(-d.at.pitch);
    if (v.kind != VehicleKind::bicycle) return d;
    const float speed = length(vehicles.places[at].middle - vehicles.previous[at].middle) * 60;
    d.stands = 1 - smoothstep(0, k_foot_down, speed);
    d.on_left = vehicles.map->lanes.drives_left;
    d.crank = wrap_angle(d.at.rolled * (2 * k_pi / k_metres_a_turn));
    d.turn = d.turn * rotation_z(d.stands * (d.on_left ? -k_leans : k_leans));
    return d;
}

void add_joints(const Drawn& d, VehicleModel model, JointTransform* joints) {
    *joints++ = transform_of(d.at.middle, d.turn);
    for (const VehicleWheel& wheel : wheels_of(model)) {
        const Quat rolls = rotation_x(wrap_angle(d.at.rolled / wheel.radius));
        const Quat steers = wheel.steers ? rotation_y(d.at.steer) : Quat{};
        *joints++ = transform_of(d.at.middle + rotate(d.turn, wheel.hub), d.turn * steers * rolls);
    }
    if (model == VehicleModel::bicycle)
        *joints =
            transform_of(d.at.middle + rotate(d.turn, RiderHolds{}.crank), d.turn * rotation_x(d.crank));
}

// One of the grown-ups, with nothing in hand.
uint32_t kind_of_rider(const World& world, uint32_t number) {
    constexpr float k_youngest = 15, k_oldest = 72;  // years
    const auto count = static_cast<uint32_t>(world.kinds.size());
    const auto first = static_cast<uint32_t>(random_bits({3, number, 0, Purpose::colour}) % count);
    for (uint32_t k = 0; k < count; ++k) {
        const Kind& kind = world.kinds[(first + k) % count];
        const bool is_free = kind.body.cane == Vec3{} && kind.body.pram == Vec3{};
        if (is_free && kind.age > k_youngest && kind.age < k_oldest) return (first + k) % count;
    }
    return first;
}

void add_rider(const World& world, const std::vector<Character>& characters, const Drawn& d, uint32_t number,
               const WalkerDraw& bicycle, PeopleFrame& frame) {
    const uint32_t kind = kind_of_rider(world, number);
    const Character& character = characters[kind];
    JointPose joints[k_joint_count];
    ride(character.body, {d.at.middle, d.turn, d.crank, d.stands, d.on_left}, joints);
    WalkerDraw draw;
    draw.mesh = kind;
    draw.is_upright = false;
    draw.id = bicycle.id;
    draw.presence = bicycle.presence;
    draw.centre = to_glm(joints[hips].position);
    draw.radius = k_body_sphere * character.body.height;
    draw.instance.scale = 1;
    draw.instance.palette = static_cast<uint32_t>(frame.palette.size());
    std::ranges::copy(outfit(character.person, world.seed, number), draw.instance.tints);
    frame.palette.resize(frame.palette.size() + k_palette_joints);
    pose_character(character, 1, joints, &frame.palette[draw.instance.palette]);
    frame.walkers.push_back(draw);
}

}  // namespace

void add_vehicles(const World& world, const std::vector<Character>& characters, uint32_t first_mesh,
                  PeopleFrame& frame, float between) {
    const Vehicles& vehicles = world.vehicles;
    const auto first_id = static_cast<uint32_t>(world.movers.all.size() + world.balls.all.size());
    auto add = [&](const Vehicle& v, uint32_t n, uint32_t section) {
        const Drawn d = drawn(vehicles, n, section, between);
        if (d.at.presence <= 0) return;
        const VehicleShape& shape = k_vehicle_shapes[static_cast<size_t>(v.kind)];
        const VehicleModel model = model_of(v, n, section);
        const float length_of_one = shape.length / static_cast<float>(shape.sections);
        WalkerDraw draw =
            thing_to_draw(frame, first_mesh + static_cast<uint32_t>(model),
                          id_of(IdKind::mover, first_id + n), d.at.middle + Vec3{0, shape.height / 2, 0},
                          0.5f * length(Vec3{shape.width + 0.4f, shape.height, length_of_one}));
        draw.presence = static_cast<uint8_t>(d.at.presence * 255);
        const bool brakes = v.speed < 0.1f || v.acceleration < -0.6f;
        draw.instance.tints[body_paint] = paint_of(v, n);
        draw.instance.tints[end_lamps] = brakes && v.kind != VehicleKind::bicycle ? k_brakes : k_drives;
        draw.instance.tints[front_lamps] = k_lamps;
        add_rigid(frame, draw, transform_of(d.at.middle, d.turn));
        add_joints(d, model, frame.palette.data() + draw.instance.palette);
        if (v.kind == VehicleKind::bicycle) add_rider(world, characters, d, n, draw, frame);
    };
    for (uint32_t n = 0; n < vehicles.all.size(); ++n)
        for (uint32_t s = 0; is_there(vehicles.all[n]) && s < sections_of(vehicles.all[n]); ++s)
            add(vehicles.all[n], n, s);
}

}  // namespace flaneur
