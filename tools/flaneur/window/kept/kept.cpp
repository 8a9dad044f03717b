#include "tools/flaneur/window/kept/kept.h"

#include <imgui.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "assets/files/file.h"
#include "assets/files/words.h"
#include "sim/base/hash.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/output/measures.h"
#include "tools/flaneur/window/open/complete.h"
#include "tools/flaneur/window/panels.h"
#include "tools/flaneur/window/viewer.h"

namespace flaneur {
namespace {

using Json = nlohmann::ordered_json;

constexpr size_t k_most_bytes = 1 << 20, k_depth = 6, k_values = 50'000;
constexpr size_t k_longest_name = 63;

std::string hash_text(const Scene& scene) {
    const std::string text = scene_text(scene);
    char hex[17];
    std::snprintf(hex, sizeof hex, "%016llx",
                  static_cast<unsigned long long>(hash_bytes(0, text.data(), text.size())));
    return hex;
}

std::string full(const std::string& path) { return path.empty() ? path : full_path(path); }

// A scene with nothing but its city.
Scene city_of(const Scene& scene) {
    Scene s;
    s.city = full(scene.city), s.terrain = full(scene.terrain);
    s.center = scene.center, s.radius = scene.radius, s.scale = scene.scale;
    s.built = scene.built, s.platform = scene.platform, s.blocks = scene.blocks;
    s.rock = scene.rock == k_torus ? scene.rock : full(scene.rock);
    return s;
}

Json told_view(const CameraChoice& choice, float fov) {
    Json json;
    json["camera"] = told_camera(choice);
    if (fov > 0) json["fov"] = Json::parse(told_fov(fov));
    return json;
}

Result<void> read_view(const Json& json, CameraChoice& choice, float& fov) {
    const auto camera = json.find("camera");
    if (camera == json.end() || !camera->is_string()) return Error{"has no camera where one is needed"};
    Result<CameraChoice> parsed = parse_camera(camera->get<std::string>());
    if (!parsed) return Error{"has a camera " + excerpt(camera->get<std::string>()) + " that is none"};
    choice = *parsed;
    const auto lens = json.find("fov");
    if (lens == json.end()) return {};
    const double degrees = lens->is_number() ? lens->get<double>() : -1;
    if (!(degrees >= 1 && degrees <= 150)) return Error{"has a field of view that is not 1 to 150"};
    fov = fov_of(degrees);
    return {};
}

std::string name_in(const Json& json) {
    const auto name = json.find("name");
    if (name == json.end() || !name->is_string()) return {};
    return printable(name->get<std::string>()).substr(0, k_longest_name);
}

// A whole number of these; others are none.
std::optional<uint32_t> number_in(const Json& json, const char* key, uint32_t least, uint32_t most) {
    const auto at = json.find(key);
    if (at == json.end() || !at->is_number_unsigned()) return {};
    const auto number = at->get<uint64_t>();
    if (number < least || number > most) return {};
    return static_cast<uint32_t>(number);
}

Result<void> read_bookmark(const Json& json, Kept& kept) {
    const auto number = number_in(json, "number", 1, k_bookmarks);
    if (!number) return Error{"has a bookmark whose number is not 1 to 9"};
    Bookmark& bookmark = kept.bookmarks[*number - 1].emplace();
    std::snprintf(bookmark.name, sizeof bookmark.name, "%s", name_in(json).c_str());
    return read_view(json, bookmark.choice, bookmark.fov);
}

Result<void> read_run(const Json& json, Kept& kept) {
    const auto run = json.find("run"), marks = json.find("marks");
    if (run == json.end() || !run->is_string() || marks == json.end() || !marks->is_array())
        return Error{"has a run without a name or without marks"};
    KeptRun& one = kept.runs.emplace_back(KeptRun{run->get<std::string>(), {}});
    for (const Json& each : *marks) {
        const auto tick = number_in(each, "tick", 0, ~0u - 1);
        if (!tick) return Error{"has a mark without a tick"};
        Mark& mark = one.marks.emplace_back(Mark{*tick, name_in(each), {}, 0});
        if (Result<void> done = read_view(each, mark.choice, mark.fov); !done) return done;
    }
    std::ranges::stable_sort(one.marks, {}, &Mark::tick);
    return {};
}

Result<void> read_all(const Json& json, const char* key, Result<void> (*read)(const Json&, Kept&),
                      Kept& kept) {
    const auto all = json.find(key);
    if (all == json.end()) return {};
    if (!all->is_array()) return Error{std::string("has no list of ") + key};
    for (const Json& each : *all) {
        if (!each.is_object()) return Error{std::string("has no objects in its ") + key};
        if (Result<void> done = read(each, kept); !done) return done;
    }
    return {};
}

// What is shown now, as it is to be kept; marks only of what can be opened again.
Kept shown_now(const Viewer& v) {
    Kept now;
    now.bookmarks = v.cameras.bookmarks;
    if (is_as_opened(v.change)) now.runs.push_back({v.keeping.run, v.time.marks});
    return now;
}

// The run of `now` in place of what `kept` has of it.
void put_first(Kept& kept, const Kept& now) {
    kept.bookmarks = now.bookmarks;
    if (now.runs.empty()) return;
    std::erase_if(kept.runs, [&](const KeptRun& run) { return run.run == now.runs[0].run; });
    if (now.runs[0].marks.empty()) return;
    kept.runs.insert(kept.runs.begin(), now.runs[0]);
    if (kept.runs.size() > k_most_runs) kept.runs.resize(k_most_runs);
    std::vector<Mark>& marks = kept.runs[0].marks;
    if (marks.size() > k_most_marks) marks.resize(k_most_marks);
}

Kept read_or_tell(const std::string& file, Viewer& v) {
    Result<Kept> kept = read_kept(file);
    if (kept) return std::move(*kept);
    say(kept.error().message);
    tell(v, printable(kept.error().message));
    return {};
}

void take_marks(Kept kept, const Show& show, Viewer& v) {
    Keeping& keeping = v.keeping;
    keeping.run = run_name(v.change.scene, show.loaded.world->seed);
    v.time.marks.clear();
    if (is_as_opened(v.change))
        for (KeptRun& run : kept.runs)
            if (run.run == keeping.run) v.time.marks = std::move(run.marks);
    keeping.last = shown_now(v);
}

}  // namespace

std::string kept_file(const Scene& scene) {
    const std::string folder = user_folder("XDG_STATE_HOME", ".local/state");
    return folder.empty() ? "" : folder + "/scenes/" + hash_text(city_of(scene)) + ".json";
}

std::string run_name(const Scene& scene, uint64_t seed) {
    Scene s = city_of(scene);
    s.people = scene.people, s.mix = scene.mix, s.added = scene.added, s.idles = scene.idles;
    s.stays = scene.stays, s.demand = scene.demand;
    s.walkers = scene.walkers, s.hour = scene.hour;
    s.seed = seed;
    return hash_text(s);
}

Result<Kept> parse_kept(std::string_view text) {
    if (Result<void> checked = check_json(text, k_depth, k_values); !checked) return checked.error();
    const Json json = Json::parse(text, nullptr, false);
    if (!json.is_object()) return Error{"is no JSON object"};
    Kept kept;
    if (Result<void> done = read_all(json, "bookmarks", read_bookmark, kept); !done) return done.error();
    if (Result<void> done = read_all(json, "runs", read_run, kept); !done) return done.error();
    return kept;
}

std::string told(const Kept& kept) {
    Json json = {{"bookmarks", Json::array()}, {"runs", Json::array()}};
    for (size_t i = 0; i < k_bookmarks; ++i) {
        if (!kept.bookmarks[i]) continue;
        Json bookmark = {{"number", i + 1}, {"name", kept.bookmarks[i]->name}};
        bookmark.update(told_view(kept.bookmarks[i]->choice, kept.bookmarks[i]->fov));
        json["bookmarks"].push_back(std::move(bookmark));
    }
    for (const KeptRun& run : kept.runs) {
        Json marks = Json::array();
        for (const Mark& mark : run.marks) {
            Json one = {{"tick", mark.tick}, {"name", mark.name}};
            one.update(told_view(mark.choice, mark.fov));
            marks.push_back(std::move(one));
        }
        json["runs"].push_back({{"run", run.run}, {"marks", std::move(marks)}});
    }
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<Kept> read_kept(const std::string& file) {
    std::error_code unknown;
    if (file.empty() || !std::filesystem::exists(file, unknown)) return Kept();
    return read_parsed(file, k_most_bytes, parse_kept, "Bookmarks and marks are not there");
}

void recall(const Show& show, Viewer& v) {
    v.keeping.file = kept_file(v.change.scene);
    Kept kept = read_or_tell(v.keeping.file, v);
    v.cameras.bookmarks = kept.bookmarks;
    take_marks(std::move(kept), show, v);
}

void recall_marks(const Show& show, Viewer& v) {
    Result<Kept> kept = read_kept(v.keeping.file);
    take_marks(kept ? std::move(*kept) : Kept(), show, v);  // what is wrong was told
}

void keep_what_is_kept(Viewer& v) {
    Keeping& keeping = v.keeping;
    if (keeping.file.empty() || ImGui::IsAnyItemActive()) return;
    Kept now = shown_now(v);
    if (now == keeping.last) return;
    Result<Kept> all = read_kept(keeping.file);  // another window may have written it
    if (!all) all = Kept();
    put_first(*all, now);
    keeping.last = std::move(now);
    if (Result<void> done = write_file(keeping.file, told(*all)); !done)
        tell(v, printable(done.error().message));
}

}  // namespace flaneur
