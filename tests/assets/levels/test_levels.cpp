// Levels of detail keep the person, whoever made it.
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>

#include "assets/gltf/character/character.h"
#include "assets/gltf/write.h"
#include "assets/levels/gate.h"
#include "assets/levels/palette.h"
#include "sim/base/levels.h"
#include "sim/base/math.h"
#include "tests/assets/levels/horrors.h"

namespace flaneur {
namespace {

namespace fs = std::filesystem;

const fs::path k_corpus = fs::path(FLANEUR_SHARED_DIR) / "corpus/characters";

std::string told(const Character& c) {
    std::string text = std::to_string(c.lods[0].size() / 3) + " triangles";
    for (const MeasuredLevel& level : c.found.levels) {
        char line[96];
        std::snprintf(line, sizeof line, "\n  below %.0f pixels %zu, silhouette %.3f, colour %.3f",
                      double(level.pixels), level.triangles, double(level.silhouette), double(level.colour));
        text += line;
        for (const std::string& refused : level.refused) text += "\n    refused: " + refused;
    }
    return text;
}

// Every level is the one before or coarser, and within the gate's bounds as measured here.
void expect_gated(const Character& c) {
    ASSERT_LE(c.lods.size(), size_t{k_person_levels});
    ASSERT_EQ(c.found.levels.size() + 1, c.lods.size());
    LevelGate gate = make_gate(c);
    for (size_t level = 1; level < c.lods.size(); ++level) {
        const MeasuredLevel& measured = c.found.levels[level - 1];
        EXPECT_EQ(measured.triangles, c.lods[level].size() / 3);
        const LevelDifference d = difference_of(gate, c, c.lods[level], int(level));
        EXPECT_TRUE(is_within(d, int(level))) << level << ": " << d.silhouette << ", " << d.colour;
        if (c.lods[level] == c.lods[level - 1]) continue;
        EXPECT_LT(c.lods[level].size(), c.lods[level - 1].size());
        EXPECT_NEAR(measured.silhouette, d.silhouette, 1e-4f);
        EXPECT_NEAR(measured.colour, d.colour, 1e-4f);
    }
}

Character with_levels(Character c) {
    c.lods.resize(1);
    number_parts(c);
    build_lods(c);
    std::cout << told(c) << "\n";
    return c;
}

std::vector<BallLook> motley() {
    std::vector<BallLook> looks;
    for (uint32_t n = 0; n < 11; ++n)
        looks.push_back({{0xff000000u | (n * 0x2f4b91u & 0xffffffu)}, {}, false, 0xffff});
    return looks;
}

constexpr std::array<uint32_t, k_tint_count> k_no_tints = {~0u, ~0u, ~0u, ~0u, ~0u, ~0u, ~0u};

// A man of balls as a file has him, under a node that scales him.
Character loaded_under(std::vector<double> scale) {
    const std::string bytes = character_glb(ball_man(1, 14, 16, motley()), k_no_tints);
    auto model =
        parse_gltf({reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()}, "/nowhere", "man");
    EXPECT_TRUE(model) << model.error().message;
    tinygltf::Node top;
    top.scale = std::move(scale);
    top.children = model->scenes[0].nodes;
    model->scenes[0].nodes = {int(model->nodes.size())};
    model->nodes.push_back(top);
    auto character = make_character(*model, "man");
    EXPECT_TRUE(character) << character.error().message;
    return std::move(*character);
}

// Six times the volume that the finest triangles enclose, of what faces outward.
float volume_of(const Character& c) {
    float volume = 0;
    for (size_t t = 0; t + 2 < c.lods[0].size(); t += 3) {
        auto at = [&](size_t i) { return c.vertices[c.lods[0][t + i]].position; };
        volume += dot(at(0), cross(at(1), at(2)));
    }
    return volume;
}

TEST(Levels, AHundredLooseParts) {
    Character c = with_levels(ball_man(5, 8, 10, motley()));
    expect_gated(c);
    expect_whole(c, 3);
    EXPECT_LT(c.lods.back().size(), c.lods[0].size() / 2) << "and fewer triangles from afar";
}

TEST(Levels, APalette) {
    Character man = ball_man(
        1, 24, 24, {{{0xffffffffu}, {0.5f / 256, 77.5f / 256, 190.5f / 256, 20.5f / 256}, false, 0}});
    man.textures = {palette_texture()};
    Character c = with_levels(man);
    expect_gated(c);
    expect_whole(c, 8);
    EXPECT_LT(c.lods.back().size(), c.lods[0].size() / 4);
    EXPECT_EQ(c.vertices[c.lods[0][0]].texture, 0) << "the finest is as it was brought";
}

TEST(Levels, PalettesAreToldFromPictures) {
    BallLook look{{0xffffffffu}, {0.5f / 256, 77.5f / 256}, false, 0};
    Character c = ball_man(1, 12, 12, {look});
    c.textures = {palette_texture()};
    const std::vector<uint32_t> corners = without_palettes(c);
    for (uint32_t v : corners) ASSERT_EQ(c.vertices[v].texture, CharacterVertex::k_no_texture);
    look.is_mapped = true;  // across all swatches
    Character other = ball_man(1, 12, 12, {look});
    other.textures = {palette_texture()};
    EXPECT_EQ(without_palettes(other), other.lods[0]);
}

TEST(Levels, ThreeTriangleHands) {
    Character man = ball_man(1, 20, 24, motley());
    for (Joint hand : {left_hand, right_hand}) {
        const auto first = uint32_t(man.vertices.size());
        const Vec3 wrist = man.body.joints[hand];
        for (Vec3 p : {Vec3{0, -0.2f, 0.02f}, {-0.05f, -0.12f, 0}, {0.05f, -0.12f, 0}, {0.02f, -0.3f, 0}}) {
            CharacterVertex v;
            v.position = wrist + p + Vec3{hand == left_hand ? 0.2f : -0.2f, 0, 0};
            v.normal = {0, 0, 1};
            v.colour = 0xff2040f0u;
            v.joints[0] = hand;
            man.vertices.push_back(v);
        }
        man.lods[0].insert(man.lods[0].end(), {first, first + 2, first + 1, first, first + 1, first + 3,
                                               first, first + 3, first + 2});
    }
    Character c = with_levels(man);
    expect_gated(c);
    expect_whole(c, 3);
}

// Too thin for their loss to count in the whole, long enough to be missed.
TEST(Levels, ThinThings) {
    Character man = ball_man(1, 20, 24, motley());
    const Vec3 crown = man.body.joints[head] + Vec3{0, 0.2f, 0};
    for (float x : {-0.08f, 0.08f})
        add_ball(man, head, crown + Vec3{x, 0, 0}, crown + Vec3{1.5f * x, 0.3f, 0}, 0.008f, 12, 8, {});
    for (Joint hand : {left_hand, right_hand})
        for (int finger = 0; finger < 4; ++finger) {
            const Vec3 from = end_of(man, hand) + Vec3{0, 0, 0.025f * float(finger) - 0.04f};
            add_ball(man, hand, from, from - Vec3{0, 0.09f, 0}, 0.009f, 10, 8, {});
        }
    Character c = with_levels(man);
    expect_gated(c);
    expect_whole(c, 3);
    EXPECT_LT(c.lods.back().size(), c.lods[0].size() / 4);
}

TEST(Levels, HairOfCards) {
    Character man = ball_man(1, 16, 20, motley());
    Texture hair{32, 32, {}};
    for (int i = 0; i < 32 * 32; ++i)
        hair.rgba.insert(hair.rgba.end(), {90, 60, 20, uint8_t(i % 4 == 3 ? 0 : 255)});
    man.textures = {hair};
    const Vec3 middle = man.body.joints[head] + Vec3{0, 0.1f, 0};
    constexpr int k_cards = 80;
    for (int n = 0; n < k_cards; ++n) {
        const SinCos round = sin_cos(2 * k_pi * float(n) / k_cards);
        const Vec3 out{round.sine, 0, round.cosine}, along{round.cosine, 0, -round.sine};
        for (bool is_back : {false, true}) {
            const auto first = uint32_t(man.vertices.size());
            for (int i = 0; i < 4; ++i) {
                CharacterVertex v;
                v.position = middle + out * (0.11f + 0.02f * float(i / 2)) +
                             along * (i % 2 ? 0.02f : -0.02f) + Vec3{0, i / 2 ? -0.25f : 0.05f, 0};
                v.normal = is_back ? -out : out;
                v.u = float(i % 2), v.v = float(i / 2);
                v.texture = 0;
                v.joints[0] = head;
                man.vertices.push_back(v);
            }
            auto& indices = man.lods[0];
            if (is_back)
                indices.insert(indices.end(), {first, first + 1, first + 2, first + 1, first + 3, first + 2});
            else
                indices.insert(indices.end(), {first, first + 2, first + 1, first + 1, first + 2, first + 3});
        }
    }
    Character c = with_levels(man);
    expect_gated(c);
    expect_whole(c, 3);
    for (const auto& level : c.lods) {
        size_t ahead = 0, behind = 0;
        for (size_t t = 0; t + 2 < level.size(); t += 3) {
            const CharacterVertex& v = c.vertices[level[t]];
            if (v.texture != 0) continue;
            const Vec3 away = v.position - middle;
            (v.normal.x * away.x + v.normal.z * away.z > 0 ? ahead : behind) += 1;
        }
        EXPECT_GE(ahead, size_t{k_cards}) << "cards keep their texture and what it cuts away";
        EXPECT_EQ(behind, ahead) << "and are seen from both sides";
    }
}

TEST(Levels, CapesHaveTwoSides) {
    Character man = ball_man(1, 16, 20, motley());
    constexpr uint32_t k_cells = 24;
    for (bool is_back : {false, true}) {
        const auto first = uint32_t(man.vertices.size());
        for (uint32_t n = 0; n < (k_cells + 1) * (k_cells + 1); ++n) {
            const float x = float(n % (k_cells + 1)) / k_cells, y = float(n / (k_cells + 1)) / k_cells;
            CharacterVertex v;
            v.position = man.body.joints[upper_chest] +
                         Vec3{0.6f * x - 0.3f, 0.1f - 0.9f * y, -0.2f - 0.03f * sin_cos(12 * x).sine};
            v.normal = {0, 0, is_back ? 1.0f : -1.0f};
            v.colour = 0xff2020c0u;
            v.joints[0] = upper_chest;
            man.vertices.push_back(v);
        }
        for (uint32_t n = 0; n < k_cells * k_cells; ++n) {
            const uint32_t a = first + n / k_cells * (k_cells + 1) + n % k_cells, b = a + k_cells + 1;
            auto& indices = man.lods[0];
            if (is_back)
                indices.insert(indices.end(), {a, b, b + 1, a, b + 1, a + 1});
            else
                indices.insert(indices.end(), {a, b + 1, b, a, a + 1, b + 1});
        }
    }
    Character c = with_levels(man);
    expect_gated(c);
    expect_whole(c, 3);
    size_t fewest = ~size_t{0};
    for (const auto& level : c.lods) {
        float sides[2] = {0, 0};  // area seen from behind and from ahead
        size_t count = 0;
        for (size_t t = 0; t + 2 < level.size(); t += 3) {
            auto at = [&](size_t i) { return c.vertices[level[t + i]]; };
            if (at(0).colour != 0xff2020c0u || at(0).joints[0] != upper_chest) continue;
            const Vec3 across = cross(at(1).position - at(0).position, at(2).position - at(0).position);
            EXPECT_GT(dot(across, at(0).normal + at(1).normal + at(2).normal), 0);
            sides[across.z > 0] += length(across);
            ++count;
        }
        EXPECT_GT(sides[0], 0.9f);
        EXPECT_NEAR(sides[0], sides[1], 1e-3f);
        fewest = std::min(fewest, count);
    }
    EXPECT_LT(fewest, size_t{k_cells * k_cells}) << "it became coarser";
}

TEST(Levels, EightyThousandTriangles) {
    Character c = with_levels(ball_man(1, 44, 44, motley()));
    EXPECT_GT(c.lods[0].size() / 3, 80000u);
    expect_gated(c);
    expect_whole(c, 3);
    ASSERT_EQ(c.lods.size(), size_t{k_person_levels});
    EXPECT_LT(c.lods[2].size() / 3, 4000u);
    EXPECT_LT(c.lods[4].size() / 3, 800u);
}

TEST(Levels, SeveralMaterials) {
    Texture checks{64, 64, {}};
    for (int i = 0; i < 64 * 64; ++i) {
        const bool light = (i / 8 + i / (64 * 8)) % 2 == 0;
        checks.rgba.insert(checks.rgba.end(),
                           {uint8_t(light ? 220 : 40), uint8_t(light ? 200 : 30), 90, 255});
    }
    std::vector<BallLook> looks = motley();
    looks.push_back({{0xffffffffu}, {}, true, 0});
    looks.push_back({{0xffffffffu}, {3.5f / 256, 99.5f / 256}, false, 1});
    Character man = ball_man(2, 20, 20, looks);
    man.textures = {checks, palette_texture()};
    Character c = with_levels(man);
    expect_gated(c);
    expect_whole(c, -1);
}

TEST(Levels, ColoursOfVerticesAlone) {
    Character man = ball_man(1, 30, 30, {{}});
    for (CharacterVertex& v : man.vertices) {
        const auto red = uint32_t(127 + 120 * sin_cos(9 * v.position.y).sine);
        const auto green = uint32_t(127 + 120 * sin_cos(7 * v.position.x).sine);
        v.colour = 0xff400000u | green << 8 | red;
    }
    Character c = with_levels(man);
    expect_gated(c);
    expect_whole(c, 24);
    EXPECT_LT(c.lods.back().size(), c.lods[0].size() / 2);
}

TEST(Levels, Millimetres) {
    Character c = with_levels(loaded_under({1000, 1000, 1000}));
    EXPECT_NEAR(c.body.height, 1.7f, 0.1f);
    expect_gated(c);
    expect_whole(c, 3);
    EXPECT_LT(c.lods.back().size(), c.lods[0].size() / 4);
}

TEST(Levels, LeftHandedExports) {
    const float volume = volume_of(loaded_under({1, 1, 1}));
    EXPECT_GT(volume, 0);
    for (const std::vector<double>& scale : {std::vector<double>{-1, 1, 1}, {1, 1, -1}, {-1, -1, -1}}) {
        Character c = with_levels(loaded_under(scale));
        EXPECT_NEAR(volume_of(c), volume, 0.01f * volume) << "what is mirrored still faces outward";
        expect_gated(c);
        expect_whole(c, 3);
        EXPECT_LT(c.lods.back().size(), c.lods[0].size() / 4);
    }
}

// The gate's own eyes: what it has to refuse, it does.
TEST(Levels, WhatDiffersIsSeen) {
    Character c = ball_man(1, 12, 12, motley());
    LevelGate gate = make_gate(c);
    for (int level = 1; level < k_person_levels; ++level) {
        const LevelDifference none = difference_of(gate, c, c.lods[0], level);
        EXPECT_EQ(none.silhouette, 0);
        EXPECT_EQ(none.colour, 0);
        std::vector<uint32_t> without_arm, turned = c.lods[0];
        for (size_t t = 0; t + 2 < c.lods[0].size(); t += 3) {
            const uint8_t joint = c.vertices[c.lods[0][t]].joints[0];
            if (joint < left_upper_arm || joint > left_hand)
                without_arm.insert(without_arm.end(), c.lods[0].begin() + std::ptrdiff_t(t),
                                   c.lods[0].begin() + std::ptrdiff_t(t + 3));
            std::swap(turned[t + 1], turned[t + 2]);
        }
        EXPECT_FALSE(is_within(difference_of(gate, c, without_arm, level), level));
        EXPECT_FALSE(is_within(difference_of(gate, c, turned, level), level)) << "inside out";
    }
    for (CharacterVertex& v : c.vertices) v.colour ^= 0x606060u;
    for (int level = 1; level < k_person_levels; ++level) {
        const LevelDifference d = difference_of(gate, c, c.lods[0], level);
        EXPECT_EQ(d.silhouette, 0);
        EXPECT_FALSE(is_within(d, level)) << "in other colours";
    }
}

TEST(Levels, OfWhatOthersMade) {
    if (!fs::exists(k_corpus))
        GTEST_SKIP() << "SKIPPED: " << k_corpus << " is not here: its characters are not tried";
    for (const auto& entry : fs::recursive_directory_iterator(k_corpus)) {
        const std::string kind = entry.path().extension().string();
        if (kind != ".glb" && kind != ".gltf" && kind != ".vrm") continue;
        auto brought = load_character(entry.path().string());
        if (!brought) continue;
        SCOPED_TRACE(entry.path().filename());
        std::cout << brought->name << ": ";
        const Character c = with_levels(std::move(*brought));
        if (c.found.levels.empty()) continue;
        expect_gated(c);
        expect_whole(c, -1);
    }
}

}  // namespace
}  // namespace flaneur
