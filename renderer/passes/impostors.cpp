#include "renderer/frame.h"

namespace flaneur {

void draw_impostors(const FrameRecord& record) {
    const uint32_t count = static_cast<uint32_t>(record.renderer.crowd.impostors.size());
    if (count == 0) return;
    vkCmdBindPipeline(record.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, record.renderer.pipelines.impostor);
    vkCmdDraw(record.commands, 6 * count, 1, 0, 0);
}

}  // namespace flaneur
