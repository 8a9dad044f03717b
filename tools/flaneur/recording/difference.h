// Where two recordings part: the first tick at which somebody, or something, is elsewhere.
#pragma once

#include <string>

#include "sim/base/result.h"
#include "tools/flaneur/options/options.h"

namespace flaneur {

// Prints that all ticks that both have are equal within so many metres, and half as many degrees as
// millimetres, or the first that is not. An error where one is not.
Result<void> compare_recordings(const std::string& here, const std::string& there, float within,
                                const Options& options);

}  // namespace flaneur
