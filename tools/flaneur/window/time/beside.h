// Another run beside this one, drawn from the same place: with another seed, with other numbers, or as it
// was.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "assets/scene.h"
#include "sim/without.h"
#include "tools/extract/extract.h"
#include "tools/flaneur/history/history.h"
#include "tools/flaneur/measure/count.h"
#include "tools/flaneur/overlay/overlay.h"

namespace flaneur {

struct Anew;
struct Image;
struct Show;
struct Size;
struct Viewer;

struct Beside {
    std::unique_ptr<World> world;
    std::shared_ptr<const City> city;  // that the renderer holds for it; null: it walks in this run's
    // The light of its hour and weather, which stay.
    Sun sun;
    bool is_overcast = false;
    float lit_windows = 0;
    HistoryPtr history;
    std::optional<uint32_t> moment;  // tick at which it stands still; none: it goes along with this one
    std::string city_told;           // which city it is, where that is not this run's
    bool shows_difference = false;   // of densities, over the right picture
    PeopleFrame people;              // as it is drawn
    Without without;
    Overlay overlay;
    Counts counts;  // by the lines and zones of this run
};

// Makes it in the background, of the same city and characters; it is there once it is made. In place of one
// that is there.
struct BesideChoice {
    uint64_t seed = 1;
    uint32_t walkers = 0;
    std::optional<uint32_t> moment{};
    std::optional<Scene> scene{};  // in the city of which it walks; none: in this one
    std::string city_told{};       // in two or three words, which that is
};
void set_beside(Show& show, Viewer& viewer, const BesideChoice& choice);
// Takes what was made.
void put_beside(Show& show, Viewer& viewer, std::unique_ptr<World> world, Anew& anew);
// This run beside one in the city as it was opened: its streets, hour, weather and people, from the start.
void set_beside_as_opened(Show& show, Viewer& viewer);
// The same with nothing but the streets as they were opened: what was put into them, before and after. Where
// nothing was, as above.
void set_beside_before(Show& show, Viewer& viewer);
// This run, as it is now, beside what becomes of it.
void set_beside_this_moment(Show& show, Viewer& viewer);

// Whether a run goes along beside this one and is more than a second behind: this one waits.
bool waits_for_beside(const Viewer& viewer, const World& world);

// Goes along, for a while that leaves the window alive. To be called once a picture, after this run's ticks.
void keep_up_beside(Show& show, Viewer& viewer);

// Its people are counted by the same lines and zones as this run's. To be called when those have changed, and
// before it goes along.
void count_beside(const Counts& here, Beside& beside);

// Whether two pictures are shown side by side: this run and another one, or bodies with all that makes them
// and without some of it (see ask/techniques.h).
bool has_two(const Viewer& viewer);
// The size of one of them: all of it, or a half.
Size size_of_one(const Viewer& viewer, Size size);
// Both: `frame` is the left one, of size_of_one.
Result<Image> draw_side_by_side(Show& show, Viewer& viewer, const FrameInput& frame, Size size,
                                float between);

// What differs, in figures: of all, and of each line and zone.
void lay_out_beside(const Show& show, Viewer& viewer);

// Of everybody in a world: how many, how many of them walk, at what mean speed those, m/s, and how dense the
// densest square of k_crowd_cell is, people/m2.
struct CrowdFigures {
    uint32_t people = 0, walking = 0;
    float speed = 0, density = 0;
};
CrowdFigures figures_of(const World& world);

}  // namespace flaneur
