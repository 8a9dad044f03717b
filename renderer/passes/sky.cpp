#include "renderer/frame.h"

namespace flaneur {

void draw_sky(const FrameRecord& record) {
    vkCmdBindPipeline(record.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, record.renderer.pipelines.sky);
    vkCmdDraw(record.commands, 3, 1, 0, 0);
}

}  // namespace flaneur
