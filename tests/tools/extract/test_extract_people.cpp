// The bridge as a program of somebody else's uses it: by the public headers alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "assets/population.h"
#include "sim/sim.h"
#include "tools/extract/extract.h"

namespace flaneur {
namespace {

// Some of two kinds who stroll about a square.
class ExtractTest : public testing::Test {
  protected:
    void SetUp() override {
        WorldOptions options{.capacity = 6, .threads = 1, .kinds = {}};
        for (const PersonOptions& person : draw_population(2, 3)) {
            const Character& made = characters.emplace_back(generate_person(person));
            options.kinds.push_back({made.body, 1, person.age, person.woman});
        }
        const Vec3 corners[] = {{-9, 0, -9}, {-9, 0, 9}, {9, 0, 9}, {9, 0, -9}};
        const uint32_t triangles[] = {0, 1, 2, 0, 2, 3};
        Result<WorldPtr> made = make_world({corners, triangles}, options);
        ASSERT_TRUE(made) << made.error().message;
        world = std::move(*made);
        for (uint32_t i = 0; i < options.capacity; ++i)
            ASSERT_TRUE(add_walker(*world, {.kind = i % 2, .scale = 0.9f, .wanders = true}));
        for (int tick = 0; tick < 100; ++tick) step(*world);
    }
    std::vector<uint32_t> tints(uint32_t walker) const {
        const WalkerInstance& instance = people.walkers[walker].instance;
        return {std::begin(instance.tints), std::end(instance.tints)};
    }
    std::vector<Character> characters;
    WorldPtr world;
    PeopleFrame people;
};

TEST_F(ExtractTest, EveryoneIsDrawnAsPosed) {
    extract_people(*world, characters, people, 0.5f);
    ASSERT_EQ(people.palette.size(), people.posed.size() * k_palette_joints);
    for (WalkerId id : walkers(*world)) {
        std::array<JointPose, k_joint_count> joints;
        ASSERT_TRUE(pose_of(*world, id, joints, 0.5f));
        const WalkerDraw& draw = people.walkers[id.index];
        ASSERT_EQ(draw.mesh, motion_of(*world, id)->kind);
        ASSERT_NE(draw.instance.palette, k_no_palette);
        for (size_t j = 0; j < k_joint_count; ++j) {
            const JointTransform& t = people.palette[draw.instance.palette + j];
            const Vec3 bound = characters[draw.mesh].bind_joints[j] * draw.instance.scale;
            const Vec3 drawn = rotate({t.rotation.x, t.rotation.y, t.rotation.z, t.rotation.w}, bound) +
                               Vec3{t.translation.x, t.translation.y, t.translation.z};
            EXPECT_LT(length(drawn - joints[j].position), 1e-4f) << k_joint_names[j];
        }
    }
}

// Uphill towards +z, with a tread 0.4 m lower from x = 0 on.
std::optional<GroundHit> slope_and_tread(Vec3 point) {
    if (point.x > 0) return GroundHit{-0.4f};
    const Vec3 normal{0, 1, -0.2f};
    return GroundHit{0.2f * point.z, normal / length(normal)};
}

TEST_F(ExtractTest, TheGroundBelowIsFoundHoweverHighOneLeaps) {
    const Surroundings around{.ground = [](const void*, std::span<const Vec3> points, float up, float down,
                                           std::optional<GroundHit>* hits) {
        for (size_t i = 0; i < points.size(); ++i) {
            hits[i] = slope_and_tread(points[i]);
            const float above = points[i].y - hits[i]->height;
            if (above < -up || above > down) hits[i].reset();
        }
    }};
    std::array<JointPose, k_joint_count> joints;
    for (float leap : {0.0f, 0.4f}) {
        for (size_t j = 0; j < k_joint_count; ++j) joints[j].position = {-0.05f, 0.6f + leap, 2};
        for (Joint j : {right_foot, right_toes}) joints[j].position.x = 0.1f;
        const GroundBelow ground_below = find_ground_below(around, joints.data());
        EXPECT_NEAR(ground_below.feet[0].place.y, 0.4f, 1e-5f) << leap;
        EXPECT_NEAR(ground_below.feet[0].normal.z / ground_below.feet[0].normal.y, -0.2f, 1e-5f);
        EXPECT_NEAR(ground_below.feet[1].place.y, -0.4f, 1e-5f) << leap;
        EXPECT_NEAR(ground_below.body.place.y, 0.4f, 1e-5f) << leap;
        EXPECT_EQ(ground_below.pram.normal, glm::vec3(0));
    }
    const PramPlace pram{.place = {1, 3, 5}, .yaw = 0, .pitch = 0.1f};
    const GroundPlane below = find_ground_below(around, joints.data(), &pram).pram;
    EXPECT_NEAR(below.place.z, 5.28f, 0.01f);
    EXPECT_GT(below.place.y, 3.02f);
    EXPECT_LT(below.normal.z, -0.09f);
    for (JointPose& joint : joints) joint.position.y = 9;
    EXPECT_EQ(find_ground_below(around, joints.data()).feet[0].normal, glm::vec3(0));
}

TEST_F(ExtractTest, OnlyThoseGetJointsWhomThePictureShows) {
    const Camera away{.eye = {0, 900, 0}, .target = {0, 901, 0.1f}};
    extract_people(*world, characters, people, 1, {.view = make_view(away, 100, 100)});
    EXPECT_TRUE(people.posed.empty() && people.palette.empty());
    for (const WalkerDraw& draw : people.walkers) EXPECT_EQ(draw.instance.palette, k_no_palette);
}

TEST_F(ExtractTest, ClothesAreKeptUntilSomebodyElseComes) {
    extract_people(*world, characters, people);
    const WalkerId leaver = walkers(*world)[2];
    const auto worn = tints(leaver.index), others = tints(3);
    EXPECT_NE(worn, others);
    people.walkers[leaver.index].instance.tints[1] = 0;  // painted over, for a frame
    step(*world);
    extract_people(*world, characters, people);
    EXPECT_EQ(tints(leaver.index), worn);

    const uint32_t kind = motion_of(*world, leaver)->kind;
    ASSERT_TRUE(remove_walker(*world, leaver));
    extract_people(*world, characters, people);
    EXPECT_GE(people.walkers[leaver.index].mesh, characters.size()) << "nobody is drawn";
    EXPECT_EQ(std::ranges::count(people.posed, leaver.index), 0);

    Result<WalkerId> comer = add_walker(*world, {.kind = kind});
    ASSERT_TRUE(comer);
    ASSERT_EQ(comer->index, leaver.index);
    extract_people(*world, characters, people);
    EXPECT_EQ(people.walkers[comer->index].mesh, kind);
    EXPECT_NE(tints(comer->index), worn);
    EXPECT_EQ(tints(3), others);
}

TEST_F(ExtractTest, MeshesHaveAWalkForTheirImpostors) {
    const PersonMesh mesh = extract_character(characters[0]);
    ASSERT_EQ(mesh.strides.size(), size_t{k_stride_poses} * k_palette_joints);
    auto ahead = [&](int pose, Joint joint) {
        const JointTransform& t = mesh.strides[static_cast<size_t>(pose * k_palette_joints + joint)];
        const Vec3 bound = characters[0].bind_joints[joint];
        return rotate({t.rotation.x, t.rotation.y, t.rotation.z, t.rotation.w}, bound).z + t.translation.z;
    };
    // The left foot comes down at phase 0, far ahead of the right one, which does so half a stride later.
    EXPECT_GT(ahead(0, left_foot) - ahead(0, right_foot), 0.3f);
    EXPECT_GT(ahead(k_stride_phases / 2, right_foot) - ahead(k_stride_phases / 2, left_foot), 0.3f);
    EXPECT_LT(std::abs(ahead(k_stride_phases, left_foot) - ahead(k_stride_phases, right_foot)), 0.1f);
}

}  // namespace
}  // namespace flaneur
