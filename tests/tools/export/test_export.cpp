// What is exported, read again by tinygltf and by our own readers, is what was drawn, and where everybody
// was.
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "assets/gltf/animation.h"
#include "assets/gltf/group/group.h"
#include "assets/gltf/group/keys.h"
#include "assets/gltf/read.h"
#include "assets/trajectories/trajectories.h"
#include "sim/base/math.h"
#include "sim/sim.h"
#include "tests/folder.h"
#include "tests/tools/loaded.h"
#include "tools/flaneur/commands.h"
#include "tools/flaneur/export/people.h"
#include "tools/flaneur/recording/playing.h"
#include "tools/flaneur/recording/taking.h"

namespace flaneur {
namespace {

// A file of people as our own reader has it, with what tinygltf says of it.
struct ReadGroup {
    tinygltf::Model model;
    GltfScene scene;
    std::vector<GltfAnimation> clips;

    size_t node_of(const std::string& name) const {
        return static_cast<size_t>(std::ranges::find(scene.nodes, name, &GltfNode::name) -
                                   scene.nodes.begin());
    }
    // Vertices of somebody's mesh, in the order of its surfaces.
    std::vector<Vec3> posed(const std::string& name, const GltfAnimation& clip, float time) const {
        const std::vector<Affine> nodes = pose_nodes(scene, clip, time);
        const GltfNode& body = scene.nodes.at(node_of(name + " body"));
        const GltfSkin& skin = scene.skins.at(static_cast<size_t>(body.skin));
        std::vector<Vec3> out;
        for (const GltfPrimitive& p : scene.meshes.at(static_cast<size_t>(body.mesh))) {
            for (size_t v = 0; v < p.positions.size(); ++v) {
                Vec3 sum;
                for (int k = 0; k < p.influences_per_vertex; ++k) {
                    const auto at = v * static_cast<size_t>(p.influences_per_vertex) + static_cast<size_t>(k);
                    const auto [joint, weight] = p.influences[at];
                    const Affine bone =
                        nodes[static_cast<size_t>(skin.joints[joint])] * skin.inverse_binds[joint];
                    sum = sum + transform(bone, p.positions[v]) * weight;
                }
                out.push_back(sum);
            }
        }
        return out;
    }
};

ReadGroup read_group(const std::string& bytes) {
    ReadGroup read;
    std::string error, warning;
    EXPECT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromMemory(
        &read.model, &error, &warning, reinterpret_cast<const unsigned char*>(bytes.data()),
        static_cast<unsigned int>(bytes.size())));
    EXPECT_EQ(error + warning, "");
    Result<GltfScene> scene = read_scene(read.model, "the file", k_city_use);
    EXPECT_TRUE(scene) << scene.error().message;
    if (scene) read.scene = std::move(*scene);
    for (size_t i = 0; i < read.model.animations.size(); ++i) {
        Result<GltfAnimation> clip = read_animation(read.model, i);
        EXPECT_TRUE(clip) << clip.error().message;
        if (clip) read.clips.push_back(std::move(*clip));
    }
    return read;
}

// The same vertices as drawn, from what shaders are given.
std::vector<Vec3> drawn(const GlbPerson& person, size_t i) {
    const Character& c = *person.character;
    std::vector<Vec3> out;
    std::vector<uint8_t> is_told(c.vertices.size());
    for (size_t picture = 0; picture <= c.textures.size(); ++picture)
        for (const uint32_t at : c.lods[0]) {
            const CharacterVertex& v = c.vertices[at];
            if (is_told[at] || std::min<size_t>(v.texture, c.textures.size()) != picture) continue;
            is_told[at] = 1;
            const bool hangs = v.hung_weights[0] > 0;
            Vec3 sum;
            for (int k = 0; k < 4; ++k) {
                const DrawnBone& bone = person.poses[i][hangs ? v.hung_joints[k] : v.joints[k]];
                const float weight = static_cast<float>(hangs ? v.hung_weights[k] : v.weights[k]) / 255;
                sum = sum + (rotate(bone.turn, v.position * person.scale) + bone.shift) * weight;
            }
            out.push_back(sum);
        }
    return out;
}

// Everybody's mesh where it was drawn, at every seventh of their frames, in both of their clips.
void expect_as_drawn(const GlbGroup& group, const ReadGroup& read) {
    float worst = 0;
    for (size_t p = 0; p < group.people.size(); ++p) {
        const GlbPerson& person = group.people[p];
        for (size_t i = 0; i < person.frames.size(); i += 7) {
            const float time = static_cast<float>(person.frames[i]) / group.fps;
            const std::vector<Vec3> as_drawn = drawn(person, i);
            for (const GltfAnimation* clip : {&read.clips.front(), &read.clips.at(p + 1)}) {
                const std::vector<Vec3> posed = read.posed(person.name, *clip, time);
                ASSERT_EQ(posed.size(), as_drawn.size()) << person.name;
                for (size_t v = 0; v < posed.size(); ++v)
                    worst = std::max(worst, length(posed[v] - as_drawn[v]));
            }
        }
    }
    EXPECT_LT(worst, 1e-3f);
    testing::Test::RecordProperty("worst_um", static_cast<int>(std::lround(wide(worst) * 1e6)));
    std::printf("farthest from where it was drawn: %.3f mm\n", wide(worst) * 1e3);
}

PeopleTaking take(Loaded& loaded, uint32_t ticks, uint32_t fps, const std::vector<WalkerRange>& wanted) {
    PeopleTaking taking;
    taking.group.fps = static_cast<float>(fps);
    taking.wanted = wanted;
    for (uint32_t tick = 0; tick <= ticks; ++tick) {
        if (tick > 0) step(*loaded.world);
        if (tick == 20) {
            EXPECT_TRUE(remove_walker(*loaded.world, loaded.world->crowd.slots.living[2]));
        }
        take_people(taking, *loaded.world, loaded.characters, tick);
    }
    return taking;
}

TEST(Export, MeshesAreWhereTheyWereDrawn) {
    Loaded loaded = loaded_scene("life", 40);
    const PeopleTaking taking = take(loaded, 90, 60, {{0, 11}});
    ASSERT_EQ(taking.group.people.size(), 12u);
    EXPECT_EQ(taking.group.frames, 91u);
    EXPECT_GE(taking.seen.size(), 40u);
    const std::string bytes = group_glb(taking.group);
    const ReadGroup read = read_group(bytes);
    ASSERT_EQ(read.clips.size(), 13u);
    EXPECT_EQ(read.clips[0].name, "everybody");
    EXPECT_EQ(read.clips[1].name, "walker 0");
    expect_as_drawn(taking.group, read);
}

TEST(Export, FramesMayLieBetweenTicks) {
    Loaded loaded = loaded_scene("quayside", 12);
    const PeopleTaking taking = take(loaded, 60, 25, {});
    EXPECT_EQ(taking.group.frames, 26u);
    expect_as_drawn(taking.group, read_group(group_glb(taking.group)));
}

TEST(Export, JointsAreThoseOfTheSimulation) {
    Loaded loaded = loaded_scene("corner", 6);
    const PeopleTaking taking = take(loaded, 30, 60, {});
    for (const WalkerId id : walkers(*loaded.world)) {
        std::array<JointPose, k_joint_count> joints;
        ASSERT_TRUE(pose_of(*loaded.world, id, joints));
        const GlbPerson& person = taking.group.people.at(taking.place_of.at(id.index));
        const JointPoses told = joints_of(person, person.frames.size() - 1);
        for (size_t j = 0; j < k_joint_count; ++j) {
            EXPECT_LT(length(told[j].position - joints[j].position), 1e-4f) << k_joint_names[j];
            EXPECT_LT(radians_apart(told[j].rotation, joints[j].rotation), 1e-3f) << k_joint_names[j];
        }
    }
}

TEST(Export, WhoIsNotThereHasNoSize) {
    Loaded loaded = loaded_scene("corner", 6);
    const PeopleTaking taking = take(loaded, 40, 60, {});
    const ReadGroup read = read_group(group_glb(taking.group));
    size_t left = 0;
    for (const GlbPerson& person : taking.group.people) {
        auto size_at = [&](float time) {
            const std::vector<Vec3> body = read.posed(person.name, read.clips[0], time);
            float high = 0;
            for (const Vec3 v : body) high = std::max(high, length(v - body[0]));
            return high;
        };
        EXPECT_GT(size_at(0.3f), 0.5f) << person.name;
        const bool is_there = person.frames.back() == 40;
        left += !is_there;
        EXPECT_EQ(size_at(0.5f) > 0.5f, is_there) << person.name;
        if (!is_there) {
            EXPECT_LT(size_at(0.5f), 1e-5f);
        }
    }
    EXPECT_EQ(left, 1u);
}

TEST(Export, KeysHoldAllValuesWithinTheirBound) {
    std::vector<float> times;
    std::vector<Quat> turns;
    std::vector<Vec3> places;
    for (int i = 0; i <= 200; ++i) {
        const float t = static_cast<float>(i) / 60;
        times.push_back(t);
        const float angle = t < 1 ? 0.4f : 0.4f + 0.7f * (t - 1) * (t - 1);
        turns.push_back(rotation_y(angle) * rotation_x(0.2f));
        places.push_back({t, t < 2 ? 0 : (t - 2) * (t - 2), 0});
    }
    const auto turn_keys = keys_of(times, turns, 0.002f);
    const auto place_keys = keys_of(times, places, 0.001f);
    EXPECT_LT(turn_keys.size(), 40u);
    EXPECT_LT(place_keys.size(), 30u);
    for (size_t i = 0; i < times.size(); ++i) {
        auto around = [&](const std::vector<uint32_t>& keys) {
            const auto next = std::ranges::lower_bound(keys, i);
            return std::pair{next == keys.begin() ? *next : *std::prev(next), *next};
        };
        auto share = [&](std::pair<uint32_t, uint32_t> at) {
            return at.first == at.second
                       ? 0
                       : (times[i] - times[at.first]) / (times[at.second] - times[at.first]);
        };
        const auto turn = around(turn_keys), place = around(place_keys);
        EXPECT_LT(radians_apart(slerp(turns[turn.first], turns[turn.second], share(turn)), turns[i]),
                  0.00201f);
        EXPECT_LT(length(lerp(places[place.first], places[place.second], share(place)) - places[i]),
                  0.00101f);
    }
    EXPECT_EQ(keys_of(times, std::vector<Vec3>(times.size()), 0.001f).size(), 1u);
}

// A recording of 3 s, and what of it lies in a file that a command made of it.
struct Recorded {
    TestFolder folder;
    Options options;
    Recorded() {
        options.scene = load_scene("corner").value();
        options.scene.walkers = 20;
        options.record = {folder / "a.flr", RecordedAs::motion, 0.001f};
        Result<Loaded> loaded = load(options);
        EXPECT_TRUE(loaded);
        Result<TakingPtr> taking = begin_taking(options, *loaded->world);
        EXPECT_TRUE(taking);
        for (int tick = 0; tick <= 180; ++tick) {
            if (tick == 0) continue;
            step(*loaded->world);
            EXPECT_TRUE(flaneur::take(**taking, *loaded->world));
        }
        EXPECT_TRUE(finish_taking(std::move(*taking)));
        options.replay = options.record.path;
        options.command = Command::exports;
    }
};

TEST(Export, PlacesAreReadAgainFromEveryFormat) {
    Recorded recorded;
    Options& options = recorded.options;
    options.exported.seconds = {1, 2.5};
    options.exported.fps = 20;
    options.exported.walkers = {{3, 3}, {7, 12}};
    // As it is shown.
    std::map<std::pair<uint32_t, uint32_t>, Vec3> places;
    Result<PlayingPtr> playing = open_playing(options.replay, 1);
    Result<Loaded> loaded = load(options);
    ASSERT_TRUE(playing && loaded);
    const World& world = *loaded->world;
    for (uint32_t frame = 0; frame <= 30; ++frame) {
        ASSERT_TRUE(show_tick(**playing, *loaded->world, 60 + 3 * frame));
        for (const WalkerId id : world.crowd.slots.living) {
            const uint32_t number = person_number(world.crowd, id);
            if (number == 3 || (number >= 7 && number <= 12))
                places[{frame, number}] = world.crowd.motion.position[id.index];
        }
    }
    ASSERT_FALSE(places.empty());
    for (const char* name : {"a.sqlite", "a.txt", "a.csv", "a.fcd.xml", "a.geojson", "a.traj"}) {
        options.out = recorded.folder / name;
        const Result<void> done = run_export(options);
        ASSERT_TRUE(done) << done.error().message;
        Result<Trajectories> read = read_trajectories(options.out);
        ASSERT_TRUE(read) << name << ": " << read.error().message;
        EXPECT_NEAR(read->fps, 20, 1e-3f) << name;
        EXPECT_EQ(read->sightings.size(), places.size()) << name;
        size_t found = 0;
        for (const Sighting& s : read->sightings) {
            const auto at = places.find({s.frame, s.id});
            if (at == places.end()) continue;
            ++found;
            EXPECT_NEAR(s.at.x, at->second.x, 1e-4f) << name;
            EXPECT_NEAR(s.at.z, at->second.z, 1e-4f) << name;
        }
        EXPECT_EQ(found, places.size()) << name;
    }
    // And from one file to another, at another rate.
    options.file = recorded.folder / "a.csv";
    options.replay.clear();
    options.exported = {{}, {{7, 7}}, {0.25, 1.25}, 10};
    options.out = recorded.folder / "b.sqlite";
    ASSERT_TRUE(run_export(options));
    Result<Trajectories> read = read_trajectories(options.out);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->fps, 10);
    EXPECT_EQ(read->area.size(), 1u) << "the box about everybody";
    ASSERT_EQ(read->sightings.size(), 11u);
    for (const Sighting& s : read->sightings) {
        EXPECT_EQ(s.id, 7u);
        EXPECT_NEAR(s.at.x, (places[{5 + 2 * s.frame, 7}].x), 2e-4f) << s.frame;
    }
}

TEST(Export, RefusesInSentencesAndLeavesNothing) {
    Recorded recorded;
    Options& options = recorded.options;
    auto refused = [&](const char* out) {
        options.out = recorded.folder / out;
        const Result<void> done = run_export(options);
        EXPECT_FALSE(done) << out;
        EXPECT_FALSE(std::filesystem::exists(options.out)) << out;
        return done ? std::string() : done.error().message;
    };
    EXPECT_NE(refused("a.fbx").find(".glb or .bvh"), std::string::npos);
    for (const char* out : {"a.glb", "a.bvh", "a.csv"}) {
        options.exported = {{}, {{900, 901}}, {0, 1e9}, 0};
        EXPECT_NE(refused(out).find("no walker 900 to 901"), std::string::npos) << out;
        options.exported = {{}, {}, {7, 8}, 0};
        EXPECT_NE(refused(out).find("goes from 0"), std::string::npos) << out;
    }
}

}  // namespace
}  // namespace flaneur
