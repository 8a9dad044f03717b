// What is said of a command line that cannot be followed. Private to tools/flaneur/options.
#pragma once

#include <CLI/CLI.hpp>

#include "sim/base/result.h"

namespace flaneur {

// Refuses what is no number from `low` to `high`, or no whole one: 1e3 is, and becomes 1000 by
// Option::transform.
CLI::Validator number_between(double low, double high);
CLI::Validator whole_between(int64_t low, int64_t high);

// Refuses a value that is empty, as of a variable that nobody set: it is not the same as no value.
Result<void> check_values(const CLI::App& command);

// The sentence for what CLI11 has thrown, with what was probably meant.
Error refusal(CLI::App& app, const CLI::ParseError& error, int argc, char** argv);

}  // namespace flaneur
