// What a user keeps of a scene between runs: bookmarks of cameras, and marks of moments. A file for each
// city, in $XDG_STATE_HOME/flaneur/scenes/; in it marks are those of one run, who walks there and the seed.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "assets/scene.h"
#include "tools/flaneur/window/cameras/cameras.h"
#include "tools/flaneur/window/time/time.h"

namespace flaneur {

inline constexpr size_t k_most_runs = 20, k_most_marks = 200;  // that a file keeps; of each run

struct KeptRun {
    std::string run;  // run_name()
    std::vector<Mark> marks;
    bool operator==(const KeptRun&) const = default;
};
struct Kept {
    std::array<std::optional<Bookmark>, k_bookmarks> bookmarks;
    std::vector<KeptRun> runs;  // the one that was changed last is the first
    bool operator==(const Kept&) const = default;
};

// Where it is kept what a user keeps of a scene's city; empty: nowhere.
std::string kept_file(const Scene& scene);
// Which run it is of all those in that city: another where other people walk, or with another seed.
std::string run_name(const Scene& scene, uint64_t seed);

// Of the text of such a file, and it. What it says besides does not count. Refuses what is none, in a
// sentence without a subject.
Result<Kept> parse_kept(std::string_view text);
std::string told(const Kept& kept);

// Nothing where there is no file. Refuses, by its name, one that cannot be used.
Result<Kept> read_kept(const std::string& file);

// In a window.
struct Keeping {
    std::string file, run;  // where, and run_name() of what is shown
    Kept last;              // as it is in the file, of this run
};

// Takes the bookmarks of the scene that was opened, and the marks of its run.
void recall(const Show& show, Viewer& viewer);
// Takes the marks of the run that has begun, of the same scene.
void recall_marks(const Show& show, Viewer& viewer);
// Once a frame, unless something is being typed: writes them if they are others. Marks of a run that was
// changed by hand come with nothing that could be opened again, and are not kept.
void keep_what_is_kept(Viewer& viewer);

}  // namespace flaneur
