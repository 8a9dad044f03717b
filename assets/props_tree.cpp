#include <cmath>

#include "assets/props_shapes.h"

namespace flaneur {

// Five to seven clumps about a larger one.
static void add_crown(PropMesh& mesh, Vec3 centre, float radius, float half_height, RandomKey key) {
    Vec3 size{radius, half_height, radius};
    add_clump(mesh, centre + Vec3{0, 0.12f * half_height, 0}, size * 0.72f, centre, size, key, 1000);
    uint32_t clumps = 5 + static_cast<uint32_t>(random_bits(key, 0) % 3);
    float turn = random_between(key, 0, 2 * k_pi, 1);
    for (uint32_t i = 0; i < clumps; ++i) {
        // Golden-angle steps round the crown, alternately low and high.
        SinCos around = sin_cos(turn + 2.399963f * static_cast<float>(i));
        float up = (i % 2 ? 0.35f : -0.35f) + random_between(key, -0.18f, 0.18f, 10 + i);
        float away = 0.56f * std::sqrt(1 - up * up);
        Vec3 at = centre +
                  Vec3{around.sine * away * radius, up * 0.72f * half_height, around.cosine * away * radius};
        float share = random_between(key, 0.42f, 0.54f, 30 + i);
        add_clump(mesh, at, size * share, centre, size, key, 2000 + i * 64);
    }
}

void add_tree(PropMesh& mesh, const Prop& tree) {
    RandomKey key{tree.seed, 0, 0, Purpose::tree};
    float fork = tree.height * random_between(key, 0.30f, 0.38f, 100);
    float thickness = 0.018f * tree.height + 0.04f;
    Vec3 lean{random_between(key, -0.03f, 0.03f, 101), 1, random_between(key, -0.03f, 0.03f, 102)};
    Vec3 crown_foot = tree.position + lean * fork;
    add_post(mesh, tree.position, crown_foot + lean * (0.25f * tree.height), thickness, thickness * 0.6f, 7,
             PropPart::trunk, false);
    float half = (tree.height - fork) * 0.52f;
    add_crown(mesh, crown_foot + lean * half, tree.radius, half, key);
}

}  // namespace flaneur
