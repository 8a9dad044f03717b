// gltf_seeds FOLDER: small files for the fuzzer to begin with.
#include <filesystem>
#include <fstream>
#include <iostream>

#include "assets/files/picture.h"
#include "tests/assets/tiny_man.h"

namespace {

using namespace flaneur;

void write(const std::filesystem::path& path, const Bytes& bytes) {
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    if (!file) std::cerr << "Cannot write " << path << "\n", std::exit(1);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "gltf_seeds FOLDER\n";
        return 1;
    }
    std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder);
    write(folder / "man.glb", as_glb(tiny_man()));
    write(folder / "man.gltf", as_gltf(tiny_man()));

    TinyMan swaying = tiny_man();
    animate(swaying, head, "rotation", "LINEAR", {0, 1}, {0, 0, 0, 1, 0, 1, 0, 0});
    animate(swaying, hips, "translation", "STEP", {0, 0.5f}, {0, 1, 0, 0, 1.1f, 0});
    animate(swaying, chest, "scale", "CUBICSPLINE", {0}, {0, 0, 0, 1, 1, 1, 0, 0, 0});
    write(folder / "swaying.glb", as_glb(swaying));

    std::vector<TinyBone> pieces = tiny_bones();
    for (TinyBone& bone : pieces) bone.parent = -1;
    pieces.push_back({"foot_ik", -1, pieces[left_foot].place, {}, false});
    write(folder / "pieces.glb", as_glb(tiny_rig(pieces)));

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
    dressed.gltf["extensions"]["VRM"]["humanoid"]["humanBones"] = {{{"bone", "hips"}, {"node", 0}}};
    write(folder / "dressed.glb", as_glb(dressed));
}
