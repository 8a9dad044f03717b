#include "tools/flaneur/window/record/record.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "sim/base/math.h"
#include "sim/base/tick.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/console/ending.h"
#include "tools/flaneur/output/channels.h"
#include "tools/flaneur/output/measures.h"
#include "tools/flaneur/output/output.h"
#include "tools/flaneur/view/camera.h"
#include "tools/flaneur/view/ids.h"
#include "tools/flaneur/window/change/hand.h"
#include "tools/flaneur/window/command.h"
#include "tools/flaneur/window/measure/drawing.h"
#include "tools/flaneur/window/navigate.h"
#include "tools/flaneur/window/panels.h"
#include "tools/flaneur/window/viewer.h"

namespace flaneur {
namespace {

constexpr double k_film_patience = 30;        // seconds that ffmpeg may take to finish what it was given
constexpr uint32_t k_film_ticks = 60;         // a second
constexpr float k_filming_resolution = 0.5f;  // of the window, which is drawn besides

// What a picture shows besides its light, as far as it has it: beside it. Which files these are.
Result<std::vector<std::string>> write_beside(const City& city, const PictureChoice& choice,
                                              const Image& image, const std::string& picture) {
    const std::string stem = picture.substr(0, picture.size() - 4), ending = choice.is_exr ? ".exr" : ".png";
    const std::string depth = choice.has_depth && !image.depths.empty() ? stem + "-depth" + ending : "";
    const std::string ids = choice.has_ids && !image.ids.empty() ? stem + "-ids" + ending : "";
    Result<ChannelFiles> files = open_channels(depth, ids);
    if (!files) return files.error();
    if (Result<void> done = write_channels(std::move(*files), image, city); !done) return done.error();
    std::vector<std::string> paths;
    if (!depth.empty()) paths.push_back(depth);
    if (!ids.empty()) paths.insert(paths.end(), {ids, legend_path(ids)});
    return paths;
}

// A picture with its channels; what was written where. With panels it is opaque, and no command draws it.
Result<std::string> write_picture(const Show& show, Viewer& v, const Image& image, bool has_panels) {
    const Size size{static_cast<int>(image.width), static_cast<int>(image.height)};
    const std::string path = free_path("view", show.loaded.world->tick, ".png");
    const PictureChoice& choice = v.record.picture;
    const bool is_transparent = choice.is_transparent && !has_panels && !image.depths.empty();
    const bool has_command = !has_panels && why_no_command(v, *show.loaded.world).empty();
    Result<PartFilePtr> file = open_file(path);
    if (!file) return file.error();
    if (Result<void> done =
            write_png(std::move(*file), image.rgba, size, has_command ? command_now(show, v, size) : "",
                      is_transparent ? Alpha::kept : Alpha::dropped);
        !done)
        return done.error();
    const Result<std::vector<std::string>> channels = write_beside(*show.loaded.city, choice, image, path);
    if (!channels) return channels.error();
    std::string told = "Wrote " + path;
    for (size_t i = 0; i < channels->size(); ++i)
        told.append(i + 1 == channels->size() ? " and " : ", ").append((*channels)[i], path.size() - 4);
    if (has_two(v) && (choice.has_depth || choice.has_ids)) told += "; depth and ids are of one run alone";
    return told;
}

void ask_for_channels(const PictureChoice& choice, FrameInput& frame) {
    frame.wants_depths = choice.is_transparent || choice.has_depth;
    frame.wants_ids = choice.has_ids;
}

// One picture, or two side by side; channels of one alone.
Result<Image> draw(Show& show, Viewer& v, const FrameInput& frame, Size size, float between) {
    if (has_two(v)) return draw_side_by_side(show, v, frame, size, between);
    return draw_image(*show.renderer, frame, static_cast<uint32_t>(size.width),
                      static_cast<uint32_t>(size.height));
}

// Draws and writes one of the chosen size.
void take_picture(Show& show, Viewer& v, Size window, float between) {
    const Result<Size> size = size_of(v.record.picture, window);
    if (!size) return report(v, size.error().message);
    // As the command draws it, which tells a place and no companion.
    FrameInput frame = extract_frame(show, v.camera, size_of_one(v, *size), between);
    ask_for_channels(v.record.picture, frame);
    const Result<Image> image = draw(show, v, frame, *size, between);
    const Result<std::string> told = image ? write_picture(show, v, *image, false) : image.error();
    report(v, told ? *told : told.error().message);
}

glm::vec3 middle_of(const Show& show, const Turntable& turn) {
    if (!turn.walker) return turn.middle;
    const Vec3 at = show.loaded.world->crowd.motion.position[*turn.walker];
    return {at.x, at.y + 1, at.z};
}

// Round who was asked about, or what is in the middle of the picture.
Turntable turn_of(const Show& show, Viewer& v, uint32_t step) {
    take_off(v);
    Turntable turn{
        {}, v.selected, v.camera, static_cast<uint32_t>(v.record.turn_seconds) * k_film_ticks / step};
    turn.middle = looked_at(*show.loaded.world, v.camera);
    turn.middle = middle_of(show, turn);
    return turn;
}

void begin_film(Show& show, Viewer& v, Size window, bool turns) {
    PictureChoice choice = v.record.picture;
    choice.extent = v.record.film_extent;
    const Result<Size> size = size_of(choice, window);
    if (!size) return report(v, size.error().message);
    Filming filming;
    filming.size = *size;
    filming.step = v.record.is_smooth ? 1 : 2;
    filming.path = free_path(turns ? "turn" : "film", show.loaded.world->tick, ".mp4");
    Result<FilmPtr> film =
        open_film(filming.path, *size, filming.step,
                  why_no_command(v, *show.loaded.world).empty() ? command_now(show, v, *size) : "", false);
    if (!film) return report(v, film.error().message);
    be_patient(k_film_patience);
    filming.film = std::move(*film);
    if (turns) filming.turn = turn_of(show, v, filming.step);
    filming.all = turns ? filming.turn->pictures
                        : static_cast<uint32_t>(v.record.film_seconds) * k_film_ticks / filming.step;
    filming.began = glfwGetTime();
    v.clock.due = 0;
    v.record.filming = std::move(filming);
    if (v.clock.is_paused) tell(v, "Time is stopped, and so it is in the film: Space lets it go on.");
}

// One picture of the film that is being made.
Result<void> go_on_filming(Show& show, Viewer& v, float between) {
    Filming& filming = *v.record.filming;
    if (filming.turn) v.camera = turned(*filming.turn, middle_of(show, *filming.turn), filming.pictures);
    FrameInput frame = extract_frame(show, v.camera, size_of_one(v, filming.size), between);
    frame.companion = companion_of(v.choice);
    // What is there, and nothing of what a hand is about.
    mark_measures_beside(v, v.measure.counts, show.overlay, frame);
    mark_added(v, show, frame);
    const Result<Image> image = draw(show, v, frame, filming.size, between);
    if (!image) return image.error();
    if (Result<void> written = write_film(*filming.film, image->rgba); !written) {
        v.record.filming.reset();
        report(v, written.error().message);
        return {};
    }
    v.resolution = std::min(v.resolution, k_filming_resolution);
    ++filming.pictures;
    if (v.clock.is_paused) ++filming.still;
    if (filming.pictures != filming.all) return {};
    if (filming.turn) v.camera = filming.turn->from;
    end_film(v);
    return {};
}

}  // namespace

Result<Size> size_of(const PictureChoice& choice, Size window) {
    switch (choice.extent) {
        case Extent::window:
            return window;
        case Extent::hd:
            return Size{1920, 1080};
        case Extent::uhd:
            return Size{3840, 2160};
        case Extent::uhd_8k:
            return Size{7680, 4320};
        default:
            break;
    }
    Result<Size> size = parse_size(choice.typed);
    if (!size) return Error{size.error().message + "."};
    return size;
}

glm::vec3 looked_at(const World& world, const Camera& camera) {
    if (world.roam) return glm::vec3(0);
    return place_along(world, camera, glm::normalize(camera.target - camera.eye));
}

Camera turned_round(const Camera& from, glm::vec3 middle, float angle) {
    const SinCos a = sin_cos(angle);
    auto round = [&](glm::vec3 place) {
        const glm::vec3 out = place - middle;
        return middle +
               glm::vec3(out.x * a.cosine + out.z * a.sine, out.y, out.z * a.cosine - out.x * a.sine);
    };
    Camera camera = from;
    camera.eye = round(from.eye);
    camera.target = round(from.target);
    return camera;
}

Camera turned(const Turntable& turn, glm::vec3 middle, uint32_t picture) {
    const float share = static_cast<float>(picture) / static_cast<float>(std::max(turn.pictures, 1u));
    Camera camera = turned_round(turn.from, turn.middle, share * 2 * k_pi);
    camera.eye += middle - turn.middle, camera.target += middle - turn.middle;
    return camera;
}

double seconds_to_pass(const Record& record, double passed) {
    if (!record.filming) return passed;
    return static_cast<double>(record.filming->step) * static_cast<double>(k_tick);
}

float between_pictures(const Record& record, const Clock& clock) {
    return record.filming && clock.rate == 1 ? 1 : between_ticks(clock);
}

Result<void> take_pictures(Show& show, Viewer& v, Size window, float between) {
    Record& r = v.record;
    const bool wants_turn = std::exchange(r.wants_turn, false);
    if (std::exchange(r.wants_film, false) || wants_turn) {
        if (r.filming)
            end_film(v);
        else
            begin_film(show, v, window, wants_turn);
    } else if (r.filming) {
        if (Result<void> done = go_on_filming(show, v, between); !done) return done;
    }
    if (!std::exchange(r.wants_picture, false)) return {};
    r.wants_panels = r.picture.has_panels && r.picture.extent == Extent::window;
    if (!r.wants_panels) take_picture(show, v, window, 1);  // as a command draws the tick
    return {};
}

Result<void> take_picture_with_panels(Show& show, Viewer& v, const FrameInput& frame, Size window) {
    if (!std::exchange(v.record.wants_panels, false)) return {};
    FrameInput wanted = frame;
    ask_for_channels(v.record.picture, wanted);
    Result<Image> image = draw(show, v, wanted, window, 1);
    if (image && has_two(v)) image = draw_over_image(*show.renderer, *image, frame.panels);
    if (!image) return image.error();
    const Result<std::string> told = write_picture(show, v, *image, true);
    report(v, told ? *told : told.error().message);
    return {};
}

std::string told_progress(const Filming& filming, double now) {
    const double passed = std::max(now - filming.began, 0.0), drawn = filming.pictures * filming.step / 60.0;
    auto told = [](double seconds) {
        char text[32];
        if (seconds < 99.5)
            std::snprintf(text, sizeof text, "%.0f s", seconds);
        else
            std::snprintf(text, sizeof text, "%.0f min", std::round(seconds / 60));
        return std::string(text);
    };
    char text[96];
    if (filming.all == 0) {
        std::snprintf(text, sizeof text, "%.1f s, drawn in %s", drawn, told(passed).c_str());
        return text;
    }
    std::snprintf(text, sizeof text, "%.1f of %.0f s", drawn, filming.all * filming.step / 60.0);
    if (filming.pictures == 0) return text;
    const double left = passed * (filming.all - filming.pictures) / filming.pictures;
    return std::string(text).append(", about ").append(told(left)).append(" to go");
}

std::string told_standstill(const Filming& filming) {
    if (filming.still == 0) return "";
    if (filming.still >= filming.pictures) return "; time was stopped in all of it";
    char text[64];
    std::snprintf(text, sizeof text, "; time was stopped in %.1f s of it",
                  filming.still * filming.step / 60.0);
    return text;
}

void end_film(Viewer& v) {
    if (!v.record.filming) return;
    Filming filming = std::move(*std::exchange(v.record.filming, std::nullopt));
    if (!filming.film) return;
    if (filming.pictures == 0) return report(v, "The film is not kept: it had no picture yet.");
    const Result<void> done = finish_film(std::move(filming.film));
    filming.all = 0;  // it is as long as it is
    report(v, done ? "Wrote " + filming.path + ", " + told_progress(filming, glfwGetTime()) +
                         told_standstill(filming)
                   : done.error().message);
}

std::string free_path(const char* what, uint32_t tick, const char* ending) {
    std::string stem = "out/";
    stem.append(what).append("-").append(std::to_string(tick));
    std::string path = stem + ending;
    std::error_code ignored;
    for (int number = 2; std::filesystem::exists(path, ignored); ++number)
        path = stem + "-" + std::to_string(number) + ending;
    return path;
}

void report(Viewer& v, const std::string& what) {
    say(what);
    tell(v, printable(what));
}

void ask_for_picture(Show&, Viewer& v) { v.record.wants_picture = true; }
void ask_for_film(Show&, Viewer& v) { v.record.wants_film = true; }
void ask_for_turn(Show&, Viewer& v) { v.record.wants_turn = true; }
void open_record_room(Show&, Viewer& v) { v.room = v.room == Room::record ? Room::none : Room::record; }

}  // namespace flaneur
