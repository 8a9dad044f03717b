// What was measured on: for files of figures.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace flaneur {

// The context of Google Benchmark's files: date, host, CPU, caches, load; and which flaneur it was.
nlohmann::ordered_json machine_context();

// As the system tells it; empty: it does not.
std::string cpu_name();

// Of memory that the program had at most, so far.
double peak_megabytes();

}  // namespace flaneur
