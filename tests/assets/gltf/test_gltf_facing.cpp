// Men of boxes whose feet, names and thumbs do not agree on which way they face, and what they hold.
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include "tests/assets/gltf/rig_checks.h"

namespace flaneur {
namespace {

Vec3 place_of(const Bones& bones, const std::string& name) {
    return bones[size_t(find_bone(bones, name))].place;
}

// Shins that end in stumps: no feet to tell a way.
void drop_feet(Bones& bones) {
    mirror([&](const std::string& side, float) {
        Vec3 ankle = place_of(bones, side + "foot");
        for (const char* part : {"toes", "foot"}) drop_bone(bones, side + part);
        bones[size_t(find_bone(bones, side + "lower_leg"))].to = {ankle.x, 0, ankle.z};
    });
}

void add_thumbs(Bones& bones) {
    mirror([&](const std::string& side, float way) {
        Vec3 knuckle = place_of(bones, side + "hand") + Vec3{0.03f * way, 0, 0.02f};
        add_bone(bones, side + "thumb", side + "hand", knuckle, knuckle + Vec3{0.04f * way, 0, 0.06f});
    });
}

// Heels as long as these spurs of flesh behind the ankles outweigh the toes.
void add_spurs(Bones& bones) {
    mirror([&](const std::string& side, float) {
        Vec3 heel = place_of(bones, side + "foot");
        heel.y = 0.02f;
        drop_bone(bones, side + "toes", true);
        add_bone(bones, side + "spur", side + "foot", heel, heel + Vec3{0, 0, -0.6f});
    });
}

void forget_names(Bones& bones) {
    for (TinyBone& bone : bones)
        if (bone.name != "head") bone.name.clear();
}

void swap_names(Bones& bones) {
    for (TinyBone& bone : bones)
        for (auto [from, to] : {std::pair{"left_", "right_"}, {"right_", "left_"}})
            if (bone.name.starts_with(from)) {
                bone.name = to + bone.name.substr(std::string(from).size());
                break;
            }
}

// Faces +z or -z, with the legs that lie on its left taken for those.
void expect_facing(const Bones& bones, float z) {
    auto character = loaded(bones);
    ASSERT_TRUE(character) << character.error().message;
    EXPECT_NEAR(character->found.ahead.z, z, 1e-3f);
    for (Joint joint : {left_lower_leg, left_foot, left_lower_arm})
        EXPECT_GT(character->bind_joints[joint].x, 0);
}

TEST(GltfFacing, FeetTell) {
    expect_facing(tiny_bones(), 1);
    Bones bones = tiny_bones();
    swap_names(bones);
    expect_facing(bones, 1);
    forget_names(bones);
    expect_facing(bones, 1);
}

TEST(GltfFacing, HeelSpursDoNotTurnItRound) {
    Bones bones = tiny_bones();
    add_spurs(bones);
    forget_names(bones);
    expect_facing(bones, -1);  // nobody knows better
    bones = tiny_bones();
    add_spurs(bones);
    add_thumbs(bones);
    expect_facing(bones, 1);
}

TEST(GltfFacing, ThumbsKnowLeftFromRight) {
    Bones bones = tiny_bones();
    drop_feet(bones);
    add_thumbs(bones);
    expect_facing(bones, 1);
    swap_names(bones);
    expect_facing(bones, 1);
}

// By what is there besides: knees, or else the way that glTF files face.
TEST(GltfFacing, WithoutFeetOrNames) {
    Bones bones = tiny_bones();
    drop_feet(bones);
    forget_names(bones);
    expect_facing(bones, 1);
    auto plain = loaded(bones);
    ASSERT_TRUE(plain);
    EXPECT_TRUE(noted(*plain, "feet point nowhere"));
    for (size_t knee : {size_t(left_lower_leg), size_t(right_lower_leg) - 2}) {
        bones[knee].place.z -= 0.08f;
        bones[knee - 1].to.z -= 0.08f;
    }
    expect_facing(bones, -1);
}

// Both thighs begin in one point, but for a hair that lies along the way ahead.
TEST(GltfFacing, LegsMaySpringFromOnePlace) {
    Bones bones = tiny_bones();
    drop_feet(bones);
    mirror([&](const std::string& side, float way) {
        Vec3& thigh = bones[size_t(find_bone(bones, side + "upper_leg"))].place;
        thigh = {0, thigh.y, thigh.z + 1e-5f * way};
    });
    expect_facing(bones, 1);
    auto character = loaded(bones);
    ASSERT_TRUE(character);
    EXPECT_EQ(character->found.nodes[left_upper_leg], "left_upper_leg");
}

// Feet that reach twice as far ahead as legs do down are feet.
TEST(GltfFacing, FeetMayBeLong) {
    Bones bones = tiny_bones();
    mirror([&](const std::string& side, float) {
        TinyBone& toes = bones[size_t(find_bone(bones, side + "toes"))];
        bones[size_t(find_bone(bones, side + "foot"))].to.z = toes.place.z = 1.7f;
        toes.to.z = 1.8f;
    });
    auto character = loaded(bones);
    ASSERT_TRUE(character) << character.error().message;
    EXPECT_GT(character->found.ahead.z, 0);
}

// A foot of two bones, one of which is nobody's child: it goes along with the other, not with the shin.
TEST(GltfProps, AFootMayBeTwoBones) {
    Bones bones = tiny_bones();
    mirror([&](const std::string& side, float) {
        Vec3 ankle = place_of(bones, side + "foot");
        add_bone(bones, side + "sole", "", ankle, {ankle.x, 0, ankle.z + 0.15f});
    });
    auto character = loaded(bones);
    ASSERT_TRUE(character) << character.error().message;
    auto boxes = boxes_of(*character), plain = boxes_of(plain_man());
    for (Joint foot : {left_foot, right_foot}) EXPECT_EQ(boxes[foot], plain[foot] + 1);
}

// A fork on a bone that is nobody's child: bound far away, at rest it is in a hand.
TEST(GltfProps, AreHeldAsAtRest) {
    Bones bones = tiny_bones();
    size_t man_boxes = boxes_of(plain_man())[left_hand];
    Vec3 stands{-0.6f, 0.2f, 0.9f}, hand = place_of(bones, "left_hand");
    add_bone(bones, "prop", "", stands, stands + Vec3{0, 1.8f, 0});
    TinyMan rig = tiny_rig(bones);
    rig.gltf["nodes"][bones.size() - 1]["translation"] = {hand.x + 0.05f, hand.y - 0.5f, hand.z};
    auto model = parse_gltf(as_glb(rig), "/nowhere", "man.glb");
    ASSERT_TRUE(model);
    auto character = make_character(*model, "man.glb");
    ASSERT_TRUE(character) << character.error().message;
    EXPECT_EQ(boxes_of(*character)[left_hand], man_boxes + 1);
    EXPECT_EQ(boxes_of(*character)[hips], boxes_of(plain_man())[hips]);
    Vec3 middle = character->bind_joints[left_hand] + Vec3{0.05f, 0.4f, 0};  // of the fork
    float most = 0;
    for (const CharacterVertex& v : character->vertices)
        if (v.joints[0] == left_hand) most = std::max(most, length(v.position - middle));
    EXPECT_GT(most, 0.8f);
    EXPECT_LT(most, 1.0f) << "the fork was left where it was bound";
    EXPECT_NEAR(character->body.height, plain_man().body.height, 1e-3f);
}

}  // namespace
}  // namespace flaneur
