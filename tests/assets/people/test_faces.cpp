#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "assets/people/accessories.h"
#include "assets/people/parts.h"
#include "assets/population.h"

namespace flaneur {
namespace {

bool is_dark(const CharacterVertex& v) { return v.tint == Tint::none && (v.colour & 0xffu) < 90; }

// Whether what one sees from ahead at (x, y) is dark on everyone.
bool shows_dark(const Character& c, const std::vector<uint32_t>& level, float x, float y) {
    float nearest = -1e9f;
    bool dark = false;
    for (size_t t = 0; t + 2 < level.size(); t += 3) {
        const CharacterVertex* v[3] = {&c.vertices[level[t]], &c.vertices[level[t + 1]],
                                       &c.vertices[level[t + 2]]};
        float share[3], sum = 0;
        for (size_t i = 0; i < 3; ++i) {
            const Vec3 a = v[(i + 1) % 3]->position, b = v[(i + 2) % 3]->position;
            share[i] = (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
            sum += share[i];
        }
        if (share[0] < 0 || share[1] < 0 || share[2] < 0 || sum <= 0) continue;
        float z = 0;
        for (size_t i = 0; i < 3; ++i) z += share[i] / sum * v[i]->position.z;
        if (z > nearest) nearest = z, dark = is_dark(*v[0]);
    }
    return dark;
}

// On every level that shows them as more than specks.
TEST(Faces, KeepTwoEyesAndNoOtherSpecks) {
    for (const PersonOptions& options : draw_population(24, 1)) {
        const Figure figure = choose_figure(options);
        const Character c = generate_person(options);
        const Vec3 eye = figure.face.eye;
        const float s = figure.face.eye_size;
        for (size_t l = 0; l < 4; ++l) {
            auto dark_at = [&](float x, float y) {
                const Vec3 p = warped(figure, from_face({x, y, .4f})) * figure.height;
                return shows_dark(c, c.lods[l], p.x, p.y);
            };
            const auto who = testing::Message() << "level " << l << ", seed " << options.seed;
            for (float side : {-1.0f, 1.0f}) EXPECT_TRUE(dark_at(side * eye.x, eye.y)) << who;
            if (options.glasses) {
                // The coarsest of them would show rims as a sixth of a pixel.
                for (float side : {-1.0f, 1.0f}) {
                    size_t rim = 0;
                    for (Vec3 p : glasses_rim(figure, 8, 0)) rim += dark_at(side * p.x, p.y);
                    EXPECT_GE(rim, l < 3 ? 6u : 0u) << "of 8 places on a rim, " << who;
                }
                continue;
            }
            size_t specks = 0;
            for (float y = .06f; y < .66f; y += .02f)
                for (float x = -.25f; x <= .25f; x += .02f) {
                    const bool at_eye =
                        std::abs(std::abs(x) - eye.x) < .10f * s && std::abs(y - eye.y) < .065f * s;
                    specks += !at_eye && dark_at(x, y);
                }
            EXPECT_EQ(specks, 0u) << who;
        }
    }
}

}  // namespace
}  // namespace flaneur
