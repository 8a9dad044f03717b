// A scene with people in it, as the program loads it.
#pragma once

#include <gtest/gtest.h>

#include <utility>

#include "assets/scene.h"
#include "tools/flaneur/load/load.h"

namespace flaneur {

inline Loaded loaded_scene(const char* scene, int walkers, int threads = 0, uint64_t seed = 1) {
    Options options;
    options.scene = load_scene(scene).value();
    options.scene.walkers = walkers;
    options.scene.seed = seed;
    options.scene.stays = true;  // tests go along with somebody
    options.threads = threads;
    Result<Loaded> made = load(options);
    EXPECT_TRUE(made) << made.error().message;
    return std::move(*made);
}

}  // namespace flaneur
