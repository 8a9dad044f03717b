// Pictures and films of what the window shows. While a film is made, the city's time goes by in the film's
// steps: each picture of the window is one of the film, however long it takes to draw.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "renderer/scene.h"
#include "tools/flaneur/options/options.h"
#include "tools/flaneur/output/film.h"
#include "tools/flaneur/view/show.h"

namespace flaneur {

struct Action;
struct Clock;
struct Viewer;

// How large a picture is to be.
enum class Extent : uint8_t { window, hd, uhd, uhd_8k, typed };
struct PictureChoice {
    Extent extent = Extent::window;
    char typed[16] = "1600x900";
    bool has_panels = false;                  // only in the window's size
    bool is_transparent = false;              // where there is sky
    bool has_depth = false, has_ids = false;  // as further files
    bool is_exr = false;                      // these
};
// In pixels. Refuses what is typed and is no size.
Result<Size> size_of(const PictureChoice& choice, Size window);

// What a camera looks at: what is in the middle of its picture or, on a small world, that one's middle.
glm::vec3 looked_at(const World& world, const Camera& camera);

// Once round a place. The eye keeps its height and its distance.
struct Turntable {
    glm::vec3 middle{0};
    std::optional<uint32_t> walker;  // stays in the middle, wherever it goes
    Camera from;
    uint32_t pictures = 0;
};
// A camera further round the upright line through a place, by an angle, radians.
Camera turned_round(const Camera& from, glm::vec3 middle, float angle);
// That of a picture, from 0; `middle` is where the middle is by now.
Camera turned(const Turntable& turn, glm::vec3 middle, uint32_t picture);

struct Filming {
    FilmPtr film;  // null where a test counts
    std::string path;
    Size size;
    uint32_t step = 2;      // ticks to a picture, at the usual rate of time
    uint32_t pictures = 0;  // so far,
    uint32_t still = 0;     // and those between which time was stopped
    uint32_t all = 0;       // when it ends by itself; 0: until it is ended
    std::optional<Turntable> turn;
    double began = 0;  // of the window's time
};

struct Record {
    PictureChoice picture;
    bool wants_picture = false, wants_panels = false;  // one now; one once panels are laid out
    bool wants_capture = false;                        // of the next one (capture.h)
    Extent film_extent = Extent::hd;
    bool is_smooth = false;  // 60 pictures a second rather than 30
    int turn_seconds = 12;
    int film_seconds = 0;     // after which it ends by itself; 0: until it is ended
    bool wants_film = false;  // or no longer, if one is made
    bool wants_turn = false;
    std::optional<Filming> filming;
};

// Seconds of the city that go by until the next picture, while a film is made; else `passed`. Exactly as many
// as its ticks take.
double seconds_to_pass(const Record& record, double passed);
// between_ticks() of the next picture. A film at the usual rate of time shows each tick as it is.
float between_pictures(const Record& record, const Clock& clock);

// Once for each picture of the window, before it is extracted: begins and ends films, and writes the pictures
// that are asked for. What cannot be written is told. Fails only with the device.
Result<void> take_pictures(Show& show, Viewer& viewer, Size window, float between);
// One with panels: of the window's frame, which holds them.
Result<void> take_picture_with_panels(Show& show, Viewer& viewer, const FrameInput& frame, Size window);
// How long the film is by now, of how long, and how long that takes: "2.0 s, drawn in 31 s" or
// "2.0 of 12 s, about 2 min to go". `now`: the window's time.
std::string told_progress(const Filming& filming, double now);
// That time was stopped in all of it, or in a part; "" where it was in none.
std::string told_standstill(const Filming& filming);
// A film that is being made becomes whole.
void end_film(Viewer& viewer);

// out/view-361.png, or another number where that is there.
std::string free_path(const char* what, uint32_t tick, const char* ending);
// On the terminal and in the window.
void report(Viewer& viewer, const std::string& what);

// What keys ask for (window/actions.h).
void ask_for_picture(Show& show, Viewer& viewer);
void ask_for_film(Show& show, Viewer& viewer);
void ask_for_turn(Show& show, Viewer& viewer);
void open_record_room(Show& show, Viewer& viewer);

void lay_out_record(Show& show, Viewer& viewer, float scale);
// How far the film is, over the city.
void lay_out_filming(Viewer& viewer, Size size);

// All of it (window/actions.h).
std::span<const Action> record_actions();

}  // namespace flaneur
