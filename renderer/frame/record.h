// A frame while it is recorded, and what its passes share.
#pragma once

#include "renderer/frame/plan.h"

namespace flaneur {

// The picture that a frame is drawn into, and what becomes of it.
struct PictureTarget {
    GpuImage& image;
    VkPipeline fxaa = {};    // the one for the image's format
    Access after;            // what is done to the image then
    VkBuffer readback = {};  // where the picture is copied to; null: nowhere
};

struct FrameRecord {
    Renderer& renderer;
    FrameSlot& slot;
    const FramePlan& plan;
    const PictureTarget& target;
    VkCommandBuffer commands;
};

void begin_stage(const FrameRecord& record, const char* name);
void end_stage(const FrameRecord& record);

VkExtent2D extent_of(const GpuImage& image);
void set_viewport(VkCommandBuffer commands, VkExtent2D extent);
void bind(const FrameRecord& record, VkPipeline pipeline);
void bind_vertices(const FrameRecord& record, VkBuffer vertices);

// With the index buffer that is bound: the scene's, where nobody has bound another.
void draw_indirect(const FrameRecord& record, DrawRange range);

// Draws a triangle that covers an image with a pipeline without vertices.
void draw_over(const FrameRecord& record, const GpuImage& image, VkAttachmentLoadOp load,
               VkPipeline pipeline);

// Those for the light of this frame.
const LitPipelines& lit_pipelines(const FrameRecord& record);

}  // namespace flaneur
