#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "assets/outfit.h"
#include "assets/population.h"
#include "sim/base/hash.h"

namespace flaneur {
namespace {

struct Made {
    PersonOptions options;
    Character person;
};

constexpr uint32_t k_crowd = 24;
constexpr uint64_t k_seed = 1;

// Women and men, a child, an old man, and one in a coat, a skirt, a dress, with this and that in the hand.
const std::vector<Made>& several() {
    static const std::vector<Made> all = [] {
        std::vector<Made> made;
        for (const PersonOptions& options : draw_population(k_crowd, k_seed))
            if (options.seed % 3 == 0) made.push_back({options, generate_person(options)});
        PersonOptions dressed;
        dressed.woman = true;
        dressed.bottom = Bottom::dress;
        dressed.over = Over::coat;
        dressed.bag = Bag::handbag;
        dressed.stick = true;
        dressed.age = 80;
        made.push_back({dressed, generate_person(dressed)});
        return made;
    }();
    return all;
}

Vec3 canonical_place(const Character& c, const CharacterVertex& v) {
    Vec3 sum;
    for (size_t n = 0; n < 4; ++n) {
        size_t j = v.joints[n];
        Vec3 p = c.body.joints[j] + rotate(c.bind_to_canonical[j], v.position - c.bind_joints[j]);
        sum += p * (float(v.weights[n]) / 255);
    }
    return sum;
}

// Vertices at one place count as one.
std::vector<uint32_t> places_of(const Character& c) {
    std::map<std::array<float, 3>, uint32_t> known;
    std::vector<uint32_t> out;
    for (const CharacterVertex& v : c.vertices)
        out.push_back(known.try_emplace({v.position.x, v.position.y, v.position.z}, uint32_t(known.size()))
                          .first->second);
    return out;
}

uint64_t hash_of(const Character& c) {
    uint64_t h = 0;
    for (const CharacterVertex& v : c.vertices) {
        float numbers[6] = {v.position.x, v.position.y, v.position.z, v.normal.x, v.normal.y, v.normal.z};
        h = hash_bytes(h, numbers, sizeof numbers);
        h = hash_bytes(h, &v.colour, sizeof v.colour);
        h = hash_bytes(h, v.joints, 4);
        h = hash_bytes(h, v.weights, 4);
    }
    for (const auto& level : c.lods) h = hash_bytes(h, level.data(), level.size() * sizeof level[0]);
    return h;
}

TEST(Person, SurfaceIsClosedAndWoundOneWay) {
    for (const auto& [options, c] : several()) {
        std::vector<uint32_t> place = places_of(c);
        std::map<std::pair<uint32_t, uint32_t>, int> directed;
        const auto& triangles = c.lods[0];
        for (size_t t = 0; t < triangles.size(); t += 3)
            for (size_t i = 0; i < 3; ++i)
                ++directed[{place[triangles[t + i]], place[triangles[t + (i + 1) % 3]]}];
        size_t bad = 0;
        for (const auto& [edge, count] : directed) {
            auto back = directed.find({edge.second, edge.first});
            bad += count != 1 || back == directed.end() || back->second != 1;
        }
        EXPECT_EQ(bad, 0u) << "edges not shared by exactly two triangles, seed " << options.seed;
    }
}

TEST(Person, FacesOutward) {
    for (const auto& [options, c] : several()) {
        double volume = 0;
        size_t against = 0;
        const auto& triangles = c.lods[0];
        for (size_t t = 0; t < triangles.size(); t += 3) {
            const CharacterVertex &a = c.vertices[triangles[t]], &b = c.vertices[triangles[t + 1]],
                                  &d = c.vertices[triangles[t + 2]];
            volume += double(dot(a.position, cross(b.position, d.position))) / 6;
            against += dot(cross(b.position - a.position, d.position - a.position),
                           a.normal + b.normal + d.normal) < 0;
        }
        double litres = volume * 1000,
               expected = 22 * std::pow(options.height, 2);  // about a body mass index of 22
        EXPECT_GT(litres, (options.age < 18 ? 0.5 : 0.7) * expected) << options.seed;
        EXPECT_LT(litres, 2.0 * expected) << options.seed;
        EXPECT_LT(against, triangles.size() / 3 / 50)
            << "triangles against their normals, seed " << options.seed;
    }
}

TEST(Person, WeightsSumTo255AndFall) {
    for (const auto& [options, c] : several())
        for (const CharacterVertex& v : c.vertices) {
            int sum = 0;
            for (size_t n = 0; n < 4; ++n) {
                sum += v.weights[n];
                ASSERT_LT(v.joints[n], k_joint_count);
                if (n > 0) {
                    ASSERT_LE(v.weights[n], v.weights[n - 1]);
                }
            }
            ASSERT_EQ(sum, 255);
        }
}

TEST(Person, StandsOnTheGroundAtFullHeight) {
    for (const auto& [options, c] : several()) {
        float low = 1e9f, high = -1e9f, back = 0, front = 0;
        // The crown is where it is under any hat, but curls stand above it.
        bool flat = options.hat == Hat::none && !options.headphones && options.hair != Hair::curly;
        for (const CharacterVertex& v : c.vertices) {
            Vec3 p = canonical_place(c, v);
            low = std::min(low, p.y);
            high = std::max(high, p.y);
            if (v.joints[0] == left_foot) back = std::min(back, p.z);
            if (v.joints[0] == left_toes) front = std::max(front, p.z);
        }
        EXPECT_NEAR(low, 0, 0.005f) << options.seed;
        EXPECT_GT(high, 0.985f * options.height) << options.seed;
        EXPECT_LT(high, (flat ? 1.015f : 1.07f) * options.height) << options.seed;
        EXPECT_NEAR(c.body.height, options.height, 1e-5f);
        EXPECT_NEAR(c.body.heel, c.body.joints[left_foot].z - back, 0.01f);
        EXPECT_NEAR(c.body.toe, front - c.body.joints[left_toes].z, 0.01f);
    }
}

TEST(Person, ArmsHangBesideTheBody) {
    for (const auto& [options, c] : several()) {
        Vec3 shoulder = c.body.joints[left_upper_arm], wrist = c.body.joints[left_hand];
        EXPECT_NEAR(shoulder.x, wrist.x, 1e-4f);
        EXPECT_LT(wrist.y, shoulder.y);
        float hand_inner = 1, hip_outer = 0;
        for (const CharacterVertex& v : c.vertices) {
            Vec3 p = canonical_place(c, v);
            if (v.joints[0] == left_hand && v.weights[0] > 250) hand_inner = std::min(hand_inner, p.x);
            bool hip = v.joints[0] == hips || v.joints[0] == left_upper_leg;
            if (hip && std::fabs(p.y - wrist.y) < 0.05f) hip_outer = std::max(hip_outer, p.x);
        }
        EXPECT_GT(hand_inner, hip_outer - 0.05f * options.height) << options.seed;
    }
}

TEST(Person, JointsMirror) {
    for (const auto& [options, c] : several()) {
        for (auto [left, right] :
             {std::pair{int(left_shoulder), int(right_shoulder)}, {left_upper_leg, right_upper_leg}})
            for (int n = 0; n < 4; ++n)
                for (const auto& joints : {c.body.joints, c.bind_joints}) {
                    Vec3 l = joints[size_t(left + n)], r = joints[size_t(right + n)];
                    EXPECT_EQ(l, (Vec3{-r.x, r.y, r.z})) << k_joint_names[size_t(left + n)];
                }
    }
}

TEST(Person, LevelsOfDetailFall) {
    for (const auto& [options, c] : several()) {
        ASSERT_EQ(c.lods.size(), 5u);
        const size_t wanted[] = {7600, 3000, 1500, 500, 180};
        for (size_t l = 0; l < 5; ++l) {
            size_t triangles = c.lods[l].size() / 3;
            EXPECT_LE(triangles, wanted[l] + wanted[l] / 10 + 4)
                << "level " << l << ", seed " << options.seed;
            EXPECT_GE(triangles, wanted[l] / 2) << "level " << l << ", seed " << options.seed;
            for (uint32_t v : c.lods[l]) ASSERT_LT(v, c.vertices.size());
        }
    }
}

// The corner of a level that is highest; of several, what most of them are.
Tint crown(const Character& c, const std::vector<uint32_t>& level) {
    auto height = [&](uint32_t v) { return c.vertices[v].position.y; };
    const float top = height(*std::ranges::max_element(level, {}, height));
    std::array<int, k_tint_count> seen{};
    for (uint32_t v : level)
        if (height(v) > top - 0.01f) ++seen[size_t(c.vertices[v].tint)];
    return static_cast<Tint>(std::ranges::max_element(seen) - seen.begin());
}

TEST(Person, HatsAndHairAreOnEachLevel) {
    for (const PersonOptions& options : draw_population(k_crowd, k_seed)) {
        if (options.headphones) continue;  // whose band may be lost
        const Character c = generate_person(options);
        for (const auto& level : c.lods)
            EXPECT_EQ(crown(c, level), crown(c, c.lods[0]))
                << "seed " << options.seed << ", " << level.size();
    }
}

TEST(Person, SameOptionsSameBytes) {
    EXPECT_EQ(hash_of(generate_person({3, 1.7f, true})), hash_of(generate_person({3, 1.7f, true})));
    EXPECT_NE(hash_of(generate_person({3, 1.7f, true})), hash_of(generate_person({3, 1.7f, false})));
    EXPECT_NE(hash_of(generate_person({3, 1.7f, true})), hash_of(generate_person({4, 1.7f, true})));
}

// Heights of a standing body from chin to crown and from hip to ground.
TEST(Person, ChildrenHaveLargeHeads) {
    auto heads = [](float age) {
        PersonOptions options{1, mean_height(true, age), true, age};
        Character c = generate_person(options);
        return options.height / (options.height - c.body.joints[head].y);
    };
    float child = heads(5), youth = heads(12), adult = heads(30);
    EXPECT_LT(child, 0.87f * adult);
    EXPECT_LT(child, youth);
    EXPECT_LT(youth, adult);
}

TEST(Person, TheOldStoop) {
    PersonOptions options{1, 1.7f, false, 30};
    float upright = generate_person(options).body.joints[head].z;
    options.age = 84;
    EXPECT_GT(generate_person(options).body.joints[head].z, upright + 0.03f);
}

TEST(Population, IsBalancedAndShowsEverything) {
    auto people = draw_population(k_crowd, k_seed);
    ASSERT_EQ(people.size(), k_crowd);
    size_t women = 0, young = 0, old = 0;
    std::map<std::string, std::map<int, int>> worn;
    for (const PersonOptions& p : people) {
        women += p.woman;
        young += p.age < 18;
        old += p.age > 65;
        EXPECT_GE(p.age, 5);
        EXPECT_LE(p.age, 85);
        EXPECT_NEAR(p.height, mean_height(p.woman, p.age), 0.16f);
        EXPECT_FALSE(p.phone && p.stick) << "one hand";
        ++worn["hair"][int(p.hair)], ++worn["top"][int(p.top)], ++worn["over"][int(p.over)];
        ++worn["bottom"][int(p.bottom)], ++worn["shoes"][int(p.shoes)], ++worn["hat"][int(p.hat)];
        ++worn["bag"][int(p.bag)], ++worn["beard"][int(p.beard)];
        for (auto [name, has] : {std::pair{"glasses", p.glasses},
                                 {"scarf", p.scarf},
                                 {"phone", p.phone},
                                 {"headphones", p.headphones},
                                 {"stick", p.stick}})
            ++worn[name][has];
    }
    EXPECT_NEAR(int(women), int(k_crowd / 2), 1);
    EXPECT_EQ(young, 3u);
    EXPECT_EQ(old, 4u);
    const std::pair<const char*, size_t> kinds[] = {{"hair", k_hair_count},
                                                    {"top", 4},
                                                    {"over", 5},
                                                    {"bottom", 7},
                                                    {"shoes", 4},
                                                    {"hat", 4},
                                                    {"bag", 4},
                                                    {"beard", 3},
                                                    {"glasses", 2},
                                                    {"scarf", 2},
                                                    {"phone", 2},
                                                    {"headphones", 2},
                                                    {"stick", 2}};
    for (auto [what, count] : kinds) EXPECT_EQ(worn[what].size(), count) << what;
}

TEST(Population, FewerAreTheFirstOfMore) {
    auto few = draw_population(5, 7), many = draw_population(50, 7);
    for (size_t i = 0; i < few.size(); ++i) {
        EXPECT_EQ(few[i].seed, many[i].seed);
        EXPECT_EQ(few[i].height, many[i].height);
        EXPECT_EQ(few[i].hair, many[i].hair);
        EXPECT_EQ(few[i].bag, many[i].bag);
    }
    EXPECT_NE(draw_population(1, 8)[0].seed, few[0].seed);
}

TEST(Outfit, HairGreysWithAge) {
    auto grey_of = [](float age) {
        PersonOptions person;
        person.age = age;
        int grey = 0;
        for (uint32_t i = 0; i < 200; ++i) {
            uint32_t hair = outfit(person, k_seed, i)[size_t(Tint::hair)];
            auto channel = [&](int shift) { return int(hair >> shift & 0xffu); };
            grey += channel(0) > 90 && channel(0) - channel(16) < 20;
        }
        return grey;
    };
    EXPECT_EQ(grey_of(25), 0);
    EXPECT_GT(grey_of(80), 190);
}

TEST(Population, SomePushPrams) {
    for (uint64_t seed : {1, 2, 3, 30}) {
        float share = 0;
        int women = 0, grandparents = 0;
        for (const Pusher& pusher : draw_pushers(seed)) {
            const PersonOptions& p = pusher.person;
            EXPECT_TRUE(p.pram);
            EXPECT_TRUE(p.bag == Bag::none && !p.stick && !p.phone && !p.scarf) << "both hands";
            const bool is_old = p.age > 45;
            EXPECT_TRUE(is_old ? p.age >= 55 && p.age <= 70 : p.age >= 22) << p.age;
            women += p.woman && !is_old, grandparents += is_old;
            share += pusher.share;
        }
        EXPECT_EQ(women, 1);
        EXPECT_EQ(grandparents, 1);
        EXPECT_NEAR(share, 0.015f, 0.005f);
    }
    for (const PersonOptions& p : draw_population(50, 7)) EXPECT_FALSE(p.pram);
}

// On each level it is as long, stands on the ground and has a handle where the simulation is told.
TEST(Person, PramsAreWholeOnEachLevel) {
    for (bool woman : {true, false}) {
        PersonOptions options{.seed = 5, .height = woman ? 1.6f : 1.85f, .woman = woman};
        EXPECT_EQ(generate_person(options).body.pram, Vec3{});
        options.pram = true;
        const Character person = generate_person(options);
        const Vec3 handle = person.body.pram;
        ASSERT_GE(person.lods.size(), 4u);
        for (const auto& level : person.lods) {
            Vec3 low{9, 9, 9}, high{-9, -9, -9};
            for (uint32_t i : level) {
                const CharacterVertex& v = person.vertices[i];
                const bool pushed = v.hung_weights[0] == 255 &&
                                    (v.hung_joints[0] == carried_bag || v.hung_joints[0] == scarf_end);
                if (!pushed) continue;
                low = {std::min(low.x, v.position.x), std::min(low.y, v.position.y),
                       std::min(low.z, v.position.z)};
                high = {std::max(high.x, v.position.x), std::max(high.y, v.position.y),
                        std::max(high.z, v.position.z)};
            }
            const size_t triangles = level.size() / 3;
            EXPECT_NEAR(high.z - low.z, 0.96f, 0.06f) << triangles;
            EXPECT_NEAR(high.x - low.x, 0.54f, 0.05f) << triangles;
            EXPECT_NEAR(low.y, 0, 0.02f) << triangles;
            EXPECT_NEAR(high.y, handle.y, 0.03f) << triangles;
            EXPECT_NEAR(low.z, handle.z, 0.04f) << triangles;
        }
    }
}

// The simulation is told where the tip of a stick is: the lowest of it that the hand carries.
TEST(Person, TellsWhereTheTipOfItsStickIs) {
    for (float height : {1.5f, 1.8f}) {
        PersonOptions options{.seed = 5, .height = height, .age = 75};
        EXPECT_EQ(generate_person(options).body.cane, Vec3{});
        options.stick = true;
        Character person = generate_person(options);
        float nearest = 1, lowest = 0;
        for (const CharacterVertex& v : person.vertices) {
            if (v.joints[0] != right_hand || v.weights[0] != 255) continue;
            Vec3 place =
                rotate(person.bind_to_canonical[right_hand], v.position - person.bind_joints[right_hand]);
            nearest = std::min(nearest, length(place - person.body.cane));
            lowest = std::min(lowest, place.y);
        }
        EXPECT_LT(nearest, 0.012f) << "its radius";
        EXPECT_NEAR(lowest, person.body.cane.y, 0.008f);
    }
}

}  // namespace
}  // namespace flaneur
