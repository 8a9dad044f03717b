#include "renderer/passes/passes.h"

namespace flaneur {
namespace {

void draw_contacts(const FrameRecord& record) {
    const auto count = static_cast<uint32_t>(record.plan.contacts.size());
    if (count == 0) return;
    bind_vertices(record, record.slot.contacts.handle);
    bind(record, lit_pipelines(record).contact);
    vkCmdDraw(record.commands, 6, count, 0, 0);
}

}  // namespace

void draw_sky(const FrameRecord& record) {
    draw_contacts(record);
    bind(record, lit_pipelines(record).sky);
    vkCmdDraw(record.commands, 6 * k_sky_columns * k_sky_rows, 1, 0, 0);
}

}  // namespace flaneur
