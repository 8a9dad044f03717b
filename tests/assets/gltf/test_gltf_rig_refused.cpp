// Bodies of boxes that nobody walks as: each is refused by the limb that it lacks.
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include "tests/assets/gltf/rig_checks.h"

namespace flaneur {
namespace {

// The man without what begins at these bones.
Bones without(const std::vector<std::string>& starts) {
    Bones bones = tiny_bones();
    for (const std::string& start : starts)
        for (bool again = true; again;) {
            again = false;
            int first = -1;
            for (size_t j = bones.size(); j-- > 0 && first < 0;)
                for (int up = int(j); up >= 0 && first < 0; up = bones[size_t(up)].parent)
                    if (bones[size_t(up)].name == start) first = int(j);
            if (first >= 0) drop_bone(bones, bones[size_t(first)].name), again = true;
        }
    return bones;
}

// A body on one leg, with a tail as long: names tell that they are no pair.
TEST(GltfRig, NamesTellATailFromALeg) {
    Bones bones = tiny_bones();
    for (TinyBone& bone : bones)
        for (const char* part : {"upper_leg", "lower_leg", "foot", "toes"})
            if (bone.name == std::string("left_") + part) bone.name = std::string("tail_") + part;
    auto character = loaded(bones);
    ASSERT_FALSE(character);
    EXPECT_NE(character.error().message.find("leg was not found"), std::string::npos)
        << character.error().message;
}

// Of insects: what stands to one side is no head, and what is called a leg is no arm.
TEST(GltfRig, MoreLegsMakeNoBody) {
    Bones bones = without({"neck"});
    mirror([&](const std::string& side, float way) {
        Vec3 at = bones[upper_chest].place + Vec3{0.05f * way, 0.2f, 0};
        add_bone(bones, side + "feeler", "upper_chest", at, at + Vec3{0.05f * way, 0.3f, 0});
    });
    auto headless = loaded(bones);
    ASSERT_FALSE(headless);
    EXPECT_NE(headless.error().message.find("no head"), std::string::npos) << headless.error().message;

    bones = tiny_bones();
    mirror([&](const std::string& side, float) {
        for (auto [part, leg] : {std::pair{"shoulder", "front_hip"},
                                 {"upper_arm", "front_thigh"},
                                 {"lower_arm", "front_shin"},
                                 {"hand", "front_foot"}})
            bones[size_t(find_bone(bones, side + part))].name = side + leg;
    });
    auto on_four = loaded(bones);
    ASSERT_FALSE(on_four);
    EXPECT_NE(on_four.error().message.find("right arm"), std::string::npos) << on_four.error().message;
}

TEST(GltfRig, WhatIsMissingIsNamed) {
    const std::pair<Bones, const char*> k_lacking[] = {
        {without({"left_shoulder", "right_shoulder"}),
         "neither its left nor its right arm was found; a character needs both arms, both legs and a head, "
         "unless --force"},
        {without({"left_upper_leg", "right_upper_leg"}), "neither its left nor its right leg was found"},
        {without({"right_shoulder"}), "its right arm was not found"},
        {without({"left_shoulder"}), "its left arm was not found"},
        {without({"right_upper_leg"}), "its right leg was not found"},
        {without({"left_upper_leg"}), "its left leg was not found"},
        {without({"neck"}), "no head"},
    };
    for (const auto& [bones, says] : k_lacking) {
        auto character = loaded(bones);
        if (character) {
            ADD_FAILURE() << "was loaded; " << says;
            continue;
        }
        EXPECT_NE(character.error().message.find(says), std::string::npos) << character.error().message;
    }
    // Long fingers of the other hand are no arms.
    Bones fingers = without({"right_shoulder"});
    for (float z : {-0.06f, 0.06f}) {
        Vec3 from = fingers[size_t(find_bone(fingers, "left_hand"))].place + Vec3{0.08f, 0, z},
             bend{0.09f, 0, 0};
        std::string name = "finger" + std::to_string(z);
        add_bone(fingers, name, "left_hand", from, from + bend);
        add_bone(fingers, name + "tip", name, from + bend, from + bend * 2.0f);
    }
    auto one_armed = loaded(fingers);
    ASSERT_FALSE(one_armed);
    EXPECT_NE(one_armed.error().message.find("its right arm was not found"), std::string::npos)
        << one_armed.error().message;

    // An elbow is no use without a wrist, and there is none on the other side to go by.
    Bones stumps = tiny_bones();
    for (const char* joint : {"left_hand", "left_lower_arm", "right_hand", "right_lower_arm"})
        drop_bone(stumps, joint, true);
    auto character = loaded(stumps);
    ASSERT_FALSE(character);
    for (const char* says : {"shoulder, elbow and wrist", "left arm", "right arm"})
        EXPECT_NE(character.error().message.find(says), std::string::npos) << character.error().message;
}

// Limbs of one bone are there, but bend nowhere.
TEST(GltfRig, LimbsOfOneBoneAreSaidToBe) {
    for (bool from_the_middle : {false, true}) {
        Bones bones = tiny_bones();
        mirror([&](const std::string& side, float) {
            for (const char* part : {"toes", "foot", "lower_leg"}) drop_bone(bones, side + part, true);
            TinyBone& leg = bones[size_t(find_bone(bones, side + "upper_leg"))];
            Vec3 thigh = leg.place, sole = leg.to;
            std::string bone = side + "upper_leg";
            if (from_the_middle) {  // below a joint that carries no flesh
                leg.place = bones[hips].place, leg.carries_flesh = false;
                bone = side + "bone";
                add_bone(bones, bone, side + "upper_leg", thigh, sole);
            }
            add_helper(bones, side + "end", bone, sole);
        });
        auto character = loaded(bones);
        ASSERT_FALSE(character);
        const std::string& says = character.error().message;
        for (const char* leg : {"left leg, of one bone, below joint 'left_upper_leg'",
                                "right leg, of one bone, below joint 'right_upper_leg'"})
            EXPECT_NE(says.find(leg), std::string::npos) << says;
    }
}

// Legs are legs; what is above them is one piece, as heavy as it may be.
TEST(GltfRig, WhatHasTwoLegsMayBeForced) {
    for (const Bones& bones : {without({"left_shoulder", "right_shoulder"}), without({"neck"}),
                               without({"left_shoulder", "right_shoulder", "neck"})}) {
        EXPECT_FALSE(loaded(bones));
        auto walker = loaded(bones, {.force = true});
        ASSERT_TRUE(walker) << walker.error().message;
        EXPECT_TRUE(noted(*walker, "forced"));
        const auto& joints = walker->body.joints;
        for (size_t j = left_upper_leg; j < k_joint_count; ++j) {
            EXPECT_EQ(walker->found.nodes[j], k_joint_names[j]);
            EXPECT_LT(length(joints[j] - plain_man().body.joints[j]), 0.03f) << k_joint_names[j];
        }
        EXPECT_EQ(walker->found.nodes[hips], "hips");
        EXPECT_EQ(boxes_of(*walker)[hips], bones.size() - 8);
        EXPECT_GT(joints[head].y, joints[left_upper_arm].y);
        EXPECT_GT(joints[left_upper_arm].y, joints[left_hand].y);
        EXPECT_LT(joints[head].y, walker->body.height);
    }
    auto man = loaded(tiny_bones(), {.force = true});
    ASSERT_TRUE(man);
    EXPECT_EQ(man->found.nodes, plain_man().found.nodes) << "who needs no force is as without";
    auto none = loaded(without({"left_upper_leg", "right_upper_leg"}), {.force = true});
    ASSERT_FALSE(none);
    EXPECT_NE(none.error().message.find("no two legs"), std::string::npos) << none.error().message;
}

}  // namespace
}  // namespace flaneur
