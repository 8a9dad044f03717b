// What hangs on people, as it is drawn of walks that were walked.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "sim/base/math.h"
#include "tools/extract/extract.h"
#include "tools/extract/followers.h"
#include "tools/flaneur/sheets/take.h"

namespace flaneur {
namespace {

PersonOptions wearing(Bottom bottom, Over over, float build = 0) {
    PersonOptions who;
    who.woman = bottom >= Bottom::skirt;
    who.bottom = bottom;
    who.over = over;
    who.build = build;
    return who;
}

// Places of a person's vertices at a tick of a walk, metres along the pelvis.
std::vector<glm::vec3> drawn(const Character& c, const PersonMesh& mesh, const Walk& walk, size_t tick) {
    const auto& joints = walk.ticks[tick].joints;
    std::vector<JointTransform> palette(k_palette_joints);
    pose_character(c, 1, joints.data(), palette.data(), &walk.ticks[tick].trail);
    auto turn_of = [](glm::vec4 q) { return glm::quat(q.w, q.x, q.y, q.z); };
    const Quat q = joints[hips].rotation;
    const glm::quat back = glm::conjugate(glm::quat(q.w, q.x, q.y, q.z));
    const Vec3 p = joints[hips].position;
    std::vector<glm::vec3> places;
    for (const PersonVertex& v : mesh.vertices) {
        glm::vec3 place(0);
        for (int k = 0; k < 4; ++k) {
            const JointTransform& joint = palette[v.joints[k]];
            place += (turn_of(joint.rotation) * v.position + glm::vec3(joint.translation)) *
                     (static_cast<float>(v.weights[k]) / 255);
        }
        places.push_back(back * (place - glm::vec3(p.x, p.y, p.z)));
    }
    return places;
}

// How far a place is outside of a polygon that turns the way angles grow; seen from above.
float outside(const std::vector<glm::vec2>& polygon, glm::vec2 p) {
    bool inside = false;
    float nearest = 1e9f;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const glm::vec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()], along = b - a;
        const float t = glm::clamp(glm::dot(p - a, along) / glm::dot(along, along), 0.0f, 1.0f);
        nearest = std::min(nearest, glm::distance(p, a + along * t));
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
            inside = !inside;
    }
    return inside ? 0 : nearest;
}

// The hem of a robe: sectors about the upright, of each the outermost vertex.
std::vector<size_t> hem_of(const Character& c) {
    constexpr size_t k_sectors = 24;
    std::vector<size_t> hem(k_sectors, SIZE_MAX);
    std::vector<float> out(k_sectors, 0);
    for (uint32_t i : c.lods[0]) {
        const Vec3 p = c.vertices[i].position;
        const bool outer = c.person.over == Over::coat || c.person.bottom == Bottom::dress;
        if (c.vertices[i].tint != (outer ? Tint::top : Tint::bottom)) continue;
        if (std::abs(p.y - c.robe_hem) > 0.012f * c.body.height) continue;
        const float angle = std::atan2(p.z, p.x) / (2 * k_pi) + 1;
        const size_t sector = static_cast<size_t>(angle * k_sectors) % k_sectors;
        const float away = std::hypot(p.x, p.z);
        if (away > out[sector]) out[sector] = away, hem[sector] = i;
    }
    std::erase(hem, SIZE_MAX);
    return hem;
}

struct Way {
    const char* name;
    double speed;
    const char* stairs;
};
constexpr Way k_ways[] = {{"stroll", 0.9, ""}, {"walk", 1.4, ""}, {"longest stride", 2.2, ""},
                          {"run", 3.2, ""},    {"up", 1.2, "up"}, {"down", 1.2, "down"}};

