// Whether there can be a recording, before anything is loaded for it.
#pragma once

#include "sim/base/result.h"
#include "tools/flaneur/options/options.h"

namespace flaneur {

struct Taking;

// Refuses, in a sentence, where --record could not write, and inputs of a world that goes by where it is
// looked at from.
Result<void> check_record(const Options& options);
// Somebody is led by hand, which inputs cannot tell: they end.
void note_led(Taking& taking);

}  // namespace flaneur
