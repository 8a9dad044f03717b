// The subcommands. Each says what went wrong in a sentence; main prints it.
#pragma once

#include "sim/base/result.h"
#include "tools/flaneur/options/options.h"

namespace flaneur {

Result<void> run_view(const Options& options);
Result<void> run_render(const Options& options);
Result<void> run_sim(const Options& options);
Result<void> run_check(const Options& options);
Result<void> run_replay(const Options& options);
Result<void> run_export(const Options& options);
Result<void> run_diff(const Options& options);
Result<void> run_join(const Options& options);
Result<void> run_validate(const Options& options);
Result<void> run_measure(const Options& options);
Result<void> run_gait(const Options& options);
Result<void> run_inspect(const Options& options);
Result<void> run_city(const Options& options);
Result<void> run_people(const Options& options);
Result<void> run_scenes(const Options& options);
Result<void> run_bench(const Options& options);
Result<void> run_cache(const Options& options);

}  // namespace flaneur
