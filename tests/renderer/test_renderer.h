// Renderers for tests: Mesa's CPU driver draws, whatever else the machine has, in medium quality. What is
// counted and compared is the same everywhere.
#pragma once

#include <gtest/gtest.h>

#include "renderer/renderer.h"

namespace flaneur {

inline RendererOptions on_lavapipe() {
    RendererOptions options;
    options.device = "llvmpipe";
    options.quality = Quality::medium;
    return options;
}

// Any validation message fails the test that hears it.
inline RendererOptions validated() {
    RendererOptions options = on_lavapipe();
    options.validation = true;
    options.on_message = [](const std::string& message) { ADD_FAILURE() << message; };
    return options;
}

}  // namespace flaneur
