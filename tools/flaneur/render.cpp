#include <algorithm>
#include <cmath>
#include <utility>

#include "assets/files/file.h"
#include "sim/base/tick.h"
#include "sim/base/zone.h"
#include "tools/flaneur/commands.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/console/ending.h"
#include "tools/flaneur/output/output.h"
#include "tools/flaneur/output/parts.h"
#include "tools/flaneur/output/record.h"
#include "tools/flaneur/recording/check.h"
#include "tools/flaneur/view/camera.h"
#include "tools/flaneur/view/ids.h"
#include "tools/flaneur/view/path.h"
#include "tools/flaneur/view/rig.h"
#include "tools/flaneur/view/show.h"

namespace flaneur {

namespace {

// Seconds that ffmpeg may take to finish what it was given.
constexpr double k_film_patience = 30;

// Of a recording of which each tick is drawn: so many ticks before a part, what drags behind bodies is on its
// way, so that it has come to the same as in a film from the first tick on; the lag of k_trail keeps nothing
// of so long ago.
constexpr uint32_t k_settled = 300;
// What the view `trails` shows is as long as this.
constexpr uint32_t k_trailed_ticks = k_trail_places * k_trail_ticks;

std::string told_shard(Shard shard) {
    return "part " + std::to_string(shard.number) + " of " + std::to_string(shard.of);
}

// What there is of the pictures when it is time to stop: a film is finished with those that it has.
Error stopped(const Options& options, Output& output, uint32_t drawn) {
    if (!is_whole(options.shard))
        return interrupted(told_shard(options.shard) + " of " + options.out +
                           " is not done; the same command goes on");
    const TickRange& ticks = options.ticks;
    while (drawn < count(ticks) && is_written(output, drawn, ticks.first + drawn * ticks.step)) ++drawn;
    if (drawn == 0) return interrupted(options.out + " is not done");
    Result<void> finished = finish_output(output);
    if (!finished) return finished.error();
    return interrupted(options.out + " has the first " + std::to_string(drawn) + " of " +
                       std::to_string(count(ticks)) + " pictures; --resume goes on");
}

// One that was chosen may be wanted again, at another time or tick.
void say_camera(const CameraChoice& choice, const Camera& camera) {
    using enum CameraChoice::Kind;
    if (choice.kind != street && choice.kind != overview && choice.kind != crowd) return;
    const CameraKey seen = key_of(camera, 0);
    const std::string lens = seen.fov == k_fov ? "" : std::string(" --fov ").append(told_fov(seen.fov));
    say("Seen from --camera " + told_camera({fixed, 0, seen.eye, seen.target}) + lens);
}

Result<ChannelFiles> open_channels_of(const Options& options, uint32_t tick) {
    return open_channels(picture_path(options.depth, tick), picture_path(options.ids, tick));
}

// One file would be written again and again.
Result<void> check_channels(const Options& options) {
    for (const auto& [name, path] :
         {std::pair("--depth ", &options.depth), std::pair("--ids ", &options.ids)})
        if (!path->empty() && count(options.ticks) > 1 && picture_path(*path, 0) == *path)
            return Error{name + *path + " is of one picture, and there are " +
                         std::to_string(count(options.ticks)) +
                         ": number it, as in DIR/%05d.png, or give one tick, such as --frames 600."};
    return {};
}

// Where RenderDoc's capture goes: beside the picture; a film has none for each tick, so that a number is
// added.
std::string capture_path(const std::string& out, uint32_t tick) {
    const std::string picture = picture_path(out, tick);
    std::string path = picture.substr(0, picture.size() - 4);
    if (has_ending(out, ".mp4")) path.append("-").append(std::to_string(tick));
    return path + ".rdc";
}

// As --frames says it.
std::string told_ticks(const TickRange& ticks) {
    std::string told = std::to_string(ticks.first);
    if (ticks.last != ticks.first) told.append(":").append(std::to_string(ticks.last));
    if (ticks.step != 1) told.append(":").append(std::to_string(ticks.step));
    return told;
}

Result<void> check_capture(const Options& options) {
    if (!options.captures) return {};
    const TickRange& ticks = options.ticks;
    const uint32_t tick = options.captured;
    if (tick < ticks.first || tick > ticks.last || (tick - ticks.first) % ticks.step != 0)
        return Error{"--capture " + std::to_string(tick) + " is of no picture that is drawn: --frames has " +
                     told_ticks(ticks) + "."};
    if (is_stream(options.out))
        return Error{"--capture goes beside the picture, and --out " + options.out +
                     " is no file: give a FILE.png."};
    return {};
}

// With RenderDoc's capture of it, unless there is no place for that.
Result<Image> draw_picture(Renderer& renderer, const FrameInput& frame, Size size,
                           const std::string& capture) {
    const auto width = static_cast<uint32_t>(size.width), height = static_cast<uint32_t>(size.height);
    if (capture.empty()) return draw_image(renderer, frame, width, height);
    if (Result<void> begun = begin_capture(renderer); !begun) return begun.error();
    Result<Image> image = draw_image(renderer, frame, width, height);
    const Result<std::string> written = end_capture(renderer, capture);
    if (!image) return image;
    if (!written) return written.error();
    say("Captured " + *written + ", which qrenderdoc opens");
    return image;
}

void say_left(const World& world, uint32_t walker) {
    char text[128];
    std::snprintf(text, sizeof text,
                  "Walker %u, whom the camera goes along with, left at tick %u: it stays where it is. With "
                  "--stay nobody leaves",
                  walker, world.tick);
    say(text);
}

// The tick to go to at once, of a recording, before the picture of `tick`: that one, or where what leads up
// to it begins.
uint32_t straight_to(const Show& show, const TickRange& ticks, uint32_t tick, bool is_first_of_part) {
    if (!is_first_of_part || ticks.step > 1) return tick;
    const uint32_t before = show.work_views[WorkView::trails] ? k_trailed_ticks : k_settled;
    return std::max(ticks.first, tick - std::min(tick, before));
}

std::string told_end(const Options& options, uint32_t pictures, bool is_new) {
    const std::string one = picture_path(options.out, options.ticks.first);
    std::string out = count(options.ticks) == 1 && is_whole(options.shard) ? one : options.out;
    if (!is_whole(options.shard))
        out = told_shard(options.shard) + " of " + out + ", " + std::to_string(pictures) + " pictures";
    return is_new ? "Wrote " + out : out + " has them already: nothing was drawn";
}

// `part`: which pictures of all. `channels`: those of its first tick.
Result<void> draw_all(Show& show, const Options& options, const CameraPath& path, PictureSpan part,
                      Output& output, ChannelFiles channels) {
    World& world = *show.loaded.world;
    const TickRange& ticks = options.ticks;
    const uint32_t pictures = part.beyond - part.first;
    const CameraChoice& choice = options.scene.camera;
    Camera camera;
    CameraRig rig;
    advance(rig, world, choice);
    if (!path.keys.empty())
        camera = camera_at(path, 0);
    else if (show.lod > 0)
        camera = choose_camera(show, choice, options.scene.fov, options.scene.size, 1);
    bool is_new = false;
    for (uint32_t i = 0; i < part.beyond; ++i) {
        FLANEUR_ZONE("frame");
        uint32_t tick = ticks.first + i * ticks.step;
        // What is before a part: the first tick, by which a camera is chosen; and where people go by where
        // they are looked at from, every one.
        if (i > 0 && i < part.first && show.lod == 0) continue;
        // Who is gone along with is gone along with from the start on.
        if (show.playing && !goes_along(choice.kind) && world.tick + 1 < tick)
            if (const uint32_t to = straight_to(show, ticks, tick, i == part.first); world.tick < to)
                if (Result<void> shown = go_straight(show, to); !shown) return shown;
        while (world.tick < tick && !is_stopping()) {
            if (i == 0 && world.tick % 60 == 0)
                show_progress("simulating, tick " + std::to_string(world.tick));
            look_from(show, camera);
            step(show);
            if (show.playing && show.playing->failed) return *show.playing->failed;
            const bool was_left = rig.is_left;
            advance(rig, world, choice);
            if (rig.is_left && !was_left) say_left(world, choice.walker);
        }
        if (is_stopping()) return stopped(options, output, i);
        if (world.tick > tick)
            return Error{"There is no tick " + std::to_string(tick) + ": the recording begins at " +
                         std::to_string(world.tick) + "."};
        if (!path.keys.empty()) {
            camera = camera_at(path, static_cast<double>(tick - ticks.first) / k_ticks_a_second);
        } else if (goes_along(choice.kind)) {
            camera = camera_of(rig, options.scene.fov, 1);
        } else if (i == 0) {
            FLANEUR_ZONE("choose a camera");
            camera = choose_camera(show, choice, options.scene.fov, options.scene.size, 1);
        }
        if (i == 0 && path.keys.empty()) say_camera(choice, camera);
        if (i < part.first || is_written(output, i, tick)) continue;
        is_new = true;
        show_progress("picture " + std::to_string(i - part.first + 1) + " of " + std::to_string(pictures));
        FrameInput frame = extract_frame(show, camera, options.scene.size, 1);
        if (path.keys.empty()) frame.companion = companion_of(choice);
        if (i > part.first) {
            Result<ChannelFiles> opened = open_channels_of(options, tick);
            if (!opened) return opened.error();
            channels = std::move(*opened);
        }
        frame.wants_depths = options.is_transparent || channels.depths;
        frame.wants_ids = channels.ids != nullptr;
        const bool is_captured = options.captures && tick == options.captured;
        Result<Image> image = draw_picture(*show.renderer, frame, options.scene.size,
                                           is_captured ? capture_path(options.out, tick) : "");
        if (!image) return image.error();
        FLANEUR_ZONE("write");
        // Before the picture, which tells --resume that it is done.
        Result<void> written = write_channels(std::exchange(channels, {}), *image, *show.loaded.city);
        if (written)
            written =
                write_image(output, image->rgba, tick, options.is_transparent ? Alpha::kept : Alpha::dropped);
        if (!written) return written;
        if (has_ending(options.out, ".mp4")) be_patient(k_film_patience);
    }
    Result<void> finished = finish_output(output);
    clear_progress();
    if (finished) say(told_end(options, pictures, is_new));
    return finished;
}

// All of a recording, where no ticks were asked for; of one picture the last, of trajectories the middle.
// Those are read for that, and kept for who loads them.
Result<TickRange> recorded_ticks(Options& options) {
    if (options.has_ticks) return options.ticks;
    const bool is_one = has_ending(options.out, ".png") && picture_path(options.out, 0) == options.out;
    if (is_recorded(options.scene)) {
        Result<std::shared_ptr<const Trajectories>> read = read_recorded(options.scene);
        if (!read) return read.error();
        options.recorded = std::move(*read);
        const uint32_t last = last_tick_of(*options.recorded);
        return is_one ? TickRange{last / 2, last / 2, 1} : TickRange{0, last, 2};
    }
    if (options.replay.empty()) return options.ticks;
    const Result<PlayingPtr> playing = open_playing(options.replay, 1);
    if (!playing) return playing.error();
    const uint32_t first = (*playing)->first, last = (*playing)->last;
    return is_one ? TickRange{last, last, 1} : TickRange{first, last, 2};
}

// All of a path, where no ticks were asked for.
TickRange ticks_of(const Options& options, const CameraPath& path) {
    TickRange ticks = options.ticks;
    if (options.camera_path.empty() || options.has_ticks) return ticks;
    ticks.last = ticks.first + static_cast<uint32_t>(std::ceil(duration(path) * k_ticks_a_second));
    return ticks;
}

// Null where there are more parts than pictures, and none for this one.
Result<OutputPtr> open_part(const Options& options, PictureSpan part) {
    const TickRange& all = options.ticks;
    const std::string record = record_of(options);
    if (is_whole(options.shard))
        return open_output(options.out, options.scene.size, all, record, options.resume);
    const Result<std::string> out = begin_parts(options.out, options.scene.size, all, record);
    if (!out) return out.error();
    if (part.first == part.beyond) {
        say(told_shard(options.shard) + " of " + options.out + " has no pictures");
        return OutputPtr();
    }
    const TickRange ticks{all.first + part.first * all.step, all.first + (part.beyond - 1) * all.step,
                          all.step};
    return open_output(*out, options.scene.size, ticks, record, true);
}

Result<void> render(const Options& asked, std::atomic<uint32_t>& messages) {
    if (Result<void> found = find_files(asked.scene); !found) return found;
    if (Result<void> allowed = check_record(asked); !allowed) return allowed;
    Options options = asked;
    CameraPath path;
    if (!options.camera_path.empty()) {
        Result<CameraPath> loaded = load_path(options.camera_path);
        if (!loaded) return loaded.error();
        path = std::move(*loaded);
        options.ticks = ticks_of(options, path);
    }
    const Result<TickRange> recorded = recorded_ticks(options);
    if (!recorded) return recorded.error();
    options.ticks = *recorded;
    if (Result<void> checked = check_channels(options); !checked) return checked;
    if (Result<void> checked = check_capture(options); !checked) return checked;
    const PictureSpan part = pictures_of(options.shard, count(options.ticks));
    Result<OutputPtr> output = open_part(options, part);
    if (!output) return output.error();
    if (!*output) return {};
    Result<ChannelFiles> channels =
        open_channels_of(options, options.ticks.first + part.first * options.ticks.step);
    if (!channels) return channels.error();
    Result<RendererPtr> renderer = make_renderer(renderer_options(options, messages));
    if (!renderer) return renderer.error();
    Result<Show> show = make_show(std::move(*renderer), options);
    if (!show) return show.error();
    options.recorded.reset();
    Result<TakingPtr> taking = begin_taking(options, *show->loaded.world);
    if (!taking) return taking.error();
    show->taking = std::move(*taking);
    Result<void> drawn = draw_all(*show, options, path, part, **output, std::move(*channels));
    clear_progress();
    Result<void> recorded_too = finish_taking(std::move(show->taking));
    return drawn ? recorded_too : drawn;
}

}  // namespace

Result<void> run_render(const Options& options) {
    std::atomic<uint32_t> messages = 0;
    Result<void> done = render(options, messages);
    return done ? check_messages(messages) : done;
}

}  // namespace flaneur
