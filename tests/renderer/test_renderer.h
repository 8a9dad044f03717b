// Renderers for tests: Mesa's CPU driver draws, whatever else the machine has, in medium quality. What is
// counted and compared is the same everywhere.
#pragma once

#include <gtest/gtest.h>

#include <tuple>
#include <utility>

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

// Whether the host lights, and a quality.
class ByLightAndQuality : public testing::TestWithParam<std::tuple<bool, Quality>> {
  protected:
    void SetUp() override {
        RendererOptions options = validated();
        options.lights_on_host = std::get<0>(GetParam());
        options.quality = std::get<1>(GetParam());
        Result<RendererPtr> made = make_renderer(options);
        ASSERT_TRUE(made) << made.error().message;
        renderer = std::move(*made);
    }
    RendererPtr renderer;
};

}  // namespace flaneur
