// Where everybody was, into a file of trajectories.
#pragma once

#include "tools/flaneur/output/output.h"

namespace flaneur {

// Of a recording or a scene; 25 frames a second where nothing else is asked for.
Result<void> export_tracks(const Options& options, PartFilePtr file);
// Of another file of trajectories, which has its own rate unless another is asked for. Between its frames
// places are on straight lines, and who is not there in both is left out.
Result<void> export_file(const Options& options, PartFilePtr file);

}  // namespace flaneur
