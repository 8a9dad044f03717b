// What a frame draws: settled on the host before anything is recorded.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "renderer/frame/state.h"
#include "renderer/light/daylight.h"
#include "renderer/people/skin.h"
#include "renderer/visible/contacts.h"

namespace flaneur {

// Consecutive draws in FrameSlot::draws.
struct DrawRange {
    uint32_t first = 0, count = 0;
};

// What of the city throws shadows into a map.
struct CityCasters {
    DrawRange opaque, scenery;
};

// All that is settled on the CPU before recording.
struct FramePlan {
    View view;
    Daylight light;
    float lit_windows = 0;
    float lens_time = 0;
    bool has_shadows = false;  // of sun or moon
    Spared without;            // see FrameInput
    Slice slice;
    ShadowBox near, far;               // where shadows are thrown
    ShadowState shadows;               // once this frame is drawn
    std::vector<ShadowSlices> slices;  // of the city's shadows, to be drawn
    std::vector<CityCasters> slice_casters;
    std::optional<vec3> backdrop;                    // see FrameInput
    float clear_air = 0;                             // see Camera
    bool times_passes = false;                       // see FrameInput
    std::array<DrawRange, k_city_classes> surfaces;  // of the city in view, by CityClass
    DrawRange crowd, crowd_skinned;                  // of people: skinned by the device, and by the host
    DrawRange casters, casters_skinned;              // and those who throw shadows
    SkinPlan crowd_skin, casters_skin;
    std::vector<TexelRect> near_changed;  // where people throw shadows or did, of the near map
    std::vector<DrawCommand> draws;
    std::vector<Contact> contacts;
    Surfaces surfaces_view = Surfaces::lit;
    bool are_tinted = false, are_ghosts = false;  // people
    uint32_t lines = 0, fills = 0;                // gizmos, and corners of fills
    std::span<const PanelDraw> panels;            // of the frame's input
    FrameConstants constants;
    std::vector<vec4> sky;  // at the corners of its grid
};

// Whether something is laid over the picture.
inline bool has_overlay(const FramePlan& plan) { return plan.lines > 0 || plan.fills > 0 || plan.are_ghosts; }

// Culls a frame's walkers and the city. `renderer`'s crowd, casters, walls seen (`hidden`) and last view are
// those of the frame then.
void plan_frame(Renderer& renderer, const FrameInput& input, VkExtent2D extent, FramePlan& plan);

}  // namespace flaneur
