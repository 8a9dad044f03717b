// What was measured on: for files of figures.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace flaneur {

// The context of Google Benchmark's files: date, host, CPU, caches, load; and which flaneur it was.
nlohmann::ordered_json machine_context();

// Of memory that the program had at most, so far.
double peak_megabytes();

}  // namespace flaneur
