// A frame while it is recorded, and what its passes share.
#pragma once

#include "renderer/frame/plan.h"
#include "sim/base/zone.h"

namespace flaneur {

// The picture that a frame is drawn into, and what becomes of it.
struct PictureTarget {
    VkExtent2D extent = {};
    GpuImage* image = nullptr;   // null: the host lights, and nobody else wants the picture
    VkPipeline smooth = {};      // the one for the image's format, where the device lights
    GpuImage* scaled = nullptr;  // a larger image that the picture then goes to; null: none
    VkPipeline panels = {};      // the one for the last of these images
    Access after = {};           // what is done to that one then
    VkBuffer readback = {};      // where the device copies the picture to; null: nowhere
    uint32_t* pixels = nullptr;  // where the host puts it, if it lights
    VkBuffer staging = {};       // which that is, for the image to be copied from
    bool is_blue_first = false;  // in these
};

struct FrameRecord {
    Renderer& renderer;
    FrameSlot& slot;
    const FramePlan& plan;
    const PictureTarget& target;
    VkCommandBuffer commands;
};

// Where the picture ends up.
inline GpuImage& final_image(const FrameRecord& record) {
    return record.target.scaled ? *record.target.scaled : *record.target.image;
}

// A zone that is a stage of the frame too: FLANEUR_ZONE("light", record) is labelled for debuggers, timed by
// the device and, where that was asked for, counted (stages.h).
class StageZone {
  public:
    StageZone(const char* name, const FrameRecord& record) : zone_(name), record_(record) {
        begin_stage(record.commands, record.slot.stages, name);
    }
    ~StageZone() { end_stage(record_.commands, record_.slot.stages); }
    StageZone(const StageZone&) = delete;
    StageZone& operator=(const StageZone&) = delete;

  private:
    Zone zone_;  // of the host, which records it
    const FrameRecord& record_;
};
inline StageZone open_zone(const char* name, const FrameRecord& record) { return {name, record}; }

VkExtent2D extent_of(const GpuImage& image);
void set_viewport(VkCommandBuffer commands, VkExtent2D extent);
void bind(const FrameRecord& record, VkPipeline pipeline);
void bind_vertices(const FrameRecord& record, VkBuffer vertices);

// With the index buffer that is bound: the city's, where nobody has bound another.
void draw_indirect(const FrameRecord& record, DrawRange range);

// Begins to draw all over an image, without depth.
void begin_over(const FrameRecord& record, const GpuImage& image, VkAttachmentLoadOp load);
// Draws a triangle that covers an image with a pipeline without vertices.
void draw_over(const FrameRecord& record, const GpuImage& image, VkAttachmentLoadOp load,
               VkPipeline pipeline);

}  // namespace flaneur
