// Which flaneur this is, for recordings that only the same one repeats.
#pragma once

#include <string>

namespace flaneur {

// "0.4.0 (1a2b3c4d)": version and commit.
std::string this_program();

}  // namespace flaneur
