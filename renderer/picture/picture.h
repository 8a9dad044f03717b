// The picture: which passes make it, one after the other.
#pragma once

#include "renderer/frame/record.h"

namespace flaneur {

// Records all of a frame, from shadows to the host's copy.
void record_picture(const FrameRecord& record);

}  // namespace flaneur
