#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "renderer/view.h"
#include "sim/base/math.h"
#include "sim/sim.h"
#include "tests/tools/loaded.h"
#include "tools/flaneur/view/camera.h"
#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/cameras/cameras.h"
#include "tools/flaneur/window/command.h"
#include "tools/flaneur/window/viewer.h"

namespace flaneur {
namespace {

constexpr Size k_size{640, 360};
constexpr float k_picture = 1.0f / 30;

class WindowCameras : public testing::Test {
  protected:
    void SetUp() override {
        show.loaded = loaded_scene("corner", 60);
        for (int i = 0; i < 120; ++i) step(world());
        v.clock.is_paused = true;
        picture();
    }
    World& world() { return *show.loaded.world; }
    bool picture(float seconds = k_picture) { return move_camera(show, k_size, seconds, 1, v); }
    void pictures(int count) {
        for (int i = 0; i < count; ++i) picture();
    }
    void tick() {
        step(world());
        ride(world(), v.cameras, v.choice);
    }
    // What the copied command draws from, in a program of its own.
    Camera told() {
        const std::string all = command_of({}, {v.choice, v.camera, {}, k_size, world().tick});
        auto value = [&](const std::string& option) -> std::string {
            const size_t at = all.find(option + " ");
            if (at == std::string::npos) return "";
            const size_t from = at + option.size() + 1;
            return all.substr(from, all.find(' ', from) - from);
        };
        const CameraChoice choice = parse_camera(value("--camera")).value();
        const std::string fov = value("--fov");
        return choose_camera(show, choice, fov.empty() ? 0 : parse_fov(fov).value(), k_size, 1);
    }
    void expect_told(const char* mode) {
        const Camera camera = told();
        EXPECT_EQ(camera.eye, v.camera.eye) << mode;
        EXPECT_EQ(camera.target, v.camera.target) << mode;
        EXPECT_EQ(camera.vertical_fov, v.camera.vertical_fov) << mode;
        EXPECT_EQ(camera.clear_air, v.camera.clear_air) << mode;
    }
    Show show;
    Viewer v;
};

TEST_F(WindowCameras, CommandDrawsWhatIsSeenInEachMode) {
    using enum CameraChoice::Kind;
    for (const CameraChoice::Kind kind : {street, overview, crowd, follow, eyes, map}) {
        choose(v, kind);
        pictures(40);
        expect_told(told_camera({kind, 0, {}, {}}).c_str());
        for (int i = 0; i < 7; ++i) tick(), picture();
        expect_told("some ticks later");
    }
    v.choice.across *= 0.37f, v.choice.bearing = 12.3f, pictures(3);
    expect_told("on the map");
    choose(v, follow);
    pictures(5);
    v.wants_command = true;  // in the middle of the way there
    picture();
    expect_told("at the end of the way");
    EXPECT_FALSE(is_gliding(v.cameras.glide));
    v.wants_command = false;
    set_foot(show, v);
    EXPECT_EQ(mode_of(v), CameraMode::walk);
    for (int i = 0; i < 30; ++i) steer(show, {.ahead = 1, .turn = 0.02f}, k_picture, v), picture();
    expect_told("on foot");
    steer(show, {.up = 1}, k_picture, v);
    EXPECT_EQ(mode_of(v), CameraMode::fly);
    v.cameras.fov = fov_of(71);
    pictures(4);  // while the lens changes
    expect_told("flying");
    add_key(v);
    choose(v, street), pictures(30);
    add_key(v);
    show_path(v, 0.7, false);
    pictures(30);
    EXPECT_EQ(mode_of(v), CameraMode::path);
    expect_told("on a path");
}

TEST_F(WindowCameras, GlideFromOneToTheOtherAndCanBeInterrupted) {
    const glm::vec3 before = v.camera.eye;
    choose(v, CameraChoice::Kind::overview);
    glm::vec3 last = before;
    int moving = 0;
    while (picture() && moving < 100) {
        ++moving;
        EXPECT_LT(glm::length(v.camera.eye - last), 40);
        EXPECT_NEAR(glm::length(v.camera.target - v.camera.eye), 1, 1e-2f);
        last = v.camera.eye;
    }
    EXPECT_NEAR(static_cast<float>(moving) * k_picture, k_glide_seconds, 0.1f);
    EXPECT_GT(glm::length(v.camera.eye - before), 5);
    choose(v, CameraChoice::Kind::street);
    pictures(6);
    const glm::vec3 here = v.camera.eye;
    EXPECT_TRUE(steer(show, {.ahead = 1e-3f}, k_picture, v));
    picture();
    EXPECT_LT(glm::length(v.camera.eye - here), 0.01f);
    EXPECT_EQ(mode_of(v), CameraMode::fly);
    EXPECT_FALSE(picture()) << "it stays there";
}

TEST_F(WindowCameras, GlideGoesOverHousesRatherThanThroughThem) {
    const Ground& ground = *world().ground;
    int blocked = 0, free = 0;
    for (uint32_t i = 0; i + 1 < 60; ++i) {
        const Vec3 a = world().crowd.motion.position[i] + Vec3{0, 1.6f, 0};
        const Vec3 b = world().crowd.motion.position[i + 1] + Vec3{0, 1.6f, 0};
        if (sees(ground, a, b)) continue;
        ++blocked;
        Glide glide;
        begin(glide, world(), make_camera(a, a + Vec3{1, 0, 0}), make_camera(b, b + Vec3{1, 0, 0}));
        bool is_free = true;
        Vec3 last = a;
        for (int part = 1; part <= 20; ++part) {
            glide.passed = k_glide_seconds * static_cast<float>(part) / 20;
            const glm::vec3 eye = camera_of(glide).eye;
            is_free = is_free && sees(ground, last, {eye.x, eye.y, eye.z});
            last = {eye.x, eye.y, eye.z};
        }
        free += is_free;
    }
    EXPECT_GT(blocked, 10);
    EXPECT_GT(free, blocked * 3 / 4);
}

TEST_F(WindowCameras, EyesSeeNothingOfTheirOwnBody) {
    for (uint32_t walker = 0; walker < 60; walker += 3) {
        CameraRig rig;
        for (int i = 0; i < 90; ++i) {
            if (i % 3 == 0) step(world());
            advance(rig, world(), {CameraChoice::Kind::eyes, walker, {}, {}});
            const Camera camera = camera_of(rig, 0, 1);
            const JointPose hips_pose = joint_between(world(), walker, hips, 1);
            const Vec3 off{camera.eye.x - hips_pose.position.x, camera.eye.y - hips_pose.position.y,
                           camera.eye.z - hips_pose.position.z};
            // As renderer/visible/cull.cpp has it of a body of this size.
            const float radius = 0.55f * world().kinds[world().crowd.identity.body[walker]].body.height;
            EXPECT_LT(length(on_ground(off)), 0.4f * radius) << walker << " " << i;
            EXPECT_GT(off.y, 0.25f);
        }
    }
}

// How much a camera shakes: the mean of what its way changes from tick to tick, metres.
float shaking(const std::vector<glm::vec3>& eyes) {
    float sum = 0;
    for (size_t i = 2; i < eyes.size(); ++i) sum += glm::length(eyes[i] - 2.0f * eyes[i - 1] + eyes[i - 2]);
    return sum / static_cast<float>(eyes.size());
}

TEST_F(WindowCameras, EyesAndFollowersAreSmootherThanHeads) {
    for (const auto kind : {CameraChoice::Kind::eyes, CameraChoice::Kind::follow}) {
        const uint32_t walker = 5;
        CameraRig rig;
        std::vector<glm::vec3> heads, eyes;
        for (int i = 0; i < 300; ++i) {
            step(world());
            advance(rig, world(), {kind, walker, {}, {}});
            const Vec3 at = joint_between(world(), walker, head, 1).position;
            heads.emplace_back(at.x, at.y, at.z);
            eyes.push_back(camera_of(rig, 0, 1).eye);
            const glm::vec3 person(at.x, at.y, at.z);
            if (kind == CameraChoice::Kind::follow)
                EXPECT_LT(glm::length(eyes.back() - person), 6) << i;
            else
                EXPECT_LT(glm::length(eyes.back() - person), 0.35f) << i;
        }
        EXPECT_LT(shaking(eyes), 0.5f * shaking(heads));
    }
}

TEST_F(WindowCameras, FollowersAreDeterministicAndStayOutOfWalls) {
    std::vector<CameraRig> rigs(20);
    int hidden = 0, all = 0;
    for (int i = 0; i < 240; ++i) {
        step(world());
        for (uint32_t walker = 0; walker < rigs.size(); ++walker) {
            advance(rigs[walker], world(), {CameraChoice::Kind::follow, walker, {}, {}});
            CameraRig again = rigs[walker];
            const Camera a = camera_of(rigs[walker], 0, 1), b = camera_of(again, 0, 1);
            EXPECT_EQ(a.eye, b.eye);
            const Vec3 chest = world().crowd.motion.position[walker] + Vec3{0, 1.2f, 0};
            ++all;
            hidden += !sees(*world().ground, chest, {a.eye.x, a.eye.y, a.eye.z});
        }
    }
    EXPECT_LT(hidden, all / 50);
}

// One who stands on a meadow, and another right in the way of the eye behind.
TEST(CameraRig, LooksPastTheHeadsOfOthers) {
    const Vec3 corners[] = {{-30, 0, -30}, {-30, 0, 30}, {30, 0, 30}, {30, 0, -30}};
    const uint32_t triangles[] = {0, 1, 2, 0, 2, 3};
    auto nearest = [&] {
        WorldOptions options;
        options.capacity = 2;
        auto world = make_world({corners, triangles, {}}, options).value();
        WalkerOptions walker;
        walker.place = Vec3{0, 0, 0};
        EXPECT_TRUE(add_walker(*world, walker));
        CameraRig alone;
        advance(alone, *world, {CameraChoice::Kind::follow, 0, {}, {}});
        const glm::vec3 eye = camera_of(alone, 0, 1).eye;
        const Vec3 between{eye.x * 0.45f, 0, eye.z * 0.45f};
        walker.place = between;
        EXPECT_TRUE(add_walker(*world, walker));
        CameraRig rig;
        for (int i = 0; i < 60; ++i) advance(rig, *world, {CameraChoice::Kind::follow, 0, {}, {}});
        // How near the way from the eye to the chest comes to the other's head.
        const glm::vec3 now = camera_of(rig, 0, 1).eye, chest(0, 1.3f, 0), head(between.x, 1.6f, between.z);
        const glm::vec3 way = glm::normalize(chest - now);
        return glm::length(head - now - way * glm::dot(head - now, way));
    };
    EXPECT_GT(nearest(), 0.25f);
}

TEST_F(WindowCameras, FramesSomebodyToAThirdOfThePicture) {
    int seen = 0;
    for (uint32_t walker = 0; walker < 60; ++walker) {
        const Vec3 feet = world().crowd.motion.position[walker];
        const float height = 1.7f;
        const Camera camera = framing_camera(world(), feet, height, feet + Vec3{20, 5, 3}, k_fov);
        const View view = make_view(camera, 640, 360);
        auto row = [&](float up) {
            const glm::vec4 at = view.clip_from_world * glm::vec4(feet.x, feet.y + up, feet.z, 1);
            return 0.5f + 0.5f * at.y / at.w;
        };
        EXPECT_NEAR(row(0) - row(height), 1.0f / 3, 0.08f) << walker;
        EXPECT_NEAR((row(0) + row(height)) / 2, 0.5f, 0.05f) << walker;
        seen += sees(*world().ground, {camera.eye.x, camera.eye.y, camera.eye.z}, feet + Vec3{0, 1, 0});
    }
    EXPECT_GE(seen, 57);
}

TEST_F(WindowCameras, MapShowsAllAtFirstAndWhereOneWasInTurn) {
    auto press = [&] { look_at_map(show, v), pictures(40); };
    choose(v, CameraChoice::Kind::street);
    pictures(40);
    v.layout.wish.window = {k_size.width, k_size.height};
    const glm::vec3 target = v.camera.target;
    press();
    const CameraChoice all = map_of_all(world(), k_size);
    EXPECT_EQ(v.choice, all);
    EXPECT_NE(v.note.find("wheel"), std::string::npos) << v.note;
    press();
    EXPECT_LT(v.choice.across, 0.7f * all.across) << "where one was";
    EXPECT_LT(length(v.choice.middle - Vec2{target.x, target.z}), all.across / 2);
    v.choice.across *= 0.8f, v.choice.middle.x += 3;
    const CameraChoice zoomed = v.choice;
    press();
    EXPECT_EQ(v.choice, all);
    press();
    EXPECT_EQ(v.choice, zoomed) << "as one left it";
}

}  // namespace
}  // namespace flaneur
