#include "tools/flaneur/commands.h"
#include "tools/flaneur/output/parts.h"

namespace flaneur {

Result<void> run_join(const Options& options) { return join_parts(options.out); }

}  // namespace flaneur
