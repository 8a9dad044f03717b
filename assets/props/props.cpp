#include "assets/props/props.h"

#include <algorithm>
#include <utility>

#include "assets/props/shapes.h"

namespace flaneur {

namespace {

void add_lamp(PropMesh& mesh, const Prop& lamp) {
    Vec3 up{0, lamp.height, 0};
    add_post(mesh, lamp.position, lamp.position + Vec3{0, 0.7f, 0}, 0.09f, 0.08f, 8, PropPart::metal, false);
    add_post(mesh, lamp.position + Vec3{0, 0.7f, 0}, lamp.position + up, 0.055f, 0.035f, 8, PropPart::metal,
             false);
    Vec2 out = heading_direction(lamp.yaw) * 0.55f;
    Vec3 head = lamp.position + up + at_height(out, 0.08f);
    add_post(mesh, lamp.position + up, head, 0.035f, 0.03f, 6, PropPart::metal, false);
    add_box(mesh, head, {0.11f, 0.045f, 0.26f}, lamp.yaw, PropPart::metal);
    add_box(mesh, head - Vec3{0, 0.05f, 0}, {0.09f, 0.01f, 0.22f}, lamp.yaw, PropPart::light);
}

void add_bench(PropMesh& mesh, const Prop& bench) {
    Quat turn = rotation_y(bench.yaw);
    auto part = [&](Vec3 centre, Vec3 half, PropPart what) {
        add_box(mesh, bench.position + rotate(turn, centre), half, bench.yaw, what);
    };
    for (float z : {-0.15f, 0.0f, 0.15f}) part({0, 0.44f, z}, {0.9f, 0.02f, 0.06f}, PropPart::wood);
    for (float y : {0.62f, 0.78f}) part({0, y, -0.25f}, {0.9f, 0.06f, 0.02f}, PropPart::wood);
    for (float x : {-0.75f, 0.75f}) {
        part({x, 0.21f, 0}, {0.03f, 0.21f, 0.2f}, PropPart::metal);
        part({x, 0.6f, -0.27f}, {0.03f, 0.25f, 0.02f}, PropPart::metal);
    }
}

void add_bin(PropMesh& mesh, const Prop& bin) {
    float h = bin.height;
    add_turned(mesh, bin.position,
               {{0.19f, 0},
                {0.19f, 0.06f},
                {0.22f, 0.08f},
                {0.24f, h * 0.8f},
                {0.25f, h * 0.82f},
                {0.25f, h * 0.9f},
                {0.17f, h},
                {0.1f, h},
                {0.09f, h * 0.92f},
                {0, h * 0.9f}},
               10, PropPart::metal);
}

void add_planter(PropMesh& mesh, const Prop& planter) {
    PropFrame f(planter);
    add_box(mesh, f.at(0, 0.27f, 0), {0.58f, 0.27f, 0.58f}, planter.yaw, PropPart::stone);
    for (auto [x, z] : {std::pair{0.555f, 0.0f}, {-0.555f, 0.0f}}) {
        add_box(mesh, f.at(x, 0.545f, z), {0.045f, 0.035f, 0.6f}, planter.yaw, PropPart::stone);
        add_box(mesh, f.at(z, 0.545f, x), {0.51f, 0.035f, 0.045f}, planter.yaw, PropPart::stone);
    }
    RandomKey key{planter.seed, 0, 0, Purpose::tree};
    Vec3 crown = f.at(0, 0.62f, 0), size{0.6f, planter.height - 0.5f, 0.6f};
    for (uint32_t i = 0; i < 3; ++i) {
        SinCos turn = sin_cos(2.1f * static_cast<float>(i) + planter.yaw);
        add_clump(mesh, crown + Vec3{turn.sine * 0.2f, 0.05f, turn.cosine * 0.2f}, size * 0.55f, crown, size,
                  key, i * 64);
    }
}

void add_signal(PropMesh& mesh, const Prop& signal) {
    PropFrame f(signal);
    float h = signal.height;
    add_post(mesh, f.origin, f.at(0, h, 0), 0.06f, 0.05f, 8, PropPart::metal, true);
    add_box(mesh, f.at(0, h - 0.5f, 0.14f), {0.15f, 0.45f, 0.1f}, signal.yaw, PropPart::metal);
    const PropPart lamps[] = {PropPart::red, PropPart::tyre, PropPart::green};
    for (int i = 0; i < 3; ++i) {
        float y = h - 0.22f - 0.28f * static_cast<float>(i);
        PropPart lit = i == 0 ? lamps[0] : PropPart::tyre;
        add_post(mesh, f.at(0, y, 0.2f), f.at(0, y, 0.255f), 0.1f, 0.09f, 8, lit, true);
        add_box(mesh, f.at(0, y + 0.11f, 0.3f), {0.1f, 0.012f, 0.07f}, signal.yaw, PropPart::metal);
    }
    // For those on foot, across.
    add_box(mesh, f.at(-0.13f, 2.25f, 0), {0.08f, 0.22f, 0.1f}, signal.yaw, PropPart::metal);
    add_box(mesh, f.at(-0.22f, 2.15f, 0), {0.015f, 0.07f, 0.07f}, signal.yaw, PropPart::green);
}

void add_shelter(PropMesh& mesh, const Prop& shelter) {
    PropFrame f(shelter);
    float h = shelter.height;
    auto part = [&](float x, float y, float z, Vec3 half, PropPart what) {
        add_box(mesh, f.at(x, y, z), half, shelter.yaw, what);
    };
    part(0, h - 0.05f, 0.05f, {1.8f, 0.05f, 0.72f}, PropPart::metal);
    for (float x : {-1.65f, -0.55f, 0.55f, 1.65f})
        part(x, h * 0.5f, -0.55f, {0.04f, h * 0.5f, 0.04f}, PropPart::metal);
    for (float y : {0.55f, 1.1f, 2.2f}) part(0, y, -0.55f, {1.65f, 0.025f, 0.02f}, PropPart::metal);
    part(1.1f, 1.35f, -0.55f, {0.5f, 0.72f, 0.05f}, PropPart::light);
    part(1.1f, 1.35f, -0.55f, {0.55f, 0.78f, 0.04f}, PropPart::metal);
    part(-0.55f, 0.45f, -0.3f, {0.95f, 0.025f, 0.17f}, PropPart::wood);
    for (float x : {-1.3f, 0.2f}) part(x, 0.22f, -0.3f, {0.03f, 0.21f, 0.14f}, PropPart::metal);
    // The stop's sign on its post.
    part(-1.7f, h + 0.25f, 0.6f, {0.03f, 0.3f, 0.22f}, PropPart::sign);
    part(-1.7f, h * 0.5f, 0.6f, {0.035f, h * 0.5f, 0.035f}, PropPart::metal);
}

// Planks in red and white on two feet.
void add_barrier(PropMesh& mesh, const Prop& barrier) {
    constexpr float k_stripe = 0.25f;  // metres, about
    PropFrame f(barrier);
    const float half = barrier.radius - 0.03f, h = barrier.height;
    auto part = [&](float x, float y, float z, Vec3 size, PropPart what) {
        add_box(mesh, f.at(x, y, z), size, barrier.yaw, what);
    };
    for (float x : {-half + 0.12f, half - 0.12f}) {
        part(x, 0.03f, 0, {0.04f, 0.03f, 0.25f}, PropPart::tyre);
        part(x, h * 0.5f, -0.035f, {0.03f, h * 0.5f, 0.02f}, PropPart::metal);
    }
    const int stripes = mesh.is_far ? 3 : std::max(3, static_cast<int>(2 * half / k_stripe) | 1);
    const float width = 2 * half / static_cast<float>(stripes);
    for (float y : {h - 0.1f, h - 0.45f})
        for (int i = 0; i < stripes; ++i)
            part(-half + (static_cast<float>(i) + 0.5f) * width, y, 0, {width * 0.5f, 0.1f, 0.015f},
                 i % 2 == 0 ? PropPart::red : PropPart::white);
    part(0, h + 0.05f, 0, {0.05f, 0.07f, 0.03f}, PropPart::sign);
}

}  // namespace

void add_prop(PropMesh& mesh, const Prop& prop) {
    switch (prop.kind) {
        case PropKind::tree:
            return add_tree(mesh, prop);
        case PropKind::lamp:
            return add_lamp(mesh, prop);
        case PropKind::bench:
            return add_bench(mesh, prop);
        case PropKind::bollard:
            return add_post(mesh, prop.position, prop.position + Vec3{0, prop.height, 0}, 0.07f, 0.06f, 8,
                            PropPart::metal, true);
        case PropKind::bin:
            return add_bin(mesh, prop);
        case PropKind::car:
            return add_car(mesh, prop);
        case PropKind::fountain:
            return add_fountain(mesh, prop);
        case PropKind::statue:
            return add_statue(mesh, prop);
        case PropKind::planter:
            return add_planter(mesh, prop);
        case PropKind::signal:
            return add_signal(mesh, prop);
        case PropKind::shelter:
            return add_shelter(mesh, prop);
        case PropKind::barrier:
            return add_barrier(mesh, prop);
    }
}

}  // namespace flaneur
