#include "renderer/frame.h"

namespace flaneur {

void draw_fxaa(const FrameRecord& record) {
    draw_over(record, record.target.view, record.target.extent, VK_ATTACHMENT_LOAD_OP_DONT_CARE,
              record.target.fxaa);
}

}  // namespace flaneur
