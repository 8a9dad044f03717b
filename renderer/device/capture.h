// RenderDoc's captures of what the device does. Nothing else in here knows of RenderDoc: its layer is loaded
// with the instance where it was asked for, and its interface is found in the process, whoever loaded it.
#pragma once

#include <volk.h>

#include <string>

#include "sim/base/result.h"

namespace flaneur {

inline constexpr const char* k_capture_layer = "VK_LAYER_RENDERDOC_Capture";

// Whether RenderDoc is in this process.
bool has_renderdoc();

// Whether it started this program: then each instance has its layer. Else it stays after an instance that had
// it is gone, and the next one must ask for the layer again.
bool has_renderdoc_started_us();

// What to say, and to do, where it is not installed.
Error no_renderdoc();

// Of one that is here because flaneur loaded it: no text over pictures, no keys, no reports of crashes. One
// that started flaneur keeps its ways. To be called once there is an instance.
void quieten_renderdoc();

// All that devices of the instance do from begin to end is one capture. Refuses where RenderDoc is not here.
Result<void> begin_capture(VkInstance instance);
// Where it went: see end_capture() of a Renderer.
Result<std::string> end_capture(VkInstance instance, const std::string& path);

}  // namespace flaneur
