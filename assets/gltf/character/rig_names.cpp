#include "assets/gltf/character/rig_names.h"

#include <string>

namespace flaneur {

namespace {

// Its letters, in lower case and without a namespace.
std::string letters_of(std::string_view name) {
    std::string plain;
    for (char c : name) {
        if (c == ':') plain.clear();
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
        if (c >= 'a' && c <= 'z') plain += c;
    }
    return plain;
}

}  // namespace

BoneKind bone_kind(std::string_view name) {
    std::string plain = letters_of(name);
    // The first match decides: the particular before the general.
    struct Word {
        std::string_view part;
        BoneKind kind;
    };
    static constexpr Word k_words[] = {{"twist", BoneKind::none},         {"roll", BoneKind::none},
                                       {"thumb", BoneKind::none},         {"finger", BoneKind::none},
                                       {"index", BoneKind::none},         {"pinky", BoneKind::none},
                                       {"ring", BoneKind::none},          {"middle", BoneKind::none},
                                       {"hipjoint", BoneKind::none},      {"headend", BoneKind::none},
                                       {"pole", BoneKind::none},          {"wing", BoneKind::none},
                                       {"tail", BoneKind::none},          {"forearm", BoneKind::lower_arm},
                                       {"lowerarm", BoneKind::lower_arm}, {"lowarm", BoneKind::lower_arm},
                                       {"armlower", BoneKind::lower_arm}, {"elbow", BoneKind::lower_arm},
                                       {"upperarm", BoneKind::upper_arm}, {"uparm", BoneKind::upper_arm},
                                       {"armupper", BoneKind::upper_arm}, {"shldr", BoneKind::upper_arm},
                                       {"clavicle", BoneKind::clavicle},  {"collar", BoneKind::clavicle},
                                       {"shoulder", BoneKind::clavicle},  {"wrist", BoneKind::hand},
                                       {"hand", BoneKind::hand},          {"thigh", BoneKind::upper_leg},
                                       {"upleg", BoneKind::upper_leg},    {"upperleg", BoneKind::upper_leg},
                                       {"legupper", BoneKind::upper_leg}, {"calf", BoneKind::lower_leg},
                                       {"shin", BoneKind::lower_leg},     {"knee", BoneKind::lower_leg},
                                       {"lowerleg", BoneKind::lower_leg}, {"leglower", BoneKind::lower_leg},
                                       {"lowleg", BoneKind::lower_leg},   {"toe", BoneKind::toes},
                                       {"ball", BoneKind::toes},          {"ankle", BoneKind::foot},
                                       {"foot", BoneKind::foot},          {"neck", BoneKind::neck},
                                       {"head", BoneKind::head},          {"armature", BoneKind::none},
                                       {"arm", BoneKind::upper_arm},      {"leg", BoneKind::lower_leg}};
    for (const Word& word : k_words)
        if (plain.find(word.part) != std::string::npos) return word.kind;
    return BoneKind::none;
}

int bone_side(std::string_view name) {
    // Words in lower case between blanks: "lThigh", "LThigh", "thighL" and "thigh_l_01" have the word "l".
    auto upper = [](char c) { return c >= 'A' && c <= 'Z'; };
    auto lower = [](char c) { return c >= 'a' && c <= 'z'; };
    std::string plain = " ";
    for (size_t i = 0; i < name.size(); ++i) {
        char c = name[i];
        bool begins =
            upper(c) && i > 0 &&
            (lower(name[i - 1]) || (upper(name[i - 1]) && i + 1 < name.size() && lower(name[i + 1])));
        if (begins) plain += ' ';
        if (upper(c)) c = char(c - 'A' + 'a');
        plain += lower(c) ? c : ' ';
    }
    plain += ' ';
    auto has = [&](std::string_view part) { return plain.find(part) != std::string::npos; };
    bool left = has("left") || has(" l "), right = has("right") || has(" r ");
    return int(left) - int(right);
}

bool lies_in_front(std::string_view name) {
    std::string plain = letters_of(name);
    for (std::string_view part : {"thumb", "eye", "nose", "jaw", "mouth", "tongue", "snout", "beak"})
        if (plain.find(part) != std::string::npos) return true;
    return false;
}

}  // namespace flaneur
