// The instruction set that kernels run on. Highway takes the widest that the CPU has; tests and benchmarks
// choose another to compare.
#pragma once

#include <string_view>
#include <vector>

#include "sim/base/result.h"

namespace flaneur {

// Those that kernels are compiled for and this CPU has, narrowest first: sse4, avx2, avx512; on Arm neon.
// Only scalar where lanes are compiled out, as under sanitizers.
std::vector<std::string_view> isa_names();

// From now on kernels run on this one; "best" is the widest. Refuses one that is not to be had here. Not to
// be called while kernels run.
Result<void> use_isa(std::string_view name);

}  // namespace flaneur
