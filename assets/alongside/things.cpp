#include <cmath>

#include "assets/alongside/thing.h"
#include "assets/colour.h"
#include "assets/people/shapes/solid.h"
#include "sim/alongside/alongside.h"
#include "sim/base/math.h"

namespace flaneur {

namespace {

struct Maker {
    ThingMesh mesh;
    Maker() { mesh.lods.resize(1); }

    void add(const SolidMesh& solid, uint32_t colour, uint8_t joint = 0) {
        const auto first = static_cast<uint32_t>(mesh.vertices.size());
        for (size_t i = 0; i < solid.positions.size(); ++i) {
            ThingVertex v;
            v.position = solid.positions[i], v.normal = solid.normals[i];
            v.colour = shaded(colour, .85f + .15f * solid.normals[i].y);
            v.joints[0] = joint;
            mesh.vertices.push_back(v);
        }
        for (const uint32_t i : solid.indices) mesh.lods[0].push_back(first + i);
    }
    void tube(std::vector<Vec3> path, float radius, uint32_t colour, uint8_t joint = 0,
              Vec3 across = {1, .1f, 0}) {
        add(make_band(path, across, radius, radius, 8), colour, joint);
    }
    void box(Vec3 at, Vec3 half, uint32_t colour, float soft = .35f, uint8_t joint = 0, Vec3 up = {0, 1, 0},
             Vec3 front = {0, 0, 1}) {
        add(make_pillow(make_frame(at, up, front), half, soft, 20, 8), colour, joint);
    }
    void ring(Vec3 middle, Vec3 axle, float radius, float thick, uint32_t colour, uint8_t joint,
              int corners = 36) {
        const Frame f = make_frame(middle, axle, axle.z * axle.z < .5f ? Vec3{0, 0, 1} : Vec3{0, 1, 0});
        std::vector<Vec3> path;
        for (int k = 0; k < corners; ++k) {
            const SinCos a = sin_cos(2 * k_pi * static_cast<float>(k) / static_cast<float>(corners));
            path.push_back(f.at({radius * a.sine, 0, radius * a.cosine}));
        }
        add(make_ring(path, axle, thick, thick, 6), colour, joint);
    }
};

constexpr uint32_t k_steel = rgb(0x8c9094), k_black = rgb(0x1f1f21);

void add_wheel(Maker& m, float out, uint8_t joint) {
    const Vec3 axle{out, 0, 0};
    const float x = out * (0.5f * k_chair_track - .022f);
    m.ring({x, 0, 0}, axle, k_chair_wheel - .014f, .014f, rgb(0x2b2b2c), joint);
    m.ring({x, 0, 0}, axle, k_chair_wheel - .030f, .009f, k_steel, joint);
    m.ring({out * 0.5f * k_chair_track, 0, 0}, axle, k_chair_rim, .0085f, rgb(0xb9bcbf), joint);
    m.box({x, 0, 0}, {.030f, .030f, .030f}, k_black, .8f, joint);
    for (int k = 0; k < 12; ++k) {
        const SinCos a = sin_cos(2 * k_pi * static_cast<float>(k) / 12);
        const Vec3 way{0, a.sine, a.cosine};
        const Vec3 spoke[] = {Vec3{x, 0, 0} + way * .02f, Vec3{x, 0, 0} + way * (k_chair_wheel - .03f)};
        m.add(make_band(spoke, {1, 0, 0}, .0028f, .0028f, 4), k_steel, joint);
    }
}

}  // namespace

ThingMesh make_wheelchair() {
    Maker m;
    constexpr uint32_t k_frame = rgb(0x2f4a6b), k_cloth = rgb(0x26272a);
    for (const float side : {1.0f, -1.0f}) {
        add_wheel(m, side, side > 0 ? 1 : 2);
        const float x = side * .205f;
        m.tube({{x, .86f, -.215f}, {x, .50f, -.185f}, {x, k_chair_wheel, -.06f}}, .0125f, k_frame);
        m.tube({{x, .86f, -.215f}, {x, .885f, -.25f}, {x, .885f, -.315f}}, .0135f, k_black);
        m.tube({{x, .445f, -.18f}, {x, .445f, .36f}, {x * .93f, .40f, .43f}, {x * .80f, .12f, .56f}}, .0125f,
               k_frame);
        m.tube({{x, .445f, .28f}, {x, .22f, .36f}, {x, .11f, .40f}}, .0115f, k_frame);
        m.tube({{x, k_chair_wheel, -.06f}, {x, k_chair_wheel, 0}, {x * 1.2f, k_chair_wheel, 0}}, .0125f,
               k_frame);
        m.tube({{x, k_chair_wheel, 0}, {x, .24f, .20f}, {x, .22f, .36f}}, .0115f, k_frame);
        m.ring({x, .062f, .40f}, {1, 0, 0}, .048f, .014f, rgb(0x2b2b2c), 0, 18);
        m.box({x, .062f, .40f}, {.014f, .036f, .036f}, k_steel, .8f);
        m.box({x * .52f, .062f, .635f}, {.082f, .010f, .085f}, k_black, .3f);
        m.box({side * .222f, .555f, .03f}, {.008f, .085f, .17f}, k_cloth, .4f);
    }
    m.tube({{.205f, k_chair_wheel, 0}, {-.205f, k_chair_wheel, 0}}, .0125f, k_frame, 0, {0, 1, 0});
    m.tube({{.164f, .12f, .56f}, {-.164f, .12f, .56f}}, .011f, k_frame, 0, {0, 1, 0});
    m.box({0, k_chair_seat - .022f, .075f}, {.205f, .026f, .235f}, k_cloth, .4f);
    m.box({0, .665f, -.195f}, {.205f, .175f, .016f}, k_cloth, .4f, 0, {0, 1, -.09f}, {0, .09f, 1});
    return m.mesh;
}

ThingMesh make_white_cane() {
    Maker m;
    m.tube({{0, .15f, 0}, {0, 0, 0}, {0, -.10f, 0}}, .0125f, k_black);
    m.tube({{0, -.10f, 0}, {0, -.55f, 0}, {0, -.92f, 0}}, .0072f, rgb(0xeef0f0));
    m.tube({{0, -.92f, 0}, {0, -1.15f, 0}}, .0074f, rgb(0xc23b2e));
    m.tube({{0, -1.15f, 0}, {0, -1.225f, 0}}, .0072f, rgb(0xeef0f0));
    m.box({0, -1.228f, 0}, {.018f, .022f, .018f}, rgb(0xf4f4f2), .9f);
    return m.mesh;
}

ThingMesh make_umbrella() {
    Maker m;
    constexpr int k_ribs = 8, k_rings = 7, k_round = 5;
    m.tube({{0, k_umbrella + .07f, 0}, {0, .30f, 0}, {0, -.02f, 0}}, .0065f, rgb(0x5a5d61));
    m.tube({{0, .10f, 0},
            {0, -.10f, 0},
            {0, -.15f, .012f},
            {0, -.175f, .04f},
            {0, -.16f, .07f},
            {0, -.13f, .078f}},
           .012f, rgb(0x4a2f1b));
    SolidMesh shell;
    auto at = [&](int r, int a, float in) {
        const float t = static_cast<float>(r) / k_rings,
                    turn = 2 * k_pi * static_cast<float>(a) / (k_ribs * k_round);
        const SinCos s = sin_cos(turn);
        // Cloth is drawn in between the ribs.
        const float between = static_cast<float>(a % k_round) / k_round, sag = 4 * between * (1 - between);
        const float radius = k_canopy * t * (1 - .07f * t * sag);
        return Vec3{radius * s.sine, k_umbrella - .20f * t * t - .015f * t * sag + .02f * sag * t * t - in,
                    radius * s.cosine};
    };
    for (const bool inner : {false, true}) {
        const auto first = static_cast<uint32_t>(shell.positions.size());
        constexpr int k_around = k_ribs * k_round;
        for (int r = 0; r <= k_rings; ++r)
            for (int a = 0; a < k_around; ++a) {
                const Vec3 p = at(r, a, inner ? .004f : 0);
                const Vec3 n = normalize_or(Vec3{p.x * .8f, .45f, p.z * .8f}, {0, 1, 0});
                shell.positions.push_back(p);
                shell.normals.push_back(inner ? -n : n);
            }
        for (int r = 0; r < k_rings; ++r)
            for (int a = 0; a < k_around; ++a) {
                const auto row = static_cast<uint32_t>(k_around);
                const uint32_t p = first + static_cast<uint32_t>(r) * row + static_cast<uint32_t>(a),
                               q = first + static_cast<uint32_t>(r) * row +
                                   static_cast<uint32_t>((a + 1) % k_around);
                const uint32_t two[] = {p, p + row, q + row, p, q + row, q};
                for (int k = 0; k < 6; k += 3) {
                    shell.indices.push_back(two[k]);
                    shell.indices.push_back(two[inner ? k + 2 : k + 1]);
                    shell.indices.push_back(two[inner ? k + 1 : k + 2]);
                }
            }
    }
    const size_t cloth = m.mesh.vertices.size();
    m.add(shell, rgb(0xffffff));
    for (size_t i = cloth; i < m.mesh.vertices.size(); ++i) m.mesh.vertices[i].tinted = true;
    for (int a = 0; a < k_ribs; ++a) {
        const Vec3 rib[] = {at(0, a * k_round, .012f), at(3, a * k_round, .012f), at(5, a * k_round, .010f),
                            at(k_rings, a * k_round, .006f)};
        m.add(make_band(rib, {0, 1, 0}, .003f, .003f, 4), rgb(0x6a6d70));
        const Vec3 stay[] = {{0, .55f, 0}, at(4, a * k_round, .012f)};
        m.add(make_band(stay, {0, 1, 0}, .0022f, .0022f, 4), rgb(0x6a6d70));
    }
    return m.mesh;
}

ThingMesh make_guitar() {
    Maker m;
    constexpr uint32_t k_top = rgb(0xc08a4a), k_side = rgb(0x6b3d1e);
    m.box({-.14f, 0, 0}, {.155f, .185f, .048f}, k_side, .72f);
    m.box({.09f, 0, 0}, {.135f, .145f, .046f}, k_side, .72f);
    m.box({-.02f, 0, 0}, {.12f, .125f, .045f}, k_side, .6f);
    m.box({-.14f, 0, .040f}, {.145f, .175f, .010f}, k_top, .72f);
    m.box({.09f, 0, .038f}, {.125f, .135f, .010f}, k_top, .72f);
    m.box({-.02f, 0, .038f}, {.12f, .118f, .010f}, k_top, .6f);
    m.box({.055f, 0, .048f}, {.045f, .045f, .004f}, k_black, .9f);
    m.box({-.16f, 0, .052f}, {.016f, .075f, .006f}, rgb(0x3a2417), .3f);
    m.box({.35f, 0, .035f}, {.21f, .026f, .013f}, rgb(0x4a2c18), .3f);
    m.box({.40f, 0, .050f}, {.26f, .024f, .005f}, rgb(0x241610), .2f);
    m.box({.62f, 0, .030f}, {.075f, .036f, .011f}, rgb(0x5a3419), .3f);
    for (int k = 0; k < 6; ++k) {
        const float y = .017f * (static_cast<float>(k) / 2.5f - 1);
        const Vec3 string[] = {{-.155f, y, .060f}, {.58f, y * .9f, .057f}};
        m.add(make_band(string, {0, 1, 0}, .0008f, .0008f, 4), rgb(0xd8d2c4));
    }
    return m.mesh;
}

ThingMesh make_violin() {
    Maker m;
    constexpr uint32_t k_varnish = rgb(0x8a3f18);
    m.box({-.10f, 0, 0}, {.085f, .100f, .019f}, k_varnish, .75f);
    m.box({.065f, 0, 0}, {.075f, .082f, .019f}, k_varnish, .75f);
    m.box({-.01f, 0, 0}, {.075f, .056f, .018f}, k_varnish, .6f);
    m.box({.20f, 0, .016f}, {.105f, .013f, .009f}, k_black, .3f);
    m.box({.27f, 0, .004f}, {.075f, .012f, .011f}, k_varnish, .4f);
    m.box({.335f, 0, -.004f}, {.026f, .011f, .020f}, k_varnish, .8f);
    m.box({.0f, 0, .026f}, {.004f, .022f, .012f}, rgb(0xc9a069), .3f);
    m.box({-.14f, .045f, .024f}, {.035f, .045f, .008f}, k_black, .7f);
    for (const float y : {-.009f, -.003f, .003f, .009f}) {
        const Vec3 string[] = {{-.11f, y, .028f}, {0, y, .038f}, {.29f, y * .7f, .024f}};
        m.add(make_band(string, {0, 1, 0}, .0007f, .0007f, 4), rgb(0xd8d2c4));
    }
    return m.mesh;
}

ThingMesh make_bow() {
    Maker m;
    const Vec3 stick[] = {{.05f, 0, .012f}, {-.30f, 0, .006f}, {-.66f, 0, .014f}};
    m.add(make_band(stick, {0, 1, 0}, .0042f, .0042f, 6), rgb(0x5b2f16));
    const Vec3 hair[] = {{.02f, 0, -.010f}, {-.66f, 0, -.006f}};
    m.add(make_band(hair, {0, 1, 0}, .0045f, .0009f, 4), rgb(0xe6e0d2));
    m.box({.03f, 0, -.001f}, {.020f, .006f, .012f}, k_black, .3f);
    m.box({-.662f, 0, .004f}, {.010f, .004f, .012f}, rgb(0xe6e0d2), .3f);
    return m.mesh;
}

ThingMesh make_accordion() {
    Maker m;
    constexpr uint32_t k_shell = rgb(0x7a1d22);
    // Each half reaches from its hand to the middle; the frames are at the palms.
    m.box({.055f, 0, 0}, {.050f, .165f, .095f}, k_shell, .3f, 0);
    m.box({.02f, 0, .095f}, {.016f, .150f, .014f}, rgb(0xf0ede4), .25f, 0);
    for (int k = 0; k < 7; ++k)
        m.box({.008f, -.12f + .04f * static_cast<float>(k) + .012f, .105f}, {.010f, .008f, .010f}, k_black,
              .2f, 0);
    m.box({-.055f, 0, 0}, {.050f, .165f, .095f}, k_shell, .3f, 1);
    // Bellows, of folds that go with both.
    constexpr int k_folds = 12;
    SolidMesh folds;
    const auto first = static_cast<uint32_t>(m.mesh.vertices.size());
    for (int k = 0; k <= k_folds; ++k) {
        const float half_y = k % 2 == 0 ? .155f : .135f, half_z = k % 2 == 0 ? .088f : .070f;
        constexpr int k_corners = 16;
        for (int a = 0; a < k_corners; ++a) {
            const SinCos s = sin_cos(2 * k_pi * (static_cast<float>(a) + .5f) / k_corners);
            auto square = [](float v) { return v < 0 ? -std::sqrt(std::sqrt(-v)) : std::sqrt(std::sqrt(v)); };
            ThingVertex v;
            // In the frame of its own end.
            const float t = static_cast<float>(k) / k_folds;
            v.position = {lerp(.10f, -.10f, t), half_y * square(s.sine), half_z * square(s.cosine)};
            v.normal = normalize_or(Vec3{0, s.sine, s.cosine}, {0, 1, 0});
            v.colour = shaded(rgb(k % 2 == 0 ? 0x2a2428 : 0x8d8078), .85f + .15f * v.normal.y);
            v.joints[0] = 0, v.joints[1] = 1;
            v.weights[1] = static_cast<uint8_t>(255 * t + .5f);
            v.weights[0] = static_cast<uint8_t>(255 - v.weights[1]);
            m.mesh.vertices.push_back(v);
            if (k == k_folds) continue;
            const auto p = first + static_cast<uint32_t>(k * k_corners + a),
                       q = first + static_cast<uint32_t>(k * k_corners + (a + 1) % k_corners);
            for (const uint32_t i : {p, p + k_corners, q + k_corners, p, q + k_corners, q})
                m.mesh.lods[0].push_back(i);
        }
    }
    return m.mesh;
}

ThingMesh make_hat_on_ground() {
    Maker m;
    // Upside down, with coins in it.
    const Frame f = make_frame({0, 0, 0}, {0, 1, 0}, {0, 0, 1});
    const Turn bowl[] = {{.004f, .002f}, {.075f, .004f}, {.088f, .055f}, {.093f, .105f}, {.150f, .125f},
                         {.152f, .130f}, {.090f, .112f}, {.080f, .05f},  {.066f, .014f}, {.004f, .012f}};
    m.add(make_turned(f, bowl, 1.15f, 28), rgb(0x3b322a));
    for (int k = 0; k < 9; ++k) {
        const float a = 2.4f * static_cast<float>(k), r = .012f + .006f * static_cast<float>(k);
        const SinCos s = sin_cos(a - 2 * k_pi * std::floor(a / (2 * k_pi)));
        const Frame coin = make_frame({r * s.sine, .018f + .002f * static_cast<float>(k % 3), r * s.cosine},
                                      {.2f * s.cosine, 1, .1f}, {0, 0, 1});
        const Turn disc[] = {{.001f, 0}, {.011f, 0}, {.011f, .002f}, {.001f, .002f}};
        m.add(make_turned(coin, disc, 1, 10), k % 2 == 0 ? rgb(0xc9a437) : rgb(0xb7b7b4));
    }
    return m.mesh;
}

ThingMesh make_lead() {
    constexpr int k_corners = 5;
    constexpr float k_thick = .0055f;  // metres
    ThingMesh mesh;
    mesh.lods.resize(1);
    for (int j = 0; j < k_lead_joints; ++j)
        for (int a = 0; a < k_corners; ++a) {
            const SinCos s = sin_cos(2 * k_pi * static_cast<float>(a) / k_corners);
            ThingVertex v;
            v.position = {k_thick * s.sine, 0, k_thick * s.cosine};
            v.normal = {s.sine, 0, s.cosine};
            v.colour = rgb(0x7c2a26);
            v.joints[0] = static_cast<uint8_t>(j);
            mesh.vertices.push_back(v);
            if (j + 1 == k_lead_joints) continue;
            const auto p = static_cast<uint32_t>(j * k_corners + a),
                       q = static_cast<uint32_t>(j * k_corners + (a + 1) % k_corners);
            for (const uint32_t i : {p, q, q + k_corners, p, q + k_corners, p + k_corners})
                mesh.lods[0].push_back(i);
        }
    return mesh;
}

}  // namespace flaneur
