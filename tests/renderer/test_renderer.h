// A validated renderer for tests: any validation message fails the test that hears it.
#pragma once

#include <gtest/gtest.h>

#include "renderer/renderer.h"

namespace flaneur {

inline RendererOptions validated() {
    return {.device = {},
            .quality = Quality::medium,
            .validation = true,
            .on_message = [](const std::string& message) { ADD_FAILURE() << message; }};
}

}  // namespace flaneur
