// Command lines as lists of words, and as the one line that a shell takes.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/result.h"

namespace flaneur {

// "flaneur view --city 'my town.osm'"
std::string shell_line(const std::vector<std::string>& words);

// What shell_line() was given. Of shells' ways to quote it knows single quotes, double ones without anything
// to be put in, and the backslash. Refuses a quote that does not end.
Result<std::vector<std::string>> shell_words(std::string_view line);

// `words` without these options, and without their values, but for those that are `flags`, which have none.
std::vector<std::string> without_options(const std::vector<std::string>& words,
                                         std::span<const std::string_view> options,
                                         std::span<const std::string_view> flags = {});

// What of `words` are these options, with their values, and these flags.
std::vector<std::string> only_options(const std::vector<std::string>& words,
                                      std::span<const std::string_view> options,
                                      std::span<const std::string_view> flags = {});

// Whether an option is among them, as --name or --name=value.
bool has_option(const std::vector<std::string>& words, std::string_view option);

}  // namespace flaneur