// The mesh shows legs from the hem on: there they come out of the robe, and not through it.
TEST(Followers, LegsStayInSkirtsAndCoats) {
    for (const auto& [bottom, over] : {std::pair{Bottom::skirt, Over::none},
                                       {Bottom::long_skirt, Over::none},
                                       {Bottom::dress, Over::none},
                                       {Bottom::straight, Over::coat},
                                       {Bottom::wide, Over::coat},
                                       {Bottom::skirt, Over::coat}})
        for (float build : {0.0f, 0.9f}) {
            const Character c = generate_person(wearing(bottom, over, build));
            const PersonMesh mesh = extract_character(c);
            const std::vector<size_t> hem = hem_of(c);
            ASSERT_GE(hem.size(), 20u);
            std::vector<size_t> legs;
            for (uint32_t i : c.lods[0]) {
                const CharacterVertex& v = c.vertices[i];
                const bool is_leg =
                    v.tint == Tint::skin || (v.tint == Tint::bottom && bottom < Bottom::shorts);
                if (is_leg && std::abs(v.position.y - c.robe_hem) < 0.012f * c.body.height) legs.push_back(i);
            }
            ASSERT_GE(legs.size(), 20u);
            for (const Way& way : k_ways) {
                GaitOptions gait;
                gait.stairs = way.stairs;
                const Take take = make_moment(gait, {c.body, {}}, way.speed);
                float worst = 0;
                for (double tick = take.first; tick < take.last; tick += 2) {
                    const auto places = drawn(c, mesh, take.walk, static_cast<size_t>(tick));
                    std::vector<glm::vec2> polygon;
                    polygon.reserve(hem.size());
                    for (size_t i : hem) polygon.push_back({places[i].x, places[i].z});
                    for (size_t i : legs)
                        worst = std::max(worst, outside(polygon, {places[i].x, places[i].z}));
                }
                EXPECT_LT(worst, 0.003f) << "metres outside of the hem: " << int(bottom) << " under "
                                         << int(over) << ", build " << build << ", " << way.name;
            }
        }
}

float angle_between(Quat a, Quat b) { return 2 * arccos(std::min(std::abs(dot(a, b)), 1.0f)); }

TEST(Followers, SwingSmoothlyAndHangStillWithWhoStands) {
    constexpr const char* k_names[k_follower_count] = {"skirt ahead", "skirt behind", "bag",
                                                       "hair",        "scarf",        "stick"};
    for (auto [bag, hair] : {std::pair{Bag::handbag, Hair::ponytail},
                             {Bag::shoulder_bag, Hair::long_hair},
                             {Bag::backpack, Hair::shoulder_length}}) {
        PersonOptions who = wearing(Bottom::dress, Over::none);
        who.bag = bag, who.hair = hair, who.scarf = true;
        const Character c = generate_person(who);
        ASSERT_TRUE(has_followers(c));
        for (const Way& way : k_ways) {
            constexpr size_t k_stands = 60;  // ticks; then it walks
            GaitOptions gait;
            gait.stairs = way.stairs;
            gait.turn = gait.stairs.empty() ? 180 : 0;
            const Take take = make_take(gait, {c.body, {}}, way.speed, 18);
            const auto& all = take.walk.ticks;
            std::array<float, k_follower_count> most{}, standing{}, step{};
            std::array<Quat, k_follower_count> before;
            for (size_t t = 1; t < all.size(); ++t) {
                const JointPose* joints = all[t].joints.data();
                const auto now = followers(c, 1, joints, &all[t].trail),
                           still = followers(c, 1, joints, nullptr);
                for (size_t f = 0; f < now.size(); ++f) {
                    const float swing = angle_between(now[f].rotation, still[f].rotation);
                    float& in = t < k_stands ? standing[f] : most[f];
                    in = std::max(in, swing);
                    if (t > 1) step[f] = std::max(step[f], angle_between(now[f].rotation, before[f]));
                    before[f] = now[f].rotation;
                }
            }
            for (size_t f = 0; f < walking_stick - k_joint_count; ++f) {  // a stick never swings by itself
                EXPECT_LT(standing[f], 0.035f) << k_names[f] << " of who stands";
                EXPECT_GT(most[f], 0.004f) << k_names[f] << " does not swing, " << way.name;
                EXPECT_LT(step[f], 0.2f) << "radians in a tick: " << k_names[f] << ", " << way.name;
            }
        }
    }
}

}  // namespace
}  // namespace flaneur
