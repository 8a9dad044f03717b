// How a renderer is made: on which device, and how finely it draws.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "renderer/quality.h"

namespace flaneur {

struct RendererOptions {
    std::string device;  // part of a device's name, or its number; empty: the fastest kind, a real GPU before
                         // lavapipe
    std::optional<Quality> quality;  // default: ultra on a GPU of its own, high on
                                     // one within a processor, medium elsewhere
    bool validation =
        false;  // Khronos validation with synchronisation validation; messages go to `on_message`
    std::function<void(const std::string&)> on_message;  // default: to stderr
    bool captures = false;  // loads RenderDoc, for begin_capture(); refuses where it is not installed, and
                            // beside validation, which would take RenderDoc's word for ours
    // Has the driver compile meanwhile what it puts off until something is drawn.
    bool warms_up = false;
    std::optional<bool> skins_on_host =
        {};  // whether the host skins people; default: where the device is a CPU
    std::optional<bool> lights_on_host =
        {};  // and whether it lights what the device has drawn; the same picture but for
             // roundings, of which a GPU's may differ more than a CPU's
};

}  // namespace flaneur
