// gltf_seeds FOLDER: small files for the fuzzer to begin with.
#include "assets/files/picture.h"
#include "tests/assets/tiny_man.h"
#include "tests/fuzz/seeds.h"

int main(int argc, char** argv) {
    using namespace flaneur;
    std::filesystem::path folder = seeds_folder(argc, argv);
    write_seed(folder / "man.glb", as_glb(tiny_man()));
    write_seed(folder / "man.gltf", as_gltf(tiny_man()));

    TinyMan swaying = tiny_man();
    animate(swaying, head, "rotation", "LINEAR", {0, 1}, {0, 0, 0, 1, 0, 1, 0, 0});
    animate(swaying, hips, "translation", "STEP", {0, 0.5f}, {0, 1, 0, 0, 1.1f, 0});
    animate(swaying, chest, "scale", "CUBICSPLINE", {0}, {0, 0, 0, 1, 1, 1, 0, 0, 0});
    write_seed(folder / "swaying.glb", as_glb(swaying));

    std::vector<TinyBone> pieces = tiny_bones();
    for (TinyBone& bone : pieces) bone.parent = -1;
    pieces.push_back({"foot_ik", -1, pieces[left_foot].place, {}, false});
    write_seed(folder / "pieces.glb", as_glb(tiny_rig(pieces)));

    TinyMan dressed = tiny_man();
    const uint8_t k_texels[] = {200, 80, 60, 255, 200, 80, 60, 0};
    std::string png = encode_png(k_texels, 2, 1, 4);
    std::vector<float> uvs(2 * dressed.gltf["accessors"][0]["count"].get<size_t>(), 0.5f);
    Json& primitive = dressed.gltf["meshes"][0]["primitives"][0];
    primitive["attributes"]["TEXCOORD_0"] = add_accessor(dressed, uvs, "VEC2");
    primitive["material"] = 0;
    dressed.gltf["images"] = {{{"uri", "data:image/png;base64," + as_base64({png.begin(), png.end()})}}};
    // A texel of WebP, for whoever mutates it on.
    dressed.gltf["images"].push_back(
        {{"uri", "data:image/webp;base64,UklGRhoAAABXRUJQVlA4TA0AAAAvAAAAEAcQERGIiP4HAA=="}});
    dressed.gltf["textures"] = {{{"source", 0}}};
    dressed.gltf["textures"][0]["extensions"]["EXT_texture_webp"]["source"] = 1;
    Json texture = {{"index", 0},
                    {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0}}, {"rotation", 1}}}}}};
    dressed.gltf["materials"] = {{{"doubleSided", true},
                                  {"alphaMode", "MASK"},
                                  {"pbrMetallicRoughness", {{"baseColorTexture", texture}}}}};
    write_seed(folder / "dressed.glb", as_glb(dressed));

    // VRM 0 lists the bones, VRM 1 keys them by name.
    TinyMan listed = tiny_man(), keyed = tiny_man();
    Json &list = listed.gltf["extensions"]["VRM"]["humanoid"]["humanBones"],
         &keys = keyed.gltf["extensions"]["VRMC_vrm"]["humanoid"]["humanBones"];
    for (auto [bone, joint] : {std::pair{"hips", hips},
                               {"head", head},
                               {"leftHand", left_hand},
                               {"leftFoot", left_foot},
                               {"rightUpperArm", right_upper_arm},
                               {"rightLowerLeg", right_lower_leg}}) {
        list.push_back({{"bone", bone}, {"node", int(joint)}});
        keys[bone] = {{"node", int(joint)}};
    }
    write_seed(folder / "man.0.vrm", as_glb(listed));
    write_seed(folder / "man.1.vrm", as_glb(keyed));
}
