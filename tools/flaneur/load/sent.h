// Whether those whom a demand sends can walk where it sends them.
#pragma once

#include <string>
#include <vector>

#include "sim/base/result.h"
#include "sim/world.h"

namespace flaneur {

// Sentences about sendings that nobody can walk, the first few by name. Refuses, in a sentence that goes on
// from what the demand is called, heights at which nobody walks, and sendings none of which can be walked.
Result<std::vector<std::string>> check_sent(const std::vector<Sending>& sendings,
                                            const std::vector<std::string>& names, const Navmesh& mesh);

}  // namespace flaneur
