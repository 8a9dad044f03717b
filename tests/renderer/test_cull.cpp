#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "renderer/visible/contacts.h"
#include "renderer/visible/cull.h"
#include "tests/renderer/synthetic_scene.h"

namespace flaneur {
namespace {

std::vector<PersonRanges> two_kinds() {
    std::vector<PersonRanges> people(2);
    people[0] = {{{0, 300}, {300, 150}, {450, 60}, {510, 30}}, 0, {}};
    people[1] = {{{540, 600}, {1140, 90}}, 100, {}};  // two levels only
    return people;
}

std::vector<WalkerDraw> ring_of_walkers(int count) {
    std::vector<WalkerDraw> walkers;
    for (int i = 0; i < count; ++i) {
        const float t = static_cast<float>(i) * 2.399963f, distance = 1 + 0.1f * static_cast<float>(i);
        WalkerDraw walker{};
        walker.centre = {distance * std::sin(t), 0.9f, distance * std::cos(t)};
        walker.radius = 0.95f;
        walker.mesh = static_cast<uint32_t>(i % 2);
        walker.instance.palette = static_cast<uint32_t>(i * k_palette_joints);
        walkers.push_back(walker);
    }
    return walkers;
}

TEST(Cull, CountsMatchBruteForceAndOrderIsStable) {
    const std::vector<PersonRanges> people = two_kinds();
    const std::vector<WalkerDraw> walkers = ring_of_walkers(1500);
    const View view = make_view({}, 1280, 720);
    CrowdDraws out;
    cull_crowd({walkers, people, walkers.size() * k_palette_joints}, view, out);

    std::vector<std::vector<uint32_t>> expected(k_max_lods * 2);
    uint32_t seen = 0, listed = 0;
    for (const WalkerDraw& walker : walkers) {
        bool is_in = true;
        for (const glm::vec4& plane : view.planes)
            is_in = is_in && glm::dot(glm::vec3(plane), walker.centre) + plane.w >= -walker.radius;
        if (!is_in) continue;
        ++seen;
        const float pixels =
            2 * walker.radius * view.pixels_at_one_metre / glm::length(walker.centre - view.eye);
        size_t last = expected.size();
        for (const float side : {-1.0f, 1.0f}) {
            const float size = pixels / (1 + side * k_turns * 15 / 17);  // 1..15 pixels of 16
            size_t lod = size >= 840 ? 0 : size >= 420 ? 1 : size >= 150 ? 2 : size >= 70 ? 3 : 4;
            lod = std::min(lod, people[walker.mesh].lods.size() - 1);
            if (lod == last) continue;
            expected[lod * 2 + walker.mesh].push_back(walker.instance.palette);
            listed += 1, last = lod;
        }
    }
    ASSERT_EQ(out.instances.size(), listed);
    ASSERT_GT(seen, 100u);
    ASSERT_GT(listed, seen);
    size_t draw = 0, instance = 0;
    for (size_t bucket = 0; bucket < expected.size(); ++bucket) {
        if (expected[bucket].empty()) continue;
        const DrawCommand& command = out.draws.at(draw++);
        const PersonRanges& person = people[bucket % 2];
        EXPECT_EQ(command.instance_count, expected[bucket].size());
        EXPECT_EQ(command.first_instance, instance);
        EXPECT_EQ(command.first_index, person.lods[bucket / 2].first_index);
        EXPECT_EQ(command.index_count, person.lods[bucket / 2].index_count);
        EXPECT_EQ(command.vertex_offset, person.vertex_offset);
        for (uint32_t palette : expected[bucket]) EXPECT_EQ(out.instances[instance++].palette, palette);
    }
    EXPECT_EQ(out.draws.size(), draw);
}

// Who is only partly there is drawn in so many pixels, whatever its level; and a shadow is all there or not.
TEST(Cull, PresenceIsDrawnInSharesOfPixels) {
    const std::vector<PersonRanges> people = two_kinds();
    const View view = make_view({.eye = {0, 1, -6}, .target = {0, 1, 0}}, 1280, 720);
    const glm::vec3 to_sun = glm::normalize(glm::vec3(0.4f, 0.42f, 0.8f));
    const ShadowBox box = fit_shadow(view, to_sun, {0, 90}, 2048);
    int last = 0;
    for (int presence = 0; presence < 256; ++presence) {
        std::vector<WalkerDraw> walkers = ring_of_walkers(1);
        walkers[0].presence = static_cast<uint8_t>(presence);
        CrowdDraws out, casters;
        const CrowdInput input{walkers, people, walkers.size() * k_palette_joints};
        cull_crowd(input, view, out);
        cull_shadow_casters(input, view, box, to_sun, 90, casters);
        const int drawn = out.instances.empty() ? 0 : 16 - std::popcount(out.instances[0].hidden);
        EXPECT_NEAR(drawn, 16.0 * presence / 255, 1);
        EXPECT_GE(drawn, last);
        EXPECT_EQ(casters.instances.size(), presence >= 128 ? 1u : 0u);
        last = drawn;
    }
    EXPECT_EQ(last, 16);
}

// Between two levels both leave out those pixels.
TEST(Cull, PresenceHoldsBetweenLevels) {
    const std::vector<PersonRanges> people = two_kinds();
    std::vector<WalkerDraw> walkers = ring_of_walkers(1500);
    const View view = make_view({}, 1280, 720);
    auto pixels_drawn = [&](uint8_t presence) {
        for (WalkerDraw& walker : walkers) walker.presence = presence;
        CrowdDraws out;
        cull_crowd({walkers, people, walkers.size() * k_palette_joints}, view, out);
        std::vector<int> drawn(walkers.size() * k_palette_joints);
        for (const WalkerInstance& one : out.instances)
            drawn[one.palette] += 16 - std::popcount(one.hidden & 0xffffu);
        return drawn;
    };
    const std::vector<int> half = pixels_drawn(128), whole = pixels_drawn(255);
    for (size_t i = 0; i < whole.size(); ++i) EXPECT_EQ(half[i], whole[i] == 16 ? 8 : 0);
}

TEST(Cull, ManyThreadsListWhatOneLists) {
    const std::vector<PersonRanges> people = two_kinds();
    std::vector<WalkerDraw> walkers = ring_of_walkers(20'000);
    for (size_t i = 0; i < walkers.size(); i += 3) walkers[i].centre *= 0.05f;
    const View view = make_view({.eye = {0, 30, -40}}, 1280, 720);
    const ShadowBox box = fit_shadow(view, glm::normalize(glm::vec3(0.4f, 0.42f, 0.8f)), {0, 90}, 2048);
    const WorkersPtr workers = make_workers(7);
    CrowdInput input{walkers, people, walkers.size() * k_palette_joints, 20};
    CrowdDraws alone[2], together[2];
    auto draw = [&](CrowdDraws* out) {
        cull_crowd(input, view, out[0]);
        cull_shadow_casters(input, view, box, glm::normalize(glm::vec3(0.4f, 0.42f, 0.8f)), 90, out[1]);
    };
    draw(alone);
    input.workers = workers.get();
    draw(together);
    for (int i = 0; i < 2; ++i) {
        auto bytes = [](const auto& of) { return std::as_bytes(std::span(of)); };
        EXPECT_TRUE(std::ranges::equal(bytes(alone[i].instances), bytes(together[i].instances)));
        EXPECT_TRUE(std::ranges::equal(bytes(alone[i].draws), bytes(together[i].draws)));
        EXPECT_TRUE(std::ranges::equal(bytes(alone[i].spheres), bytes(together[i].spheres)));
        EXPECT_TRUE(std::ranges::equal(bytes(alone[i].levels), bytes(together[i].levels)));
        EXPECT_EQ(alone[i].triangles, together[i].triangles);
        EXPECT_GT(alone[i].instances.size(), 100u);
    }
}

TEST(Cull, LevelsGetCoarserWithDistance) {
    std::vector<PersonRanges> people(1);
    people[0].lods.assign(k_max_lods, {0, 3});
    std::vector<WalkerDraw> walkers = ring_of_walkers(1);
    const View view = make_view({}, 1280, 720);
    uint8_t first = k_unseen, last = 0;
    for (float distance = 1; distance < 300; distance *= 1.1f) {
        walkers[0].centre = view.eye + view.forward * distance;
        CrowdDraws out;
        cull_crowd({walkers, people, k_palette_joints}, view, out);
        const Levels levels = out.levels.at(0);
        EXPECT_GE(levels.fine, last);
        EXPECT_GE(levels.coarse, levels.fine);
        EXPECT_LE(levels.coarse, levels.fine + 1);
        first = std::min(first, levels.fine), last = levels.fine;
    }
    EXPECT_EQ(first, 0u);
    EXPECT_EQ(last, k_max_lods - 1);
}

TEST(Cull, SmallOnesAreImpostorsInTurnsNearTheBorder) {
    std::vector<PersonRanges> people = two_kinds();
    people[0].first_cell = 1000;
    const View view = make_view({}, 1280, 720);
    std::vector<WalkerDraw> walkers = ring_of_walkers(1);
    walkers[0].mesh = 0;
    const float border = 2 * 0.95f * view.pixels_at_one_metre / 40;  // metres away
    CrowdDraws out;
    auto draw_at = [&](float distance) {
        walkers[0].centre = view.eye + view.forward * distance;
        cull_crowd({walkers, people, k_palette_joints, 40}, view, out);
    };
    draw_at(border * (1 - 1.1f * k_turns));
    EXPECT_EQ(out.impostors.size(), 0u);
    ASSERT_EQ(out.instances.size(), 1u);
    EXPECT_EQ(out.instances[0].hidden, 0u);
    draw_at(border * (1 + 1.1f * k_turns));
    EXPECT_EQ(out.instances.size(), 0u);
    ASSERT_EQ(out.impostors.size(), 1u);
    EXPECT_EQ(out.impostors[0].hidden, 0u);
    // On the way each pixel is of the one or of the other, and goes over once.
    int parts = 0;
    uint32_t hidden = 0;
    for (float share = -1; share <= 1; share += 0.01f) {
        draw_at(border / (1 - share * k_turns));
        EXPECT_EQ(out.levels[0].fine == k_impostor_level, out.instances.empty());
        const uint32_t now = out.instances.empty() ? 0xffffu : out.instances[0].hidden;
        if (!out.impostors.empty() && !out.instances.empty()) {
            EXPECT_EQ(out.impostors[0].hidden, ~now & 0xffffu);
            EXPECT_EQ(out.triangles, 2u + 10u);
        }
        EXPECT_EQ(hidden & ~now, 0u) << share;
        parts += now != hidden;
        hidden = now;
    }
    EXPECT_EQ(hidden, 0xffffu);
    EXPECT_EQ(parts, 16);
}

TEST(Cull, ACompanionTakesNoTurns) {
    const std::vector<PersonRanges> people = two_kinds();
    const View view = make_view({}, 1280, 720);
    std::vector<WalkerDraw> walkers = ring_of_walkers(3);
    for (WalkerDraw& walker : walkers) {
        walker.centre = view.eye + view.forward * (2 * 0.95f * view.pixels_at_one_metre / 420);
        walker.mesh = 0;
    }
    CrowdInput input{walkers, people, 3 * k_palette_joints};
    input.companion = 1;
    CrowdDraws out;
    cull_crowd(input, view, out);
    EXPECT_EQ(out.instances.size(), 5u);
    EXPECT_EQ(out.levels[1].fine, out.levels[1].coarse);
    EXPECT_EQ(out.levels[1].hidden, 0);
    EXPECT_NE(out.levels[0].fine, out.levels[0].coarse);
    input.companion = 3;  // nobody
    cull_crowd(input, view, out);
    EXPECT_EQ(out.instances.size(), 6u);
}

TEST(Cull, LevelsThatAreOneMeshTakeNoTurns) {
    const std::vector<PersonRanges> people = two_kinds();  // the second has two levels only
    const View view = make_view({}, 1280, 720);
    std::vector<WalkerDraw> walkers = ring_of_walkers(2);
    CrowdDraws out;
    for (WalkerDraw& walker : walkers)
        walker.centre = view.eye + view.forward * (2 * 0.95f * view.pixels_at_one_metre / 150);
    cull_crowd({walkers, people, 2 * k_palette_joints}, view, out);
    ASSERT_EQ(out.instances.size(), 3u);
    ASSERT_EQ(out.draws.size(), 3u);
    EXPECT_EQ(std::count_if(out.instances.begin(), out.instances.end(),
                            [](const WalkerInstance& instance) { return instance.hidden == 0; }),
              1);
}

TEST(Cull, WhoIsSeenAsAnImpostorThrowsItsShadow) {
    std::vector<PersonRanges> people = two_kinds();
    people[0].first_cell = 1000;
    const View view = make_view({}, 1280, 720);
    const glm::vec3 to_sun = glm::normalize(glm::vec3(0.3f, 0.6f, 0.5f));
    const ShadowBox box = fit_shadow(view, to_sun, {0, 120}, 2048);
    std::vector<WalkerDraw> walkers = ring_of_walkers(2);
    for (WalkerDraw& walker : walkers) walker.centre = {0, 0.9f, 80};
    CrowdDraws out;
    cull_shadow_casters({walkers, people, 2 * k_palette_joints, 40}, view, box, to_sun, 120, out);
    EXPECT_EQ(out.impostors.size(), 1u);
    EXPECT_EQ(out.instances.size(), 1u);  // the second has no impostors
}

TEST(Cull, ImpostorsShowThePhaseNearest) {
    std::vector<PersonRanges> people = two_kinds();
    people[0].first_cell = 1000;
    std::vector<WalkerDraw> walkers = ring_of_walkers(1);
    auto pose_at = [&](float phase) {
        walkers[0].centre = {0, 1.6f, 200};
        walkers[0].phase = phase;
        CrowdDraws out;
        cull_crowd({walkers, people, k_palette_joints, 40}, make_view({}, 1280, 720), out);
        return (out.impostors.at(0).first_cell - 1000) / k_impostor_views;
    };
    EXPECT_EQ(pose_at(0), 0u);
    EXPECT_EQ(pose_at(0.18f), 1u);
    EXPECT_EQ(pose_at(0.19f), 2u);
    EXPECT_EQ(pose_at(0.95f), 0u);
    for (float standing : {-1.0f, std::nanf(""), INFINITY}) EXPECT_EQ(pose_at(standing), 8u);
}

TEST(Cull, LeavesOutWhatRefersNowhere) {
    const std::vector<PersonRanges> people = two_kinds();
    std::vector<WalkerDraw> walkers = ring_of_walkers(4);
    for (WalkerDraw& walker : walkers) walker.centre = {0, 1.6f, 5};
    walkers[0].mesh = 2;
    walkers[1].instance.palette = 4 * k_palette_joints - 1;
    walkers[2].centre.x = std::nanf("");
    CrowdDraws out;
    cull_crowd({walkers, people, 4 * k_palette_joints}, make_view({}, 1280, 720), out);
    ASSERT_EQ(out.instances.size(), 1u);
    EXPECT_EQ(out.instances[0].palette, walkers[3].instance.palette);
}

TEST(Cull, ShadowCastersAreNearCoarserAndMayStandBehindTheEye) {
    const std::vector<PersonRanges> people = two_kinds();
    const View view = make_view({}, 1280, 720);
    const glm::vec3 to_sun = glm::normalize(glm::vec3(0, 0.42f, -0.9f));  // behind the viewer
    const ShadowBox box = fit_shadow(view, to_sun, {0, 60}, 2048);
    std::vector<WalkerDraw> walkers = ring_of_walkers(3);
    for (WalkerDraw& walker : walkers) walker.mesh = 0;
    walkers[0].centre = {0, 0.9f, 2};
    walkers[1].centre = {0, 0.9f, -1.2f};  // its shadow falls ahead of the eye
    walkers[2].centre = {0, 0.9f, 61};     // too far
    CrowdDraws out;
    cull_shadow_casters({walkers, people, 3 * k_palette_joints}, view, box, to_sun, 60, out);
    ASSERT_EQ(out.instances.size(), 2u);
    ASSERT_EQ(out.draws.size(), 1u);
    EXPECT_EQ(out.draws[0].first_index, people[0].lods.back().first_index) << "as coarse as the map's texels";
    ShadowBox fine = box;
    fine.texel = 1e-4f;
    cull_shadow_casters({walkers, people, 3 * k_palette_joints}, view, fine, to_sun, 60, out);
    EXPECT_EQ(out.draws[0].first_index, people[0].lods[1].first_index);
    EXPECT_EQ(out.spheres.size(), 2u);
    CrowdDraws seen;
    cull_crowd({walkers, people, 3 * k_palette_joints}, view, seen);
    EXPECT_EQ(seen.instances.size(), 2u);  // the first and the third
}

TEST(Cull, TheBodyThatTheEyeIsInIsNotDrawn) {
    const std::vector<PersonRanges> people = two_kinds();
    const View view = make_view({.eye = {0, 1.6f, 0}, .target = {0, 1.6f, 1}}, 1280, 720);
    std::vector<WalkerDraw> walkers = ring_of_walkers(2);
    for (WalkerDraw& walker : walkers) walker.mesh = 0;
    walkers[0].centre = {0.1f, 0.9f, 0.1f};
    walkers[1].centre = {0.1f, 0.9f, 2};
    CrowdDraws seen;
    cull_crowd({walkers, people, 2 * k_palette_joints}, view, seen);
    ASSERT_EQ(seen.instances.size(), 1u);
    EXPECT_EQ(seen.instances[0].palette, walkers[1].instance.palette);
}

TEST(Cull, WhoNeedsNoJointsIsDrawnAlikeWithoutThem) {
    const std::vector<PersonRanges> people = [] {
        std::vector<PersonRanges> some = two_kinds();
        some[0].first_cell = 0, some[1].first_cell = k_person_cells;
        return some;
    }();
    std::vector<WalkerDraw> walkers = ring_of_walkers(1500);
    const PoseNeeds needs{make_view({}, 1280, 720), glm::normalize(glm::vec3(0.4f, 0.42f, 0.8f)), 30};
    const size_t palette = walkers.size() * k_palette_joints;
    const ShadowBox box = fit_shadow(needs.view, needs.to_sun, {0, 60}, 2048);
    CrowdDraws with, without, casters_with, casters_without;
    auto draw = [&](CrowdDraws& crowd, CrowdDraws& casters) {
        const CrowdInput input{walkers, people, palette, 35};
        cull_crowd(input, needs.view, crowd);
        cull_shadow_casters(input, needs.view, box, needs.to_sun, 60, casters);
    };
    draw(with, casters_with);
    size_t posed = 0;
    for (WalkerDraw& walker : walkers) {
        if (needs_pose(needs, walker.centre, walker.radius))
            ++posed;
        else
            walker.instance.palette = k_no_palette;
    }
    draw(without, casters_without);
    EXPECT_GT(posed, 50u);
    EXPECT_LT(posed, walkers.size() / 2);
    EXPECT_GT(with.impostors.size(), 50u);
    for (auto [a, b] : {std::pair(&with, &without), std::pair(&casters_with, &casters_without)}) {
        ASSERT_EQ(a->instances.size(), b->instances.size());
        for (size_t i = 0; i < a->instances.size(); ++i)
            EXPECT_EQ(a->instances[i].palette, b->instances[i].palette);
        EXPECT_EQ(a->impostors.size(), b->impostors.size());
        EXPECT_EQ(a->triangles, b->triangles);
    }
}

TEST(Cull, ChunksComeNearestFirstAndCoarseFromFarAway) {
    const View view = make_view({}, 1280, 720);
    const CityChunk chunks[] = {{{-1, 0, 80}, {1, 2, 82}, {30, 6}, {0, 3}},
                                {{-1, 0, 5}, {1, 2, 7}, {3, 6}, {}},
                                {{-1, 0, -20}, {1, 2, -10}, {9, 3}, {}},
                                {{-1, 0, 20}, {1, 2, 22}, {12, 9}, {}},
                                {{-1, 0, 90}, {1, 2, 92}, {24, 3}, {}}};
    std::vector<DrawCommand> draws;
    ASSERT_EQ(cull_chunks(chunks, view, {}, draws), 3u);
    EXPECT_EQ(draws[0].first_index, 3u);
    EXPECT_EQ(draws[1].first_index, 12u);
    EXPECT_EQ(draws[2].first_index, 0u);
}

// The spots of the first walker of a scene, whose soles are where its kind has them.
std::vector<Contact> contacts_of(const SyntheticScene& scene) {
    std::vector<PersonRanges> people = two_kinds();
    people[0].soles[0] = {0.09f, 0, 0.05f};
    people[0].soles[1] = {-0.09f, 0, 0.05f};
    std::vector<Contact> contacts;
    find_contacts({scene.walkers, people, scene.palette.size()}, scene.palette, scene.grounds,
                  make_view({}, 1280, 720), contacts);
    return contacts;
}

TEST(Cull, ContactsLieUnderTheFeet) {
    SyntheticScene scene;
    add_walker(scene, {0, 0.5f, 6}, 0, 0.0f, 1);
    const std::vector<Contact> contacts = contacts_of(scene);
    ASSERT_GE(contacts.size(), 2u);
    for (const Contact& contact : contacts) {
        EXPECT_NEAR(contact.place.y, 0.5f, 1e-4f);
        EXPECT_NEAR(contact.place.z, 6, 0.5f);
        EXPECT_GT(contact.strength, 0);
    }
}

TEST(Cull, ContactsStayOnTheGroundUnderWhoLeaps) {
    SyntheticScene scene;
    add_walker(scene, {0, 0.5f, 6}, 0, 0.0f, 1);
    const std::vector<Contact> stands = contacts_of(scene);
    auto rise = [&](float by) {
        for (JointTransform& joint : scene.palette) joint.translation.y += by;
        return contacts_of(scene);
    };
    const std::vector<Contact> low = rise(0.03f), high = rise(0.27f);
    ASSERT_EQ(low.size(), stands.size());
    for (size_t i = 0; i < low.size(); ++i) {
        EXPECT_NEAR(low[i].place.y, 0.5f, 1e-4f);
        EXPECT_LT(low[i].strength, stands[i].strength);
    }
    ASSERT_EQ(high.size(), 1u);  // the body's alone
    EXPECT_NEAR(high[0].place.y, 0.5f, 1e-4f);
    EXPECT_LT(high[0].strength, low.back().strength);
}

TEST(Cull, ContactsLieOnSlopesAndTreads) {
    SyntheticScene scene;
    add_walker(scene, {0, 0, 6}, 0, 0.0f, 1);
    const glm::vec3 normal = glm::normalize(glm::vec3(0, 1, -0.2f));
    GroundBelow& ground_below = scene.grounds[0];
    ground_below.feet[0] = {{0, 0, 6}, normal};
    ground_below.feet[1] = {{0, -0.17f, 6}, {0, 1, 0}};  // 17 cm lower: its foot is in the air
    ground_below.body = {};
    std::vector<Contact> contacts = contacts_of(scene);
    ASSERT_EQ(contacts.size(), 1u);
    EXPECT_NEAR(glm::dot(contacts[0].place - glm::vec3(0, 0, 6), normal), 0, 1e-4f);
    EXPECT_EQ(contacts[0].normal, normal);
    ground_below.pram = {{0, 0.1f, 5}, normal};
    contacts = contacts_of(scene);
    ASSERT_EQ(contacts.size(), 2u);
    EXPECT_NEAR(glm::distance(contacts[1].place, ground_below.pram.place), 0, 1e-4f);
    scene.grounds.clear();
    EXPECT_TRUE(contacts_of(scene).empty());
}

TEST(Cull, NoContactsLieBehindWalls) {
    SyntheticScene scene;
    add_walker(scene, {0, 0, 6}, 0, 0.0f, 1);   // before the wall
    add_walker(scene, {0, 0, 14}, 0, 0.0f, 1);  // behind it
    const std::vector<PersonRanges> people = two_kinds();
    const View view = make_view({}, 1280, 720);
    const glm::vec3 a(10, -1, 10), b(-10, -1, 10), up(0, 8, 0);
    const Wall wall{{a, b, b + up, a + up}};
    const WallGroup group{{-10, -1, 10}, {10, 7, 10}, 0, 1};
    OcclusionMap hidden;
    draw_walls(std::span(&group, 1), std::span(&wall, 1), view, hidden);
    CrowdInput input{scene.walkers, people, scene.palette.size()};
    std::vector<Contact> all, seen;
    find_contacts(input, scene.palette, scene.grounds, view, all);
    input.hidden = &hidden;
    find_contacts(input, scene.palette, scene.grounds, view, seen);
    ASSERT_GT(all.size(), seen.size());
    ASSERT_FALSE(seen.empty());
    for (const Contact& contact : seen) EXPECT_LT(contact.place.z, 10);
}

}  // namespace
}  // namespace flaneur
