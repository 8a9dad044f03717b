// What stands in the middle of squares and parks.
#include "assets/props/shapes.h"

namespace flaneur {

void add_fountain(PropMesh& mesh, const Prop& fountain) {
    Vec3 foot = fountain.position;
    float r = fountain.radius, h = fountain.height;
    // The basin's wall, its inner side, and the water in it.
    add_turned(mesh, foot,
               {{r, 0},
                {r, 0.12f},
                {r - 0.08f, 0.14f},
                {r - 0.08f, 0.46f},
                {r + 0.02f, 0.5f},
                {r + 0.02f, 0.58f},
                {r - 0.36f, 0.58f},
                {r - 0.36f, 0.3f}},
               24, PropPart::stone);
    add_turned(mesh, foot, {{r - 0.35f, 0.42f}, {0.3f, 0.425f}}, 24, PropPart::water);
    float bowl = r * 0.42f, top = h * 0.52f;
    add_turned(mesh, foot,
               {{0.62f, 0.3f},
                {0.55f, 0.62f},
                {0.26f, 0.75f},
                {0.2f, top * 0.72f},
                {0.3f, top * 0.86f},
                {bowl * 0.8f, top * 0.94f},
                {bowl, top},
                {bowl - 0.1f, top + 0.03f},
                {bowl - 0.14f, top - 0.06f},
                {0.12f, top - 0.06f}},
               16, PropPart::stone);
    add_turned(mesh, foot, {{bowl - 0.12f, top - 0.03f}, {0.1f, top - 0.02f}}, 16, PropPart::water);
    float upper = bowl * 0.45f, peak = h * 0.84f;
    add_turned(mesh, foot,
               {{0.22f, top - 0.1f},
                {0.13f, top + 0.25f},
                {0.11f, peak * 0.92f},
                {upper, peak},
                {upper - 0.06f, peak + 0.03f},
                {0.1f, peak - 0.02f},
                {0.12f, h * 0.9f},
                {0.16f, h * 0.94f},
                {0.1f, h * 0.985f},
                {0, h}},
               12, PropPart::stone);
    // Water over the edges of both bowls, as thin falling threads.
    constexpr uint32_t k_threads = 18;
    RandomKey key{fountain.seed, 0, 0, Purpose::look};
    for (uint32_t i = 0; i < k_threads; ++i) {
        float step = static_cast<float>(i) + random_between(key, 0.2f, 0.8f, i);
        SinCos turn = sin_cos(2 * k_pi * step / k_threads);
        Vec3 out{turn.sine, 0, turn.cosine};
        bool is_upper = i % 3 == 0;
        float edge = is_upper ? upper : bowl, high = is_upper ? peak : top, low = is_upper ? top : 0.42f;
        float speed = random_between(key, 0.8f, 1.3f, 100 + i);
        auto fallen = [&](float share) {  // a parabola
            return foot + out * (edge - 0.02f + 0.16f * speed * share) +
                   Vec3{0, lerp(high, low, share * share) + 0.01f, 0};
        };
        add_post(mesh, fallen(0.45f), fallen(0), 0.011f, 0.02f, 3, PropPart::foam, false);
        add_post(mesh, fallen(1), fallen(0.45f), 0.015f, 0.011f, 3, PropPart::foam, false);
    }
}

void add_statue(PropMesh& mesh, const Prop& statue) {
    PropFrame f(statue);
    float plinth = statue.height * 0.48f, tall = statue.height - plinth;
    add_box(mesh, f.at(0, 0.07f, 0), {0.75f, 0.07f, 0.75f}, statue.yaw, PropPart::stone);
    add_box(mesh, f.at(0, 0.21f, 0), {0.62f, 0.07f, 0.62f}, statue.yaw, PropPart::stone);
    add_box(mesh, f.at(0, plinth * 0.5f + 0.14f, 0), {0.45f, plinth * 0.5f - 0.14f, 0.45f}, statue.yaw,
            PropPart::stone);
    add_box(mesh, f.at(0, plinth - 0.05f, 0), {0.54f, 0.06f, 0.54f}, statue.yaw, PropPart::stone);
    // A standing figure in a long coat, an arm raised: widths in shares of its height.
    auto at = [&](float x, float y, float z) { return f.at(x * tall, plinth + y * tall, z * tall); };
    add_turned(mesh, at(0, 0, 0),
               {{0.13f * tall, 0},
                {0.12f * tall, 0.03f * tall},
                {0.105f * tall, 0.3f * tall},
                {0.085f * tall, 0.52f * tall},
                {0.075f * tall, 0.6f * tall},
                {0.105f * tall, 0.74f * tall},
                {0.1f * tall, 0.8f * tall},
                {0.035f * tall, 0.835f * tall},
                {0.032f * tall, 0.87f * tall}},
               10, PropPart::bronze);
    RandomKey key{statue.seed, 0, 0, Purpose::tree};
    Vec3 head = at(0, 0.925f, 0.01f), size{0.055f * tall, 0.075f * tall, 0.06f * tall};
    add_clump(mesh, head, size, head, size, key, 0, 1, PropPart::bronze);
    add_post(mesh, at(0.1f, 0.78f, 0), at(0.16f, 0.62f, 0.03f), 0.036f * tall, 0.03f * tall, 6,
             PropPart::bronze, true);
    add_post(mesh, at(0.16f, 0.62f, 0.03f), at(0.13f, 0.52f, 0.13f), 0.03f * tall, 0.022f * tall, 6,
             PropPart::bronze, true);
    add_post(mesh, at(-0.1f, 0.78f, 0), at(-0.17f, 0.7f, 0.1f), 0.036f * tall, 0.03f * tall, 6,
             PropPart::bronze, true);
    add_post(mesh, at(-0.17f, 0.7f, 0.1f), at(-0.18f, 0.86f, 0.22f), 0.03f * tall, 0.02f * tall, 6,
             PropPart::bronze, true);
}

}  // namespace flaneur
