// The passes of a frame, one file each. Each records its draws into `record.commands`.
#pragma once

#include "renderer/frame/record.h"

namespace flaneur {

// Draws the maps that have changed, with barriers and all, and leaves the shadow map ready for sampling.
void draw_shadows(const FrameRecord& record);

// Into what is being drawn, by the light of this frame.
void draw_people(const FrameRecord& record);  // meshes, unless they are ghosts, and impostors
void draw_city(const FrameRecord& record);
void draw_sky(const FrameRecord& record);    // and, before it, the spots that people leave on the ground
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

// On pixels: ambient occlusion over the picture, where the quality has it; and anti-aliasing into the target.
void draw_occlusion(const FrameRecord& record);
void draw_fxaa(const FrameRecord& record);

}  // namespace flaneur
