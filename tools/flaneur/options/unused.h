// Options that go with others only. Private to tools/flaneur/options.
#pragma once

#include <CLI/CLI.hpp>

#include "tools/flaneur/options/options.h"

namespace flaneur {

// Refuses an option that was given and that what is asked for has no use for.
Result<void> check_used(const CLI::App& command, const Options& options);

}  // namespace flaneur
