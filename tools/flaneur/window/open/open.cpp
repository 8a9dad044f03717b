#include "tools/flaneur/window/open/open.h"

#include <chrono>
#include <filesystem>
#include <utility>

#include "tools/flaneur/console/console.h"
#include "tools/flaneur/load/load.h"
#include "tools/flaneur/window/open/complete.h"
#include "tools/flaneur/window/open/recent.h"
#include "tools/flaneur/window/panels.h"
#include "tools/flaneur/window/viewer.h"

namespace flaneur {
namespace {

void keep_in_mind(Opening& opening, const std::string& path) {
    if (path.empty()) return;
    // Another window may have opened files meanwhile.
    opening.recent = read_recent(recent_file());
    remember(opening.recent, path);
    keep_recent(recent_file(), opening.recent);
}

void wish(Viewer& v, Result<ShowWish> wish) {
    if (!wish) {
        say(wish.error().message);
        return tell(v, printable(wish.error().message));
    }
    v.opening.next = std::move(*wish);
    v.opening.prompt.is_open = v.opening.start.is_open = false;
}

// What was said of who and what is no longer there goes.
void begin_anew(Show& show, const Options& options, Viewer& v) {
    v.time.beside.reset();
    v.time.first_seed.reset();
    begin_run(v.time, *show.loaded.world);
    v.measure = {};
    v.watch = {};
    begin_cameras(options.scene, v);
    if (v.change.scene.limbs != options.scene.limbs) v.techniques.on.gait = options.techniques.gait;
    v.change = Change();
    start_changes(options, show, v);
    recall(show, v);
    v.hovered = v.selected = std::nullopt;
    v.clock.due = 0;
}

void show_next(Show& show, ShowWish wish, Result<PreparedShow> prepared, Viewer& v) {
    v.time.anew.reset();  // they are made of what is shown
    Result<void> done =
        prepared ? upload_show(show, *prepared, show.work_views) : Result<void>(prepared.error());
    if (!done) {
        clear_progress();
        say(done.error().message);
        return tell(v, printable(done.error().message));
    }
    end_film(v);
    end_presentation(v);
    begin_anew(show, wish.options, v);
    v.opening.words = std::move(wish.words);
    v.opening.name = city_name(wish.options.scene);
    keep_in_mind(v.opening, wish.file);
    say(wish.told);
    tell(v, printable(wish.told));
}

}  // namespace

void begin_opening(const Options& options, Opening& opening) {
    opening.words = options.words;
    opening.name = city_name(options.scene);
    opening.start.is_open = options.starts;
    opening.recent = read_recent(recent_file());
    const Scene& scene = options.scene;
    if (!scene.city.empty()) keep_in_mind(opening, full_path(scene.city));
}

void open_path(Viewer& v, const std::string& path) {
    wish(v, wish_for_file(v.opening.words, full_path(path)));
}
void open_scene(Viewer& v, const std::string& name) { wish(v, wish_for_scene(v.opening.words, name)); }
void open_course(Viewer& v, bool is_flat) {
    const Scene& scene = v.change.scene;
    wish(v, wish_for_course(v.opening.words, is_flat, scene.walkers, scene.seed));
}

void go_on_opening(Show& show, Viewer& v) {
    Opening& o = v.opening;
    // Of a hundred dropped files the last one is opened: looking into them all takes its time.
    if (!o.dropped.empty()) open_path(v, std::exchange(o.dropped, {}).back());
    if (o.under_way && o.loading.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
        Result<PreparedShow> prepared = o.loading.get();
        ShowWish loaded = std::move(*std::exchange(o.under_way, std::nullopt));
        const bool is_wanted = !std::exchange(o.is_unwanted, false) && !o.next;
        if (is_wanted) show_next(show, std::move(loaded), std::move(prepared), v);
        clear_progress();
    }
    if (!o.next || o.under_way) return;
    o.under_way = std::exchange(o.next, std::nullopt);
    o.loading =
        std::async(std::launch::async, [options = o.under_way->options] { return prepare_show(options); });
}

bool is_opening(const Opening& opening) { return opening.under_way.has_value(); }

bool give_up_opening(Opening& opening) {
    const bool was_wanted = (opening.under_way && !opening.is_unwanted) || opening.next;
    opening.is_unwanted = opening.under_way.has_value();
    opening.next.reset();
    return was_wanted;
}

}  // namespace flaneur
