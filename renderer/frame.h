// One frame, from what moves to a picture: the same for a window and off-screen.
#pragma once

#include "renderer/daylight.h"
#include "renderer/state.h"

namespace flaneur {

// The picture that a frame is drawn into, and what becomes of it.
struct PictureTarget {
    VkImage image = {};
    VkImageView view = {};
    VkPipeline fxaa = {};  // the one for the image's format
    VkExtent2D extent = {};
    Access before, after;    // of the image
    VkBuffer readback = {};  // where the picture is copied to; null: nowhere
};

// Consecutive draws in FrameSlot::draws.
struct DrawRange {
    uint32_t first = 0, count = 0;
};

// All that is settled on the CPU before recording.
struct FramePlan {
    View view;
    Daylight light;
    float lit_windows = 0;
    bool has_shadows = false;      // of sun or moon
    int light_kind = k_light_day;  // k_light_*
    Slice slice;
    ShadowBox near_box, far_box;
    std::optional<vec3> backdrop;                    // see FrameInput
    bool times_passes = false;                       // see FrameInput
    bool refresh_near = false, refresh_far = false;  // the city's shadows are to be drawn anew
    DrawRange facades, props, surfaces[3], scenery, shades, casters;
    DrawRange crowd, crowd_skinned;  // of people: skinned by the device, and by the host
    DrawRange casters_skinned;
    SkinPlan crowd_skin, casters_skin;
    DrawRange near_city, far_city, near_scenery, far_scenery;  // what throws shadows into the maps
    std::vector<DrawCommand> draws;
    std::vector<Contact> contacts;
    Surfaces surfaces_view = Surfaces::lit;
    bool are_tinted = false, are_ghosts = false;  // people
    uint32_t lines = 0, fills = 0;                // gizmos, and corners of fills
};

struct FrameRecord {
    Renderer& renderer;
    FrameSlot& slot;
    const FramePlan& plan;
    const PictureTarget& target;
    VkCommandBuffer commands;
};

// Culls a frame's walkers and the city. `renderer`'s crowd and casters are filled too.
void plan_frame(Renderer& renderer, const FrameInput& input, VkExtent2D extent, FramePlan& plan);

// Skins those people whom the host skins, and their shadows' casters, into the slot's buffers, and completes
// their draws.
Result<void> skin_people(Renderer& renderer, FrameSlot& slot, const FrameInput& input, VkExtent2D extent,
                         FramePlan& plan);

// What the shaders are told.
FrameConstants frame_constants(const Renderer& renderer, const FramePlan& plan, VkExtent2D extent);

// Draws into `target` with a free slot: culls, uploads, records and submits. `wait` and `signal` may be null.
Result<void> draw_frame(Renderer& renderer, FrameSlot& slot, const FrameInput& input,
                        const PictureTarget& target, VkSemaphore wait, VkSemaphore signal);

// Waits until the slot's frame is done and reads its timestamps.
Result<void> finish_slot(Renderer& renderer, FrameSlot& slot);

// The passes, in order; each records into `record.commands`.
void draw_shadows(const FrameRecord& record);  // leaves the shadow map ready for sampling
void draw_city(const FrameRecord& record);
void draw_crowd(const FrameRecord& record);
void draw_crowd_shadows(const FrameRecord& record);  // into the map that is being drawn
void draw_impostors(const FrameRecord& record);
void draw_impostor_shadows(const FrameRecord& record);  // into the map that is being drawn
void draw_contacts(const FrameRecord& record);
void draw_sky(const FrameRecord& record);
void draw_occlusion(const FrameRecord& record);  // where the quality has it; over the picture
void draw_paint(const FrameRecord& record);      // in place of crowd, city and sky
void draw_ghosts(const FrameRecord& record);
void draw_overlay(const FrameRecord& record);
void draw_fxaa(const FrameRecord& record);

// What draw_paint and draw_overlay need for a frame.
std::vector<ViewPipeline> view_pipelines_for(const FrameInput& input);

// A named stretch of the frame, labelled for debuggers and timed from the end of the one before to its own.
void begin_stage(const FrameRecord& record, const char* name);
void end_stage(const FrameRecord& record);

// For the passes.
// Draws a triangle that covers `view`, an image of that size, with a pipeline without vertices.
void draw_over(const FrameRecord& record, VkImageView view, VkExtent2D extent, VkAttachmentLoadOp load,
               VkPipeline pipeline);
const LitPipelines& lit_pipelines(const FrameRecord& record);
void draw_indirect(const FrameRecord& record, DrawRange range);
void set_viewport(VkCommandBuffer commands, VkExtent2D extent);

}  // namespace flaneur
