// The passes of a frame, one file each. Each records its draws into `record.commands`.
#pragma once

#include "renderer/frame/record.h"

namespace flaneur {

// Draws the maps that have changed, with barriers and all, and leaves the shadow map ready for sampling.
void draw_shadows(const FrameRecord& record);

// What surfaces are, into what is being drawn.
void draw_people(const FrameRecord& record);  // meshes, unless they are ghosts, and impostors
void draw_city(const FrameRecord& record);
void draw_sky(
    const FrameRecord& record);  // stars and, before them, the spots that people leave on the ground
void draw_scene(const FrameRecord& record);  // all of these
void draw_plain(const FrameRecord& record);  // people and city alone

// Into the shadow map that is being drawn.
void draw_people_shadows(const FrameRecord& record);

// Views for work: in place of the scene, and over it.
void draw_paint(const FrameRecord& record);
void draw_overlay(const FrameRecord& record);
void draw_ghosts(const FrameRecord& record);
// What those two need for a frame.
std::vector<ViewPipeline> view_pipelines_for(const FrameInput& input);

// On pixels: ambient occlusion into what surfaces are, where the quality has it; and where the device lights,
// light, and anti-aliasing into the target with what is laid over the picture.
void draw_occlusion(const FrameRecord& record);
void draw_light(const FrameRecord& record);
void draw_smooth(const FrameRecord& record);

// On the picture once it is done: scales it into the target's larger image; lays panels over; copies it to
// the host.
void scale_picture(const FrameRecord& record);
void draw_panels(const FrameRecord& record);
void copy_picture(const FrameRecord& record);

// Where the host lights: hands on what it reads, and the picture that it has made to the target's image.
void hand_surfaces_to_host(const FrameRecord& record);
void take_from_host(const FrameRecord& record);

}  // namespace flaneur
