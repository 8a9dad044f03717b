#include "renderer/frame.h"

namespace flaneur {

void draw_sky(const FrameRecord& record) {
    vkCmdBindPipeline(record.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, lit_pipelines(record).sky);
    vkCmdDraw(record.commands, 6 * k_sky_columns * k_sky_rows, 1, 0, 0);
}

}  // namespace flaneur
