// A little scene made here, so that the renderer's tests lean on nothing else: a street with buildings, a
// square with a tree, and crude people of a few rounded boxes over 22 joints.
#pragma once

#include <vector>

#include "renderer/scene.h"

namespace flaneur {

struct SyntheticScene {
    SceneMeshes meshes;
    std::vector<WalkerDraw> walkers;
    std::vector<JointTransform> palette;
    std::vector<GroundBelow> grounds;
    FrameInput frame(const Camera& camera, const Sun& sun = {}) const {
        return {camera, sun, walkers, palette, grounds};
    }
};

CityMesh synthetic_city();

// `people` walkers on the street, in strides that differ. The same every time.
SyntheticScene synthetic_scene(int people);

// One walker at `place`, facing `yaw` radians from +z, in a stride of `phase` radians.
void add_walker(SyntheticScene& scene, glm::vec3 place, float yaw, float phase, uint32_t look);

Camera street_camera();
Camera overview_camera();

}  // namespace flaneur
