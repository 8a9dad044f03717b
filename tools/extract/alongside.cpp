// What goes along with people, as meshes that move by joints of their own.
#include "sim/alongside/alongside.h"

#include <algorithm>
#include <cmath>

#include "assets/alongside/thing.h"
#include "assets/character.h"
#include "assets/colour.h"
#include "sim/base/math.h"
#include "sim/base/spans.h"
#include "sim/coming/passages.h"
#include "sim/world.h"
#include "tools/extract/convert.h"
#include "tools/extract/extract.h"
#include "tools/extract/ids.h"

namespace flaneur {

namespace {

// Meshes in their order, after the dogs'.
enum Thing : uint32_t {
    thing_lead = k_breeds * k_coats,
    thing_chair,
    thing_white_cane,
    thing_umbrella,
    thing_guitar,
    thing_violin,
    thing_bow,
    thing_accordion,
    thing_hat,
};

PersonMesh to_mesh(const ThingMesh& thing) {
    PersonMesh mesh;
    mesh.is_thing = true;
    mesh.lods = thing.lods;
    mesh.vertices.reserve(thing.vertices.size());
    for (const ThingVertex& v : thing.vertices) {
        PersonVertex out{};
        out.position = to_glm(v.position);
        out.colour = v.colour;
        out.normal[0] = packed(v.normal.x), out.normal[1] = packed(v.normal.y),
        out.normal[2] = packed(v.normal.z);
        out.normal[3] = static_cast<int8_t>(v.tinted ? Tint::top : Tint::none);
        std::ranges::copy(v.joints, out.joints);
        std::ranges::copy(v.weights, out.weights);
        out.texture = ~0u;
        mesh.vertices.push_back(out);
    }
    return mesh;
}

JointTransform transform_of(const Placement& p) { return flaneur::transform_of(p.position, p.turn); }

struct Adder {
    const World& world;
    uint32_t first_mesh;
    PeopleFrame& frame;
    float between;

