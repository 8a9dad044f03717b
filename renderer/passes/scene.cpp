#include "renderer/passes/passes.h"

namespace flaneur {

void draw_plain(const FrameRecord& record) {
    draw_people(record);
    draw_city(record);
}

void draw_scene(const FrameRecord& record) {
    draw_plain(record);
    draw_sky(record);
}

}  // namespace flaneur
