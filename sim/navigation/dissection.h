// The order in which gates give way to shortcuts. Private to sim/navigation.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/navigation/gates.h"

namespace flaneur {

// All gates, those first that few ways lead past: nested dissection (George 1973) along straight lines. Cuts
// the gates in two where fewest must be taken out for no polygon to join the halves; these come last, and
// each half is cut in the same way.
std::vector<uint32_t> dissect(const Gates& gates, int threads);

}  // namespace flaneur
