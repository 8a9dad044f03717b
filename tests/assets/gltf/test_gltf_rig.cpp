// Men of boxes on the skeletons that tools and engines make: the same man is found in each, or the limb that
// he lacks is named.
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include "assets/gltf/character/rig_names.h"
#include "tests/assets/gltf/rig_checks.h"

namespace flaneur {
namespace {

void split_limbs(Bones& bones) {
    mirror([&](const std::string& side, float) {
        for (const char* part : {"upper_arm", "lower_arm", "upper_leg", "lower_leg"})
            split_bone(bones, side + part);
    });
}

// All but the head's, whose flesh is no more than the neck's.
void forget_names(Bones& bones) {
    for (TinyBone& bone : bones)
        if (bone.name != "head") bone.name.clear();
}

void scatter(Bones& bones) {
    for (TinyBone& bone : bones) bone.parent = -1;
}

// `lacks` of its joints are made up.
void expect_the_man(const Bones& bones, const std::vector<Joint>& lacks = {}, float tolerance = 0.03f) {
    auto character = loaded(bones);
    ASSERT_TRUE(character) << character.error().message;
    for (size_t j = 0; j < k_joint_count; ++j) {
        bool made_up = std::find(lacks.begin(), lacks.end(), Joint(j)) != lacks.end();
        EXPECT_EQ(character->found.nodes[j].empty(), made_up) << k_joint_names[j];
        if (!made_up && !bones[0].name.empty()) {
            EXPECT_EQ(character->found.nodes[j], k_joint_names[j]);
        }
        if (j < left_shoulder || j > right_hand || j == left_upper_arm || j == left_hand) {
            EXPECT_LT(length(character->body.joints[j] - plain_man().body.joints[j]), tolerance)
                << k_joint_names[j];
        }
    }
    for (Joint joint : lacks) {
        std::string name(k_joint_names[joint]);
        std::replace(name.begin(), name.end(), '_', ' ');
        EXPECT_TRUE(noted(*character, name)) << name;
    }
}

TEST(GltfRig, HelpersAreNoLimbs) {
    Bones bones = tiny_bones(), root;
    add_helper(root, "root", "", {});
    // A chain of controls for each leg and arm, before the bones that carry flesh, with targets and poles.
    mirror([&](const std::string& side, float) {
        auto place = [&](const char* part) { return bones[size_t(find_bone(bones, side + part))].place; };
        add_helper(root, "MCH-" + side + "thigh", "root", place("upper_leg"));
        add_helper(root, "MCH-" + side + "shin", "MCH-" + side + "thigh", place("lower_leg"));
        add_helper(root, "MCH-" + side + "foot", "MCH-" + side + "shin", place("foot"));
        add_helper(root, side + "foot_ik", "root", place("foot"));
        add_helper(root, side + "toe_ik", side + "foot_ik", place("toes") + Vec3{0, 0, 0.2f});
        add_helper(root, side + "knee_pole", "root", place("lower_leg") + Vec3{0, 0, 0.6f});
        add_helper(root, "ORG-" + side + "upper_arm", "root", place("upper_arm"));
        add_helper(root, "ORG-" + side + "forearm", "ORG-" + side + "upper_arm", place("lower_arm"));
        add_helper(root, "ORG-" + side + "hand", "ORG-" + side + "forearm", place("hand"));
    });
    bones = bones_below(root, 0, bones);
    mirror([&](const std::string& side, float) {
        Vec3 knee = bones[size_t(find_bone(bones, side + "lower_leg"))].place;
        add_helper(bones, side + "pole_of_shin", side + "lower_leg", knee + Vec3{0, -2, 0.3f});
        add_helper(bones, side + "aim_of_arm", side + "lower_arm", knee + Vec3{3, 0, 0});
    });
    expect_the_man(bones);
}

// The legs end at the shins, which move the feet; what is called a foot is a target and moves nothing.
TEST(GltfRig, TargetsAreNoFeet) {
    Bones bones = tiny_bones(), root;
    add_helper(root, "root", "", {});
    mirror([&](const std::string& side, float) {
        Vec3 foot = bones[size_t(find_bone(bones, side + "foot"))].place;
        for (const char* part : {"toes", "foot"}) {
            Vec3 sole = bones[size_t(find_bone(bones, side + part))].place;
            drop_bone(bones, side + part);
            bones[size_t(find_bone(bones, side + "lower_leg"))].to = {sole.x, 0, sole.z};
        }
        add_helper(root, side + "foot_target", "root", foot + Vec3{0, 0, -0.1f});
    });
    expect_the_man(bones_below(root, 0, bones), {left_foot, left_toes, right_foot, right_toes}, 0.15f);
}

// A foot that carries flesh is one, wherever it hangs.
TEST(GltfRig, FeetMayHangFromTheRoot) {
    Bones bones = tiny_bones(), root;
    add_helper(root, "root", "", {});
    bones = bones_below(root, 0, bones);
    for (const char* foot : {"left_foot", "right_foot"}) bones[size_t(find_bone(bones, foot))].parent = 0;
    expect_the_man(bones);
}

TEST(GltfRig, LimbsMayBeSplit) {
    Bones bones = tiny_bones();
    split_limbs(bones);
    expect_the_man(bones);
    forget_names(bones);
    auto nameless = loaded(bones);
    ASSERT_TRUE(nameless) << nameless.error().message;
    for (size_t j = 0; j < k_joint_count; ++j)
        EXPECT_LT(length(nameless->body.joints[j] - plain_man().body.joints[j]), 0.03f) << k_joint_names[j];
}

TEST(GltfRig, TwistBonesLieInsideALimb) {
    Bones bones = tiny_bones();
    mirror([&](const std::string& side, float) {
        for (const char* part : {"upper_arm", "lower_arm", "upper_leg", "lower_leg"}) {
            TinyBone bone = bones[size_t(find_bone(bones, side + part))];
            for (float share : {0.3f, 0.6f})
                add_bone(bones, side + part + "_twist" + std::to_string(share), side + part,
                         lerp(bone.place, bone.to, share), bone.to);
        }
    });
    expect_the_man(bones);
}

// As an export of deforming bones only leaves them: whole limbs, halves or single bones without a parent.
TEST(GltfRig, PiecesAreJoined) {
    Bones bones = tiny_bones();
    split_limbs(bones);
    Bones limbs = bones;
    for (TinyBone& bone : limbs)
        for (const char* start : {"upper_leg", "upper_arm", "shoulder"})
            if (bone.name.ends_with(start)) bone.parent = -1;
    expect_the_man(limbs);
    scatter(bones);
    expect_the_man(bones);
    auto character = loaded(bones);
    ASSERT_TRUE(character);
    EXPECT_TRUE(noted(*character, "in pieces"));
    EXPECT_EQ(character->notes.size(), 1u);
    EXPECT_EQ(character->found.nodes, loaded(limbs)->found.nodes);
    auto whole = boxes_of(*loaded(limbs)), scattered = boxes_of(*character);
    EXPECT_EQ(whole, scattered);
}

// Rigify's whole rig: deforming limbs hang from chains that carry no flesh, and its spine from the root.
TEST(GltfRig, RigifyIsRead) {
    Bones bones = tiny_bones(), controls;
    split_limbs(bones);
    auto place = [&](const char* name) { return bones[size_t(find_bone(bones, name))].place; };
    add_helper(controls, "root", "", {});
    add_helper(controls, "MCH-torso.parent", "root", {0, 1, 0});
    add_helper(controls, "torso", "MCH-torso.parent", {0, 1, 0});
    add_helper(controls, "ORG-spine", "torso", place("hips"));
    add_helper(controls, "chest_control", "torso", place("chest"));
    add_helper(controls, "ORG-spine.003", "chest_control", place("upper_chest"));
    mirror([&](const std::string& side, float) {
        add_helper(controls, "ORG-" + side, "ORG-spine.003", place((side + "shoulder").c_str()));
        add_helper(controls, "ORG-leg-" + side, "ORG-spine", place((side + "upper_leg").c_str()));
        add_helper(controls, "ORG-shin-" + side, "ORG-leg-" + side, place((side + "lower_leg").c_str()));
    });
    Bones all = bones_below(controls, 0, bones);
    mirror([&](const std::string& side, float) {
        for (const char* part : {"shoulder", "upper_arm"})
            all[size_t(find_bone(all, side + part))].parent = find_bone(all, "ORG-" + side);
        all[size_t(find_bone(all, side + "upper_leg"))].parent = find_bone(all, "ORG-spine");
    });
    // Bones of the face, each on a control of its own.
    Vec3 crown = place("head");
    for (float x : {-0.05f, 0.0f, 0.05f}) {
        std::string name = "face" + std::to_string(x);
        add_helper(all, "MCH-" + name, "root", crown + Vec3{x, 0.05f, 0.1f});
        add_bone(all, name, "MCH-" + name, crown + Vec3{x, 0.05f, 0.08f}, crown + Vec3{x, 0.08f, 0.1f});
    }
    for (TinyBone& bone : all)
        if (bone.carries_flesh) bone.name = "DEF-" + bone.name;
    auto character = loaded(all);
    ASSERT_TRUE(character) << character.error().message;
    for (size_t j = 0; j < k_joint_count; ++j) {
        EXPECT_EQ(character->found.nodes[j], "DEF-" + std::string(k_joint_names[j]));
        EXPECT_LT(length(character->body.joints[j] - plain_man().body.joints[j]), 0.05f) << k_joint_names[j];
    }
    EXPECT_EQ(boxes_of(*character)[head], 4u) << "the face goes along with the head";
}

TEST(GltfRig, AWristMayBeMissing) {
    for (std::string side : {"left_", "right_"}) {
        Joint hand = side == "left_" ? left_hand : right_hand;
        Bones bones = tiny_bones();
        drop_bone(bones, side + "hand", true);
        expect_the_man(bones, {hand});
        // The other hand has fingers; those of this one hang from the forearm.
        Bones fingers = tiny_bones();
        mirror([&](const std::string& of, float way) {
            Vec3 wrist = fingers[size_t(find_bone(fingers, of + "hand"))].place;
            for (float z : {-0.04f, 0.0f, 0.04f}) {
                Vec3 knuckle = wrist + Vec3{0.1f * way, 0, z};
                add_bone(fingers, of + "finger" + std::to_string(z), of + "hand", knuckle,
                         knuckle + Vec3{0.06f * way, 0, 0});
            }
        });
        drop_bone(fingers, side + "hand", true);
        expect_the_man(fingers, {hand});
    }
}

TEST(GltfRig, ToesMayBeMissing) {
    Bones bones = tiny_bones();
    drop_bone(bones, "right_toes", true);
    expect_the_man(bones, {right_toes}, 0.06f);
    drop_bone(bones, "left_toes", true);
    expect_the_man(bones, {left_toes, right_toes}, 0.06f);
}

// What people do not have goes along with what carries it.
TEST(GltfRig, MoreLimbsAreCarriedAlong) {
    const std::pair<const char*, std::function<void(Bones&)>> k_more[] = {
        {"a tail",
         [](Bones& b) {
             Vec3 at = b[hips].place;
             add_bone(b, "t1", "hips", at + Vec3{0, 0, -0.1f}, at + Vec3{0, -0.3f, -0.25f});
             add_bone(b, "t2", "t1", at + Vec3{0, -0.3f, -0.25f}, at + Vec3{0, -0.6f, -0.3f});
             add_bone(b, "t3", "t2", at + Vec3{0, -0.6f, -0.3f}, at + Vec3{0, -0.85f, -0.4f});
         }},
        {"wings",
         [](Bones& b) {
             mirror([&](const std::string& side, float way) {
                 Vec3 at = b[upper_chest].place + Vec3{0.08f * way, 0, -0.1f};
                 Vec3 bend = at + Vec3{0.6f * way, 0.4f, -0.1f}, tip = at + Vec3{1.3f * way, 0.1f, -0.2f};
                 add_bone(b, side + "w1", "upper_chest", at, bend);
                 add_bone(b, side + "w2", side + "w1", bend, tip);
                 add_bone(b, side + "w3", side + "w2", tip, tip + Vec3{0.3f * way, -0.2f, 0});
             });
         }},
        {"two more arms",
         [](Bones& b) {
             mirror([&](const std::string& side, float way) {
                 Vec3 at = b[spine].place + Vec3{0.15f * way, 0.05f, 0};
                 add_bone(b, side + "m1", "spine", at, at + Vec3{0.22f * way, 0, 0});
                 add_bone(b, side + "m2", side + "m1", at + Vec3{0.22f * way, 0, 0},
                          at + Vec3{0.42f * way, 0, 0});
                 add_bone(b, side + "m3", side + "m2", at + Vec3{0.42f * way, 0, 0},
                          at + Vec3{0.5f * way, 0, 0});
             });
         }},
        {"plaits",
         [](Bones& b) {
             mirror([&](const std::string& side, float way) {
                 Vec3 at = b[head].place + Vec3{0.06f * way, 0.1f, 0};
                 for (int n = 0; n < 4; ++n) {
                     Vec3 from = at + Vec3{0.1f * way, -0.2f * float(n), -0.02f};
                     std::string above = n == 0 ? "head" : side + "p" + std::to_string(n - 1);
                     add_bone(b, side + "p" + std::to_string(n), above, from, from + Vec3{0, -0.2f, 0});
                 }
             });
         }},
    };
    for (const auto& [what, grow] : k_more)
        for (bool named : {true, false}) {
            SCOPED_TRACE(std::string(what) + (named ? "" : ", without names"));
            Bones bones = tiny_bones();
            grow(bones);
            if (!named) forget_names(bones);
            auto character = loaded(bones);
            ASSERT_TRUE(character) << character.error().message;
            for (size_t j = 0; j < k_joint_count; ++j)
                EXPECT_EQ(character->found.nodes[j],
                          named || j == head ? std::string(k_joint_names[j]) : "node " + std::to_string(j));
            EXPECT_FALSE(noted(*character, "in pieces"));
        }
    // A tail moves as the hips do.
    Bones tail = tiny_bones();
    k_more[0].second(tail);
    EXPECT_EQ(boxes_of(*loaded(tail))[hips], boxes_of(plain_man())[hips] + 3);
}

// One leg lacks its toes, and a tail is as long as the other.
TEST(GltfRig, ATailIsNoLeg) {
    Bones bones = tiny_bones();
    drop_bone(bones, "left_toes", true);
    size_t leg = size_t(find_bone(bones, "right_upper_leg"));
    for (size_t n = 0; n < 4; ++n) {
        TinyBone part = bones[leg + n];
        Vec3 aside{-part.place.x, 0, -0.12f};
        part.place += aside, part.to += {-part.to.x, 0, -0.12f};
        if (n > 0) part.parent = int(bones.size()) - 1;
        bones.push_back(part);
    }
    forget_names(bones);
    auto character = loaded(bones);
    ASSERT_TRUE(character) << character.error().message;
    EXPECT_EQ(character->found.nodes[left_lower_leg], "node " + std::to_string(left_lower_leg));
    EXPECT_EQ(character->found.nodes[right_foot], "node " + std::to_string(leg + 2));
    EXPECT_EQ(boxes_of(*character)[hips], boxes_of(plain_man())[hips] + 4);
}

// An axe with a bone of its own, in one hand.
TEST(GltfRig, WhatOneHandHoldsIsNoArm) {
    Bones bones = tiny_bones();
    Vec3 hand = bones[size_t(find_bone(bones, "right_hand"))].place, axe = hand + Vec3{-0.15f, 0, 0.4f};
    add_bone(bones, "axe", "right_hand", axe, axe + Vec3{0, 0, 0.4f});
    expect_the_man(bones);
}

// Of four arms alike that spring from one joint, two that mirror each other are a pair, hand or none.
TEST(GltfRig, LeftAndRightLieAcross) {
    Bones bones = tiny_bones();
    mirror([&](const std::string& side, float) {
        size_t first = size_t(find_bone(bones, side + "shoulder"));
        for (size_t n = 0; n < 4; ++n) {
            TinyBone part = bones[first + n];
            part.place.y -= 0.2f, part.to.y -= 0.2f;
            if (n > 0) part.parent = int(bones.size()) - 1;
            bones.push_back(part);
        }
    });
    drop_bone(bones, "right_hand", true);
    forget_names(bones);
    auto character = loaded(bones);
    ASSERT_TRUE(character) << character.error().message;
    auto node = [&](Joint j) { return character->bind_joints[j]; };
    EXPECT_NEAR(node(left_upper_arm).y, node(right_upper_arm).y, 1e-3f);
}

// Straps and streamers reach farther than feet and hands; one that rises from a shin is no foot even where
// there is none.
TEST(GltfRig, AStrapIsNoFoot) {
    Bones bones = tiny_bones();
    mirror([&](const std::string& side, float way) {
        for (auto [part, to] : {std::pair{"lower_leg", Vec3{0.3f * way, 0.02f, 0}},
                                {"lower_arm", Vec3{0.1f * way, -0.4f, 0}}}) {
            Vec3 at = bones[size_t(find_bone(bones, side + part))].place;
            std::string name = side + part + "_strap";
            add_bone(bones, name, side + part, at, at + to);
            add_bone(bones, name + "_end", name, at + to, at + to * 2.0f);
        }
    });
    expect_the_man(bones);
    mirror([&](const std::string& side, float) {
        for (const char* part : {"toes", "foot"}) drop_bone(bones, side + part);
    });
    auto character = loaded(bones);
    ASSERT_FALSE(character);
    EXPECT_NE(character.error().message.find("no hip, knee and ankle"), std::string::npos)
        << character.error().message;
}

// One hand has fingers, the other is a mitten.
TEST(GltfRig, HandsMayDiffer) {
    Bones bones = tiny_bones();
    constexpr int k_fingers = 5, k_parts = 3;
    auto add_fingers = [&](const std::string& side, float way) {
        Vec3 wrist = bones[size_t(find_bone(bones, side + "hand"))].place;
        for (int f = 0; f < k_fingers; ++f)
            for (int part = 0; part < k_parts; ++part) {
                std::string name = side + "finger" + std::to_string(f);
                Vec3 from = wrist + Vec3{(0.08f + 0.02f * float(part)) * way, 0, 0.02f * float(f - 2)};
                add_bone(bones, name + std::to_string(part),
                         part == 0 ? side + "hand" : name + std::to_string(part - 1), from,
                         from + Vec3{0.02f * way, 0, 0});
            }
    };
    add_fingers("left_", 1);
    size_t joints = bones.size();
    add_fingers("right_", -1);
    TinyMan man = tiny_rig(bones);
    size_t count = man.gltf["accessors"][tiny_joints]["count"];
    uint8_t* joint = data_of<uint8_t>(man, tiny_joints);
    for (size_t v = 0; v < count; ++v)
        if (joint[4 * v] >= joints) joint[4 * v] = right_hand;
    Json& of_skin = man.gltf["skins"][0]["joints"];
    of_skin.erase(of_skin.begin() + std::ptrdiff_t(joints), of_skin.end());
    auto model = parse_gltf(as_glb(man), "/nowhere", "man.glb");
    ASSERT_TRUE(model);
    auto character = make_character(*model, "man.glb");
    ASSERT_TRUE(character) << character.error().message;
    for (size_t j = 0; j < k_joint_count; ++j) EXPECT_EQ(character->found.nodes[j], k_joint_names[j]);
}

TEST(GltfRig, NamesTellKindAndSide) {
    const std::tuple<const char*, BoneKind, int> k_names[] = {
        {"mixamorig:LeftUpLeg", BoneKind::upper_leg, 1},
        {"Bip01 R Thigh", BoneKind::upper_leg, -1},
        {"J_Bip_L_UpperArm", BoneKind::upper_arm, 1},
        {"upperarm_r", BoneKind::upper_arm, -1},
        {"DEF-upper_arm.L.001", BoneKind::upper_arm, 1},
        {"lShldrBend", BoneKind::upper_arm, 1},
        {"rForearmBend", BoneKind::lower_arm, -1},
        {"LThigh", BoneKind::upper_leg, 1},
        {"FootR", BoneKind::foot, -1},
        {"rShin", BoneKind::lower_leg, -1},
        {"Character1_RightHand", BoneKind::hand, -1},
        {"calf_l", BoneKind::lower_leg, 1},
        {"wing_arm.R", BoneKind::none, -1},
        {"tail_03", BoneKind::none, 0},
        {"DEF-shin.R", BoneKind::lower_leg, -1},
        {"thigh_twist_01_l", BoneKind::none, 1},
        {"Spine2", BoneKind::none, 0},
        {"RootNode", BoneKind::none, 0},
        {"hand_l_end", BoneKind::hand, 1},
    };
    for (auto [name, kind, side] : k_names) {
        EXPECT_EQ(bone_kind(name), kind) << name;
        EXPECT_EQ(bone_side(name), side) << name;
    }
}

}  // namespace
}  // namespace flaneur
