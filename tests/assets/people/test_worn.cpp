#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>

#include "assets/people/accessories.h"
#include "assets/people/parts.h"
#include "assets/population.h"

namespace flaneur {
namespace {

float cloth_distance(const Field& field, Vec3 p) {
    std::vector<uint16_t> near;
    parts_near(field, p, .05f, near);
    return distance(layer_distances(field, near, p));
}

// Of the part of the finest surface that shows `tint`, the places that `counts`.
template <class Counts>
size_t places(const Character& c, Tint tint, Counts&& counts) {
    size_t count = 0;
    for (uint32_t v : c.lods[0]) count += c.vertices[v].tint == tint && counts(c.vertices[v].position);
    return count;
}

TEST(Worn, WhatMeetsStaysTogether) {
    using Bound = std::array<int, 16>;
    for (const PersonOptions& options : draw_population(8, 1)) {
        const Character c = generate_person(options);
        std::map<std::array<float, 3>, Bound> known;
        size_t apart = 0;
        for (uint32_t index : c.lods[0]) {
            const CharacterVertex& v = c.vertices[index];
            Bound bound;
            for (size_t n = 0; n < 4; ++n) {
                bound[n] = v.joints[n], bound[n + 4] = v.weights[n];
                bound[n + 8] = v.hung_joints[n], bound[n + 12] = v.hung_weights[n];
            }
            const Vec3 p = v.position;
            apart += known.try_emplace({p.x, p.y, p.z}, bound).first->second != bound;
        }
        EXPECT_EQ(apart, 0u) << "corners that leave the others at their place, seed " << options.seed;
    }
}

TEST(Worn, SkirtsEndUnderWhatIsWornOver) {
    for (Bottom bottom : {Bottom::skirt, Bottom::long_skirt, Bottom::dress})
        for (Over over : {Over::jacket, Over::open_jacket, Over::vest, Over::coat})
            for (float build : {-1.0f, 0.0f, 1.0f}) {
                PersonOptions options;
                options.woman = true;
                options.bottom = bottom;
                options.over = over;
                options.build = build;
                const Figure figure = choose_figure(options);
                auto up = [&](float y) { return warped(figure, {0, y, 0}).y * figure.height; };
                const float hem = up(top_hem(figure) + .003f), waist = up(.60f);
                const size_t seen = places(generate_person(options), Tint::bottom, [&](Vec3 p) {
                    const bool in_front = p.z > 0 && std::abs(p.x) < .06f;
                    return p.y > hem && p.y < waist && !in_front;
                });
                EXPECT_EQ(seen, 0u) << "above the hem: skirt " << int(bottom) << " under " << int(over)
                                    << ", build " << build;
            }
}

// Seen from below a pale hem would be a patch on what is worn under it.
TEST(Worn, HemsAreDarkBelow) {
    for (Bottom bottom : {Bottom::straight, Bottom::skirt})
        for (Over over : {Over::none, Over::jacket, Over::open_jacket, Over::coat})
            for (bool woman : {false, true}) {
                PersonOptions options;
                options.seed = 2;  // who wears it over the belt
                options.woman = woman;
                options.bottom = woman ? bottom : Bottom::straight;
                options.over = over;
                if (options.bottom == Bottom::skirt && over != Over::coat)
                    continue;  // no hem stands out from it
                const Figure figure = choose_figure(options);
                const float hem = warped(figure, {0, top_hem(figure), 0}).y * figure.height;
                const Character c = generate_person(options);
                float pale = 0, all = 0;
                for (size_t t = 0; t < c.lods[0].size(); t += 3) {
                    const CharacterVertex* v[3];
                    for (size_t n = 0; n < 3; ++n) v[n] = &c.vertices[c.lods[0][t + n]];
                    const Vec3 a = v[0]->position, b = v[1]->position, e = v[2]->position;
                    const Vec3 way = cross(b - a, e - a) * .5f;
                    const bool below = way.y < -.7f * length(way) && std::abs(a.y - hem) < .02f;
                    if (!below || v[0]->tint != Tint::top) continue;
                    all -= way.y;
                    if ((v[0]->colour & 0xffu) > 0x40u) pale -= way.y;
                }
                // The edge is rounded, and no more of it is as pale as the rest.
                EXPECT_LT(pale, .4f * all) << "bottom " << int(options.bottom) << " under " << int(over);
            }
}

TEST(Worn, HeelsStayInTrousers) {
    for (Bottom bottom : {Bottom::slim, Bottom::straight, Bottom::wide})
        for (Shoes shoes : {Shoes::leather, Shoes::sneakers})
            for (bool woman : {false, true}) {
                // Slim ones end in the padded collar of a sneaker.
                if (bottom == Bottom::slim && shoes == Shoes::sneakers) continue;
                PersonOptions options;
                options.woman = woman;
                options.bottom = bottom;
                options.shoes = shoes;
                const Figure figure = choose_figure(options);
                const float hem = warped(figure, {0, .045f, 0}).y * figure.height;
                const size_t seen = places(generate_person(options), Tint::shoes, [&](Vec3 p) {
                    return p.y > hem && p.y < .2f && p.z < -.02f * figure.height;
                });
                EXPECT_EQ(seen, 0u) << "above the hem: shoes " << int(shoes) << " in " << int(bottom);
            }
}

TEST(Worn, ShoulderBagsHangByTheirStraps) {
    for (bool woman : {false, true})
        for (Over over : {Over::none, Over::coat, Over::open_jacket}) {
            PersonOptions options;
            options.woman = woman;
            options.over = over;
            options.bag = Bag::shoulder_bag;
            const Figure figure = choose_figure(options);
            const Field field = figure_field(figure);
            const auto worn = make_accessories(figure, field);
            ASSERT_EQ(worn.size(), 3u);
            const auto &strap = worn[0].solid.positions, &bag = worn[1].solid.positions;
            Vec3 low = bag[0], high = bag[0];
            float nearest = 1;
            for (Vec3 p : bag) {
                low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
                high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
                nearest = std::min(nearest, cloth_distance(field, p));
            }
            EXPECT_LT(nearest, 0) << "lies on the hip";
            for (Vec3 end : {strap.front(), strap.back()})
                EXPECT_TRUE(end.x > low.x && end.x < high.x && end.y > low.y && end.y < high.y &&
                            end.z > low.z && end.z < high.z);
            for (Vec3 p : strap) EXPECT_GT(p.y, .5f * (low.y + high.y)) << "below the bag";
        }
}

TEST(Worn, ScarvesLieOnCollars) {
    for (bool woman : {false, true})
        for (Over over : {Over::none, Over::jacket, Over::open_jacket, Over::coat, Over::vest}) {
            PersonOptions options;
            options.woman = woman;
            options.over = over;
            options.scarf = true;
            const Figure figure = choose_figure(options);
            const Field field = figure_field(figure);
            const auto worn = make_accessories(figure, field);
            ASSERT_EQ(worn.size(), 2u);
            const auto& loop = worn[0].solid.positions;
            constexpr size_t k_around = 8;
            for (size_t row = 0; row + k_around <= loop.size(); row += k_around) {
                float outermost = -1, out = 0;
                for (size_t i = row; i < row + k_around; ++i) {
                    outermost = std::max(outermost, cloth_distance(field, loop[i]));
                    out = std::max(out, std::abs(loop[i].x));
                }
                EXPECT_GT(outermost, .008f) << "under cloth " << int(over);
                EXPECT_LT(out, .095f) << "stands off, over " << int(over);
            }
        }
}

}  // namespace
}  // namespace flaneur
