// Files whole: read within limits, written beside their place and renamed.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/result.h"

namespace flaneur {

// The bytes of a regular file of at most `most`; never waits for a pipe. Errors have the path as their
// subject.
Result<std::vector<uint8_t>> read_whole(const std::string& path, size_t most);

// Folders on the way are made. There is the old file or the whole new one, never half of one.
Result<void> write_whole(const std::string& path, std::span<const uint8_t> bytes);
Result<void> write_whole(const std::string& path, std::string_view text);

// The last bytes of a file, from the beginning of a line; empty where there is none.
std::string tail_of(const std::string& path, size_t most);

}  // namespace flaneur
