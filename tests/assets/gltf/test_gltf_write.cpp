#include <gtest/gtest.h>

#include "assets/gltf/write.h"
#include "assets/outfit.h"
#include "tests/folder.h"

namespace flaneur {
namespace {

struct WrittenCharacter : testing::Test {
    Result<Character> read_back(const std::string& glb) {
        return load_character(folder.write("person.glb", glb));
    }
    TestFolder folder;
};

TEST_F(WrittenCharacter, ComesBackAsItWas) {
    for (bool woman : {false, true}) {
        PersonOptions options;
        options.seed = 3;
        options.height = woman ? 1.62f : 1.85f;
        options.woman = woman;
        Character written = generate_person(options);
        Result<Character> read = read_back(character_glb(written, outfit({}, 1, 2)));
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_TRUE(read->notes.empty()) << read->notes[0];  // nothing to be repaired or made up
        EXPECT_EQ(read->lods[0].size(), written.lods[0].size());
        EXPECT_NEAR(read->body.height, written.body.height, 0.01f);
        for (size_t j = 0; j < k_joint_count; ++j) {
            EXPECT_LT(length(read->bind_joints[j] - written.bind_joints[j]), 0.02f) << k_joint_names[j];
            EXPECT_LT(length(read->body.joints[j] - written.body.joints[j]), 0.04f) << k_joint_names[j];
        }
    }
}

TEST_F(WrittenCharacter, WearsItsTints) {
    Character written = generate_person({});
    std::array<uint32_t, k_tint_count> tints;
    tints.fill(0xff203040u);
    for (CharacterVertex& v : written.vertices) {
        v.tint = Tint::top;
        v.colour = 0xffffffffu;
    }
    Result<Character> read = read_back(character_glb(written, tints));
    ASSERT_TRUE(read) << read.error().message;
    for (const CharacterVertex& v : read->vertices) {
        EXPECT_EQ(v.tint, Tint::none);
        for (int shift : {0, 8, 16}) {
            EXPECT_NEAR(static_cast<int>(v.colour >> shift & 0xff),
                        static_cast<int>(0x203040 >> shift & 0xff), 2);
        }
    }
}

TEST_F(WrittenCharacter, BearsVrmNames) {
    std::string glb = character_glb(generate_person({}), outfit({}, 1, 2));
    for (const char* name : {"\"hips\"", "\"upperChest\"", "\"leftUpperArm\"", "\"rightToes\""})
        EXPECT_NE(glb.find(name), std::string::npos) << name;
}

}  // namespace
}  // namespace flaneur