    // One thing of a walker; who comes or goes is seen as much as that one.
    WalkerDraw& begin(uint32_t thing, uint32_t walker, Vec3 centre, float radius, float scale = 1) {
        WalkerDraw draw =
            thing_to_draw(frame, first_mesh + thing, id_of(IdKind::walker, walker), centre, radius, scale);
        if (const Passage* passage = passage_of(world.crowd, walker))
            draw.presence = static_cast<uint8_t>(255 * presence(*passage, between) + 0.5f);
        frame.walkers.push_back(draw);
        return frame.walkers.back();
    }
    void end() {
        const WalkerDraw& draw = frame.walkers.back();
        frame.palette.resize(draw.instance.palette + k_palette_joints, frame.palette.back());
    }
    void add(uint32_t thing, uint32_t walker, const Placement& at, float radius, float scale) {
        begin(thing, walker, at.position, radius, scale);
        frame.palette.push_back(transform_of(at));
        end();
    }
};

DogPose pose_between(const Alongside& a, const Dog& dog, float between) {
    DogPose pose = pose_dog(dog);
    const Dog* before = own_of(a.previous_dogs, dog.walker);
    if (!before || between >= 1) return pose;
    const DogPose was = pose_dog(*before);
    for (size_t j = 0; j < pose.size(); ++j)
        pose[j] = {lerp(was[j].position, pose[j].position, between),
                   nlerp(was[j].rotation, pose[j].rotation, between)};
    return pose;
}

// Places of a cord that hangs between two, as long as it is, `count` of them evenly along it: a catenary.
void hang_cord(Vec3 from, Vec3 to, float length_of_it, float floor, Vec3* places, int count) {
    const Vec3 by = to - from;
    const Vec2 flat = on_ground(by);
    const float d = std::max(length(flat), 0.03f), v = by.y;
    const float whole = std::max(length_of_it, 1.001f * std::sqrt(d * d + v * v));
    const float ratio = std::sqrt(std::max(whole * whole - v * v, 1.00001f * d * d)) / d;
    // sinh(u) / u = ratio
    float low = 1e-3f, high = 12;
    for (int k = 0; k < 40; ++k) {
        const float u = 0.5f * (low + high);
        (std::sinh(u) / u < ratio ? low : high) = u;
    }
    const float u = 0.5f * (low + high), a = d / (2 * u);
    const float lowest = 0.5f * d - a * std::asinh(v / (2 * a * std::sinh(u)));
    const float base = std::cosh(-lowest / a), arc = std::sinh(-lowest / a);
    const Vec2 way = normalize_or(flat, {0, 1});
    for (int k = 0; k < count; ++k) {
        const float s = whole * static_cast<float>(k) / static_cast<float>(count - 1);
        const float x = lowest + a * std::asinh(arc + s / a);
        Vec3 at = from + at_height(way * x, a * (std::cosh((x - lowest) / a) - base));
        at.y = std::max(at.y, floor + 0.008f);
        places[k] = at;
    }
}

void add_lead(Adder& adder, const Dog& dog, Vec3 collar) {
    const World& w = adder.world;
    const Vec3 hand = palm_between(
        w, dog.walker,
        (w.gait.people[dog.walker / k_block].free_hands[dog.walker % k_block] & 1) != 0 ? k_left : k_right,
        adder.between);
    // What is too long is gathered in the hand.
    const float far = length(collar - hand), long_of = std::max(std::min(1.10f * far + 0.05f, 2.4f), far);
    Vec3 places[k_lead_joints];
    hang_cord(hand, collar, long_of, std::min(dog.position.y, w.crowd.motion.position[dog.walker].y), places,
              k_lead_joints);
    adder.begin(thing_lead, dog.walker, lerp(hand, collar, 0.5f), 0.5f * long_of + 0.1f);
    for (int k = 0; k < k_lead_joints; ++k) {
        const Vec3 along = places[std::min(k + 1, k_lead_joints - 1)] - places[std::max(k - 1, 0)];
        adder.frame.palette.push_back(
            transform_of({places[k], rotation_between({0, 1, 0}, normalize_or(along, {0, 1, 0}))}));
    }
    adder.end();
}

void add_dog(Adder& adder, const Dog& dog) {
    const DogPose pose = pose_between(*adder.world.alongside, dog, adder.between);
    const DogShape& shape = shape_of(dog.breed);
    const float size = withers_of(dog);
    const uint32_t mesh = static_cast<uint32_t>(dog.breed) * k_coats + dog.coat % k_coats;
    adder.begin(mesh, dog.walker, pose[dog_loin].position, 1.6f * size, size);
    for (size_t j = 0; j < pose.size(); ++j)
        adder.frame.palette.push_back(transform_of(
            {pose[j].position - rotate(pose[j].rotation, shape.joints[j] * size), pose[j].rotation}));
    adder.end();
    add_lead(adder, dog, collar_of(dog, pose));
}

void add_chair(Adder& adder, size_t number) {
    const World& w = adder.world;
    const Chair& chair = w.alongside->chairs[number];
    const Placement at = chair_between(w, number, adder.between);
    const float size = w.gait.people[chair.walker / k_block].height[chair.walker % k_block] / 1.72f;
    adder.begin(thing_chair, chair.walker, to_world(at, {0, 0.5f, 0.2f}), 1.0f * size, size);
    adder.frame.palette.push_back(transform_of(at));
    const Chair* before = own_of(w.alongside->previous_chairs, chair.walker);
    for (const int side : {0, 1}) {
        const float was = before ? before->wheels[side] : chair.wheels[side];
        const float turned = was + wrap_angle(chair.wheels[side] - was) * adder.between;
        adder.frame.palette.push_back(
            transform_of({to_world(at, Vec3{0, k_chair_wheel * size, 0}), at.turn * rotation_x(turned)}));
    }
    adder.end();
}

void add_held(Adder& adder, const Companion& c) {
    const World& w = adder.world;
    const float size = w.gait.people[c.walker / k_block].height[c.walker % k_block] / 1.72f;
    if (is_down(w.crowd, c.walker) && c.what != Along::umbrella) return;
    const Placement at = held_between(w, c, adder.between);
    constexpr uint32_t k_cloths[] = {rgb(0x20242c), rgb(0x8d2b30), rgb(0x2d4f7a),
                                     rgb(0x39594a), rgb(0xd2a83e), rgb(0x20242c)};
    switch (c.what) {
        case Along::white_cane:
            return adder.add(thing_white_cane, c.walker, at, 1.4f * size, size);
        case Along::umbrella:
            adder.add(thing_umbrella, c.walker, at, 1.2f * size, size);
            adder.frame.walkers.back().instance.tints[static_cast<size_t>(Tint::top)] =
                k_cloths[c.walker % std::size(k_cloths)];
            return;
        case Along::guitar:
            return adder.add(thing_guitar, c.walker, at, 0.9f * size, size);
        case Along::violin:
            adder.add(thing_violin, c.walker, at, 0.5f * size, size);
            return adder.add(thing_bow, c.walker, bow_between(w, c, adder.between), 0.9f * size, size);
        case Along::accordion: {
            adder.begin(thing_accordion, c.walker, at.position, 0.7f * size, size);
            for (const Side side : {k_right, k_left}) {
                const Vec3 palm = palm_between(w, c.walker, side, adder.between);
                // Both halves stay in line before the chest.
                const Vec3 own = to_own(at, palm);
                adder.frame.palette.push_back(transform_of({to_world(at, {own.x, 0, 0}), at.turn}));
            }
            return adder.end();
        }
        default:
            return;
    }
}

}  // namespace

std::vector<PersonMesh> extract_alongside(const World& world) {
    std::vector<PersonMesh> meshes;
    if (!world.alongside) return meshes;
    for (int breed = 0; breed < k_breeds; ++breed)
        for (const ThingMesh& coat : make_dog_meshes(static_cast<Breed>(breed)))
            meshes.push_back(to_mesh(coat));
    for (const ThingMesh& thing :
         {make_lead(), make_wheelchair(), make_white_cane(), make_umbrella(), make_guitar(), make_violin(),
          make_bow(), make_accordion(), make_hat_on_ground()})
        meshes.push_back(to_mesh(thing));
    return meshes;
}

void add_alongside(const World& world, uint32_t first_mesh, PeopleFrame& frame, float between) {
    if (!world.alongside) return;
    const Alongside& a = *world.alongside;
    Adder adder{world, first_mesh, frame, between};
    for (const Dog& dog : a.dogs) add_dog(adder, dog);
    for (size_t k = 0; k < a.chairs.size(); ++k) add_chair(adder, k);
    for (const Companion& c : a.companions)
        if (c.what != Along::dog && c.what != Along::wheelchair) add_held(adder, c);
    for (const Player& p : a.players)
        if (p.stands != 0) adder.add(thing_hat, p.walker, {p.hat, rotation_y(heading_of(p.facing))}, 0.2f, 1);
}

}  // namespace flaneur
