// The options of each command. Private to the files that parse them.
#pragma once

#include "tools/flaneur/options/options.h"
#include "tools/flaneur/options/scene.h"

namespace flaneur {

void add_view(CLI::App& app, SceneWords& words, Options& options);
void add_render(CLI::App& app, SceneWords& words, Options& options);
void add_sim(CLI::App& app, SceneWords& words, Options& options);
void add_check(CLI::App& app, SceneWords& words, Options& options);
void add_replay(CLI::App& app, SceneWords& words, Options& options);
void add_export(CLI::App& app, SceneWords& words, Options& options);
void add_diff(CLI::App& app, Options& options);
void add_join(CLI::App& app, Options& options);
void add_validate(CLI::App& app, Options& options);
void add_measure(CLI::App& app, Options& options);
void add_bench(CLI::App& app, SceneWords& words, Options& options);
void add_gait(CLI::App& app, SceneWords& words, Options& options);
void add_people(CLI::App& app, SceneWords& words, Options& options);
void add_inspect(CLI::App& app, SceneWords& words, Options& options);
void add_city(CLI::App& app, SceneWords& words, Options& options);
void add_scenes(CLI::App& app, Options& options);
// After all others, which get --no-cache by it.
void add_cache(CLI::App& app, Options& options);

// What is drawn with: device, size, quality.
void add_drawing_options(CLI::App& app, SceneWords& words, Options& options);

// --view
void add_work_views(CLI::App& app, SceneWords& words);

// --unit and the others of trajectories
void add_reading_options(CLI::App& app, TrajectoryReading& reading);

// --shard
CLI::Option* add_shard_option(CLI::App& app, Options& options);

// --record and what belongs to it; --replay, after all options of the scene
void add_record_options(CLI::App& app, Options& options);
void add_replay_option(CLI::App& app, SceneWords& words);
// The scene that a recording is of, or that trajectories make. Refuses, in a sentence, what is neither.
Result<Scene> replayed_scene(const SceneWords& words, Options& options);

// --trace
void add_trace_option(CLI::App& app, Options& options);
void add_lod(CLI::App& app, Options& options);

// --threads; `what` they do
CLI::Option* add_threads_option(CLI::App& app, Options& options, const char* what);

// --isa
void add_isa_option(CLI::App& app, Options& options);

// Refuses a check of nothing.
Result<void> settle_check(const CLI::App& command, const Options& options);
// Refuses lines and zones that cannot be counted by, and figures of none.
Result<void> settle_measures(Options& options);

}  // namespace flaneur
