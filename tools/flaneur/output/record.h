// What of a command decides its pictures: films and numbered pictures keep it, so that --resume goes on with
// what the same command began and with nothing else.
#pragma once

#include <string>

#include "tools/flaneur/options/options.h"

namespace flaneur {

// One line of JSON, in ASCII: each option with its value. Files are told by name and size, whatever their
// folder. The device is left out, and so is the last tick: more may be asked for.
std::string record_of(const Options& options);

// Refuses to go on with a file whose record differs from this command's, or that has none: "it was begun with
// --seed 1, not --seed 2".
Result<void> check_record(const std::string& path, const std::string& begun, const std::string& now);

}  // namespace flaneur
