// What a recording says of itself: the JSON of its head.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "sim/base/result.h"

namespace flaneur {

// How a run is told: by how all moved, which any version shows; or by what it began with and what came from
// outside, which only the version that wrote it repeats.
enum class RecordedAs : uint32_t { motion, inputs };

struct RecordingHead {
    std::string program;  // version that wrote it, and its commit
    RecordedAs as = RecordedAs::motion;
    std::string scene_name, scene;  // as JSON, of which files have whole paths
    bool force = false;             // see Options
    uint32_t first = 0;             // tick
    float error = 0.001f;           // of motion: metres at most; 0: to the last bit
};
std::string recording_head(const RecordingHead& head);
// Whether a file begins as recordings do.
bool looks_recorded(const std::string& path);
// Refuses, in a sentence, what is no recording, and what has another head.
Result<RecordingHead> read_recording_head(const std::string& path);
Result<RecordingHead> parse_recording_head(const std::string& path, std::string_view text);

}  // namespace flaneur
