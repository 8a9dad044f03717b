#include "tools/flaneur/window/open/pictures.h"

#include <span>
#include <string_view>

#include "assets/files/picture.h"
#include "assets/scene.h"
#include "scene_pictures.h"

namespace flaneur {

std::vector<RgbaImage> scene_pictures() {
    constexpr size_t k_most_pixels = 1 << 20;
    std::vector<RgbaImage> pictures;
    for (const std::string& name : scene_names()) {
        RgbaImage& picture = pictures.emplace_back(RgbaImage{1, 1, {96, 96, 96, 255}});
        for (const ScenePicture& kept : k_scene_pictures) {
            if (kept.name != name) continue;
            Result<DecodedPicture> decoded = decode_picture(kept.bytes, k_most_pixels);
            if (decoded)
                picture = {static_cast<uint32_t>(decoded->width), static_cast<uint32_t>(decoded->height),
                           std::move(decoded->rgba)};
        }
    }
    return pictures;
}

}  // namespace flaneur
