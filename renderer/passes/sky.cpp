#include "renderer/passes/passes.h"

namespace flaneur {
namespace {

void draw_contacts(const FrameRecord& record) {
    const auto count = static_cast<uint32_t>(record.plan.contacts.size());
    if (count == 0) return;
    bind_vertices(record, record.slot.contacts.handle);
    bind(record, record.renderer.pipelines.surfaces.contact);
    vkCmdDraw(record.commands, 6, count, 0, 0);
}

}  // namespace

void draw_sky(const FrameRecord& record) {
    draw_contacts(record);
    if (record.plan.light.lamps == 0) return;
    bind(record, record.renderer.pipelines.surfaces.stars);
    vkCmdDraw(record.commands, 3, 1, 0, 0);
}

}  // namespace flaneur
