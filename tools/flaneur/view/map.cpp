// A city from straight above.
#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "tools/extract/convert.h"
#include "tools/flaneur/view/camera.h"

namespace flaneur {
namespace {

constexpr float k_map_fov = 0.14f;  // 8 degrees upright: a house of 20 m leans by 2.5 m at the border
constexpr float k_lean = 1e-3f;     // radians off the vertical, which tell what is up
constexpr float k_sky = 10'000;     // above and below all ground
constexpr float k_margin = 1.04f;   // about all of a city

// The mean height of what is shown, so that it changes little by little while a map is moved.
float mean_height(const Ground& ground, Vec2 middle, float across) {
    constexpr int k_side = 8;
    float sum = 0;
    int count = 0;
    for (int i = 0; i < k_side; ++i)
        for (int j = 0; j < k_side; ++j) {
            const float x = (static_cast<float>(i) + 0.5f) / k_side - 0.5f,
                        z = (static_cast<float>(j) + 0.5f) / k_side - 0.5f;
            const auto hit =
                ground_at(ground, {middle.x + x * across, 0, middle.z + z * across}, k_sky, k_sky);
            if (hit) sum += hit->height, ++count;
        }
    return count > 0 ? sum / static_cast<float>(count) : 0;
}

}  // namespace

Camera map_camera(const World& world, const CameraChoice& choice, Size size) {
    const CameraChoice map = choice.across > 0 ? choice : map_of_all(world, size);
    const float up_down = map.across * static_cast<float>(size.height) / static_cast<float>(size.width);
    const float above = up_down / (2 * std::tan(k_map_fov / 2));
    const SinCos north = sin_cos(map.bearing * k_radians);
    const Vec3 up{north.sine, 0, -north.cosine};
    const Vec3 middle = at_height(map.middle, mean_height(*world.ground, map.middle, map.across));
    Camera camera = make_camera(middle + Vec3{0, above, 0} - up * (k_lean * above), middle);
    camera.vertical_fov = k_map_fov;
    camera.clear_air = 3 * above;
    return camera;
}

CameraChoice map_of_all(const World& world, Size size) {
    CameraChoice map;
    map.kind = CameraChoice::Kind::map;
    const Vec2 reach = world.ground->high - world.ground->low;
    map.middle = (world.ground->low + world.ground->high) * 0.5f;
    const float wide = static_cast<float>(size.width) / static_cast<float>(size.height);
    map.across = std::clamp(k_margin * std::max(reach.x, reach.z * wide), k_least_across, k_most_across);
    return map;
}

}  // namespace flaneur
