// The picture: which passes make it, one after the other.
#pragma once

#include "renderer/frame/record.h"

namespace flaneur {

// Records all of a frame, from shadows to what the host lights, or to its copy of the picture.
void record_picture(const FrameRecord& record);
// And, where the host has lit it, the rest.
void record_picture_from_host(const FrameRecord& record);

}  // namespace flaneur
