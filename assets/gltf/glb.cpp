#include "assets/gltf/glb.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "assets/files/picture.h"

namespace flaneur {

tinygltf::Model begin_glb() {
    tinygltf::Model model;
    model.asset.version = "2.0";
    model.asset.generator = "flaneur";
    model.buffers.emplace_back();
    return model;
}

std::string finish_glb(tinygltf::Model& model) {
    std::ostringstream bytes;
    tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, bytes, false, true);
    return std::move(bytes).str();
}

std::vector<double> numbers(Vec3 v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

float light_of(uint32_t colour, int shift) {
    float c = static_cast<float>(colour >> shift & 0xffu) / 255;
    return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
}

int add_view(tinygltf::Model& model, std::span<const uint8_t> bytes, int target) {
    std::vector<uint8_t>& data = model.buffers[0].data;
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = bytes.size();
    view.target = target;
    data.resize(data.size() + (bytes.size() + 3) / 4 * 4);
    std::copy(bytes.begin(), bytes.end(), data.begin() + static_cast<std::ptrdiff_t>(view.byteOffset));
    model.bufferViews.push_back(view);
    return static_cast<int>(model.bufferViews.size()) - 1;
}

int add_texture(tinygltf::Model& model, std::span<const uint8_t> rgba, int width, int height) {
    const std::string png = encode_png(rgba, width, height, 4);
    tinygltf::Image image;
    image.bufferView = add_view(model, {reinterpret_cast<const uint8_t*>(png.data()), png.size()}, 0);
    image.mimeType = "image/png";
    tinygltf::Texture texture;
    texture.source = static_cast<int>(model.images.size());
    model.images.push_back(image);
    model.textures.push_back(texture);
    return static_cast<int>(model.textures.size()) - 1;
}

int add_positions(tinygltf::Model& model, std::span<const Vec3> positions) {
    int number = add_accessor(model, positions, TINYGLTF_TYPE_VEC3, TINYGLTF_COMPONENT_TYPE_FLOAT,
                              TINYGLTF_TARGET_ARRAY_BUFFER);
    Vec3 low = positions[0], high = low;
    for (Vec3 p : positions) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    tinygltf::Accessor& accessor = model.accessors[static_cast<size_t>(number)];
    accessor.minValues = numbers(low);
    accessor.maxValues = numbers(high);
    return number;
}

}  // namespace flaneur
