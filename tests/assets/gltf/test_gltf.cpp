#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>

#include "assets/character.h"
#include "tests/folder.h"

namespace flaneur {
namespace {

namespace fs = std::filesystem;

const fs::path k_corpus = fs::path(FLANEUR_SHARED_DIR) / "corpus";

#define SKIP_WITHOUT(path) \
    if (!fs::exists(path)) GTEST_SKIP() << (path) << " is not here: the files that it holds are not tried"

void expect_sound(const Character& c) {
    ASSERT_FALSE(c.lods.empty());
    ASSERT_FALSE(c.lods[0].empty());
    for (const auto& level : c.lods) {
        ASSERT_EQ(level.size() % 3, 0u);
        for (uint32_t i : level) ASSERT_LT(i, c.vertices.size());
    }
    for (size_t l = 1; l < c.lods.size(); ++l)
        EXPECT_TRUE(c.lods[l] == c.lods[l - 1] || c.lods[l].size() < c.lods[l - 1].size());
    for (const CharacterVertex& v : c.vertices) {
        int sum = 0;
        for (size_t n = 0; n < 4; ++n) {
            sum += v.weights[n];
            ASSERT_LT(v.joints[n], k_joint_count);
        }
        ASSERT_EQ(sum, 255);
        ASSERT_TRUE(std::isfinite(v.position.x + v.position.y + v.position.z));
        ASSERT_TRUE(v.texture == CharacterVertex::k_no_texture || v.texture < c.textures.size());
    }
    const auto& j = c.body.joints;
    EXPECT_GT(c.body.height, 0.4f);
    EXPECT_LT(c.body.height, 2.6f);
    EXPECT_GT(j[head].y, j[neck].y);
    EXPECT_GT(j[neck].y, j[hips].y);
    EXPECT_GT(j[left_upper_leg].x, 0);
    EXPECT_GT(j[left_upper_arm].x, 0);
    for (Joint leg : {left_upper_leg, right_upper_leg}) {
        EXPECT_GT(j[leg].y, j[size_t(leg) + 1].y) << "the knee is below the hip";
        EXPECT_GT(j[size_t(leg) + 1].y, j[size_t(leg) + 2].y) << "the ankle is below the knee";
        EXPECT_GT(j[size_t(leg) + 3].z, j[size_t(leg) + 2].z) << "the toes lead";
        EXPECT_GE(j[size_t(leg) + 2].y, 0);
    }
    for (int n = 0; n < 4; ++n) {
        Vec3 left = j[size_t(left_shoulder + n)], right = j[size_t(right_shoulder + n)];
        EXPECT_EQ(left, (Vec3{-right.x, right.y, right.z}));
    }
    EXPECT_GT(c.body.heel, 0);
    EXPECT_GT(c.body.toe, 0);
}

std::string refusal(const fs::path& path) {
    auto c = load_character(path.string());
    return c ? "(was loaded)" : c.error().message;
}

struct Known {
    const char* file;
    float height, leg;  // metres, leg as a part of the height
};

void PrintTo(const Known& known, std::ostream* out) { *out << known.file; }

class KnownCharacter : public testing::TestWithParam<Known> {};

TEST_P(KnownCharacter, StandsAsItShould) {
    fs::path path = k_corpus / "characters" / GetParam().file;
    SKIP_WITHOUT(path);
    auto c = load_character(path.string());
    ASSERT_TRUE(c) << c.error().message;
    expect_sound(*c);
    EXPECT_NEAR(c->body.height, GetParam().height, 0.06f);
    EXPECT_NEAR(leg_length(c->body) / c->body.height, GetParam().leg, 0.05f);
    EXPECT_NEAR(thigh_length(c->body) / shank_length(c->body), 1, 0.25f);
}

INSTANTIATE_TEST_SUITE_P(Corpus, KnownCharacter,
                         testing::Values(Known{"khronos_CesiumMan.glb", 1.52f, 0.41f},
                                         Known{"mpfb_male_mixamo.glb", 1.75f, 0.53f},
                                         Known{"quaternius_modular_men_Casual.glb", 1.87f, 0.52f}));

struct Mapped {
    const char* file;
    float height, leg;              // as above
    std::vector<int> made_up = {};  // joints that the file lacks
};

// What each of them lacks, and no more.
TEST(Gltf, CharactersAreMapped) {
    SKIP_WITHOUT(k_corpus / "characters");
    const std::vector<int> k_no_toes = {left_toes, right_toes};
    const Mapped k_mapped[] = {
        {"babylon_riggedMesh.glb", 1.701f, 0.531f},
        {"kaykit_Knight.glb", 1.702f, 0.211f, {chest, neck, left_shoulder, right_shoulder}},
        {"khronos_CesiumMan.glb", 1.52f, 0.413f, {spine, left_shoulder, right_shoulder}},
        {"khronos_RiggedFigure.glb", 1.463f, 0.429f, {spine, neck, left_shoulder, right_shoulder}},
        {"mpfb_female_cmu.glb", 1.61f, 0.514f},
        {"mpfb_female_ue.glb", 1.498f, 0.513f},
        {"mpfb_male_mixamo.glb", 1.754f, 0.535f},
        // Its feet are targets, which move no vertex.
        {"quaternius_cyberpunk_pack_Character.glb",
         1.411f,
         0.488f,
         {left_foot, left_toes, right_foot, right_toes}},
        {"quaternius_modular_men_Casual.glb", 1.873f, 0.518f, k_no_toes},
        {"quaternius_modular_women_Formal.glb", 1.845f, 0.563f, k_no_toes},
        {"rocketbox_Male_Adult_01.glb", 1.826f, 0.492f, {neck}},
        {"sketchbook_boxman.glb",
         1.039f,
         0.332f,
         {chest, neck, left_shoulder, left_hand, right_shoulder, right_hand, left_foot, left_toes, right_foot,
          right_toes}},
        {"threejs_RobotExpressive.glb", 1.71f, 0.347f, k_no_toes},
        {"vrm0_cryptovoxels.vrm", 1.492f, 0.472f, {spine}}};
    for (const Mapped& known : k_mapped) {
        SCOPED_TRACE(known.file);
        auto c = load_character((k_corpus / "characters" / known.file).string());
        ASSERT_TRUE(c) << c.error().message;
        EXPECT_NEAR(c->body.height, known.height, 0.005f);
        EXPECT_NEAR(leg_length(c->body) / c->body.height, known.leg, 0.003f);
        std::vector<int> made_up;
        for (size_t j = 0; j < k_joint_count; ++j)
            if (c->found.nodes[j].empty()) made_up.push_back(int(j));
        EXPECT_EQ(made_up, known.made_up);
    }
}

std::vector<fs::path> gltf_files(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        std::string kind = entry.path().extension().string();
        if (kind == ".glb" || kind == ".gltf" || kind == ".vrm") files.push_back(entry.path());
    }
    return files;
}

TEST(Gltf, CharactersLoadOrSayWhyNot) {
    SKIP_WITHOUT(k_corpus / "characters");
    for (const fs::path& path : gltf_files(k_corpus / "characters")) {
        auto c = load_character(path.string());
        if (c) {
            SCOPED_TRACE(path);
            expect_sound(*c);
        } else {
            EXPECT_NE(c.error().message.find(path.filename().string()), std::string::npos);
            std::cout << "refused: " << c.error().message << "\n";
        }
    }
}

// Nothing in there may crash, hang, leak or load into nonsense. The suite runs this under sanitizers too
// (whole.suite_asan).
// Of memory that this program has ever held.
long most_kilobytes() {
    rusage used{};
    EXPECT_EQ(getrusage(RUSAGE_SELF, &used), 0);
    return used.ru_maxrss;
}

TEST(Gltf, OddFilesAreLoadedOrRefused) {
    SKIP_WITHOUT(k_corpus / "odd");
    const long before = most_kilobytes();
    size_t loaded = 0, refused = 0;
    for (const fs::path& path : gltf_files(k_corpus / "odd")) {
        auto c = load_character(path.string());
        if (c) {
            SCOPED_TRACE(path);
            expect_sound(*c);
            ++loaded;
        } else {
            EXPECT_GT(c.error().message.size(), path.string().size() + 20) << c.error().message;
            EXPECT_TRUE(c.error().message.starts_with(path.string() + ": "));
            ++refused;
        }
    }
    std::cout << loaded + refused << " files tried, " << loaded << " loaded, " << refused
              << " refused, 0 crashed\n";
    EXPECT_GT(refused, 0u);
    EXPECT_LT(most_kilobytes() - before, 1 << 20);
}

// Those that hold people load, however they are packed.
TEST(Gltf, OddPeopleAreLoaded) {
    SKIP_WITHOUT(k_corpus / "odd" / "compressed");
    for (const char* name : {"quaternius_men_Casual.meshopt.glb", "quaternius_men_Casual.quantized.glb",
                             "rocketbox_assimp_cm_pivots.glb"}) {
        auto c = load_character((k_corpus / "odd" / "compressed" / name).string());
        ASSERT_TRUE(c) << c.error().message;
        EXPECT_NEAR(c->body.height, 1.85f, 0.05f) << name;
    }
    EXPECT_NE(refusal(k_corpus / "odd" / "compressed" / "gltf1_WalkingLady.glb").find("1.0"),
              std::string::npos);
}

TEST(Gltf, RefusalsNameWhatIsMissing) {
    EXPECT_NE(refusal("no/such/file.glb").find("cannot be opened"), std::string::npos);

    TestFolder folder;
    fs::path scratch = folder.path;
    std::ofstream(scratch / "text.glb") << "This is a letter, not a model.";
    EXPECT_NE(refusal(scratch / "text.glb").find("no glTF file"), std::string::npos);
    std::ofstream(scratch / "empty.gltf") << R"({"asset":{"version":"2.0"}})";
    EXPECT_NE(refusal(scratch / "empty.gltf").find("no skinned mesh"), std::string::npos);
    std::ofstream(scratch / "cycle.gltf")
        << R"({"asset":{"version":"2.0"},"nodes":[{"children":[1]},{"children":[0]}]})";
    EXPECT_NE(refusal(scratch / "cycle.gltf").find("cycle"), std::string::npos);
    std::ofstream(scratch / "stray.gltf") << R"({"asset":{"version":"2.0"},"nodes":[{"children":[7]}]})";
    EXPECT_NE(refusal(scratch / "stray.gltf").find("does not exist"), std::string::npos);
}

TEST(Gltf, CorpusRefusalsNameWhatIsMissing) {
    fs::path characters = k_corpus / "characters";
    SKIP_WITHOUT(characters);
    EXPECT_NE(refusal(characters / "khronos_Fox.glb").find("no arms"), std::string::npos);
    EXPECT_NE(refusal(characters / "khronos_RiggedSimple.glb").find("no pair of limbs"), std::string::npos);

    // Truncated halfway.
    std::ifstream whole(characters / "khronos_CesiumMan.glb", std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(whole)), {});
    TestFolder folder;
    EXPECT_NE(refusal(folder.write("half.glb", bytes.substr(0, bytes.size() / 2))).find("cut short"),
              std::string::npos);
}

}  // namespace
}  // namespace flaneur
