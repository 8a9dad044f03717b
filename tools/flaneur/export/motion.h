// How everybody moved, as files of motion.
#pragma once

#include "tools/flaneur/output/output.h"

namespace flaneur {

// A .glb of all, or a .bvh: of several people a folder of that name without its ending, with a file each. 60
// frames a second where nothing else is asked for.
Result<void> export_motion(const Options& options, PartFilePtr file);

}  // namespace flaneur
