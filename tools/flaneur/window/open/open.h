// Opening: files that are dropped or typed, the built-in scenes, what was opened of late. What is shown
// stays, and goes on, until the next show is there; what cannot be read is told and changes nothing. One show
// is loaded at a time: of those that are asked for meanwhile the last one wins.
#pragma once

#include <future>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/scene.h"
#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/open/plan.h"

namespace flaneur {

struct Action;
struct Viewer;

// Where a path is typed.
struct PathPrompt {
    bool is_open = false;
    char typed[1024] = {};
    int chosen = -1;                     // of `rows`; -1: what is typed
    std::string looked_for;              // what `found` is of
    std::vector<std::string> found;      // completions()
    std::vector<std::string> rows;       // to choose from: the folder above, and what is found
    bool wants_focus = false;            // to type in, after something else was clicked
    std::optional<std::string> becomes;  // what is typed next, in place of it
};

// Scenes and files to choose from.
struct StartScreen {
    bool is_open = false;
    int chosen = 0;          // the built-in scenes, then the files opened of late, then what asks for a path
    bool has_moved = false;  // it is brought into sight
    int columns = 1;         // of scenes, as they are laid out
};

struct Opening {
    std::string name;                   // of the city that is shown
    std::vector<std::string> words;     // that what is shown was opened with, after `flaneur view`
    std::vector<std::string> dropped;   // files, not looked at yet
    std::optional<ShowWish> next;       // to be loaded
    std::optional<ShowWish> under_way;  // is being loaded
    bool is_unwanted = false;           // what is under way
    std::future<Result<PreparedShow>> loading;
    PathPrompt prompt;
    StartScreen start;
    std::vector<std::string> recent;
    std::vector<glm::vec4>
        pictures;  // of the built-in scenes in their order, as panels show them: u, v from, to
};

// At the beginning: what options name counts as opened, and the others are looked up.
void begin_opening(const Options& options, Opening& opening);

// Asks for one.
void open_path(Viewer& viewer, const std::string& path);
void open_scene(Viewer& viewer, const std::string& name);
// Of who is on a course: the same in one line, or round.
void open_course(Viewer& viewer, bool is_flat);

// Once a frame: looks at what was dropped, begins to load what is asked for, and, once that is there, shows
// it in place of what was. Tells what could not be opened.
void go_on_opening(Show& show, Viewer& viewer);
// Whether something is being loaded.
bool is_opening(const Opening& opening);
// Gives up what is being loaded; whether anything was.
bool give_up_opening(Opening& opening);

// What keys ask for (window/actions.h): where a path is typed, at first that of the file opened last or,
// where that is no more, the working directory; and the start screen.
void ask_for_path(Show& show, Viewer& viewer);
void open_start_screen(Show& show, Viewer& viewer);

void lay_out_opening(Show& show, Viewer& viewer, Size size, float scale);
// Keys while a path is typed, or one chooses what to begin with; whether they were for that.
bool press_in_opening(int key, int mods, Show& show, Viewer& viewer);

// All of it (window/actions.h).
std::span<const Action> opening_actions();

}  // namespace flaneur
