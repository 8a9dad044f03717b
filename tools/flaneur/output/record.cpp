#include "tools/flaneur/output/record.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "assets/files/words.h"

namespace flaneur {

namespace {

using Json = nlohmann::ordered_json;

// With the height and the heading that the scene gives the sun, if it does.
std::string told_time(const Scene& scene) {
    const long minutes = std::lround(scene.hour * 60);
    char time[32];
    std::snprintf(time, sizeof time, "%02ld:%02ld", minutes / 60, minutes % 60);
    std::string text = time;
    if (scene.sun_height || scene.sun_heading) text += ", the scene's sun";
    if (scene.sun_height) text += " at " + plainly(*scene.sun_height);
    if (scene.sun_heading) text += " heading " + plainly(*scene.sun_heading);
    return text;
}

std::string told_file(const std::string& path) {
    std::error_code unknown;
    auto bytes = std::filesystem::file_size(path, unknown);
    return std::filesystem::path(path).filename().string() +
           (unknown ? "" : " of " + std::to_string(bytes) + " bytes");
}

std::string told_people(const std::vector<PeopleShare>& people) {
    std::vector<std::string> all;
    all.reserve(people.size());
    for (const PeopleShare& some : people)
        all.push_back((some.character.empty() ? "builtin" : told_file(some.character)) + ":" +
                      plainly(some.share));
    return joined(all);
}

std::string told_idles(const std::vector<std::string>& idles) {
    std::vector<std::string> all;
    all.reserve(idles.size());
    for (const std::string& idle : idles) all.push_back(told_file(idle));
    return joined(all);
}

Json parsed(const std::string& record) {
    Json json = Json::parse(record, nullptr, false);
    return json.is_object() ? json : Json::object();
}

// "--seed 1", or "no --view".
std::string told(const std::string& option, const Json& record) {
    auto at = record.find(option);
    if (at == record.end() || !at->is_string() || at->get_ref<const std::string&>().empty())
        return "no " + option;
    return option + " " + at->get<std::string>();
}

}  // namespace

std::string record_of(const Options& options) {
    const Scene& s = options.scene;
    const TickRange& t = options.ticks;
    Json record;
    auto put = [&](const char* option, std::string value) {
        if (!value.empty()) record[option] = std::move(value);
    };
    put("flaneur", FLANEUR_VERSION);
    put("--scene", s.name);
    put("--replay", options.replay.empty() ? "" : told_file(options.replay));
    put("--city", s.city.empty() ? "" : told_file(s.city));
    put("--terrain", s.terrain.empty() ? "" : told_file(s.terrain));
    put("--center", s.center ? plainly(s.center->latitude) + "," + plainly(s.center->longitude) : "");
    put("--radius", s.radius > 0 ? plainly(s.radius) : "");
    put("--scale", s.scale != 1 ? plainly(s.scale) : "");
    put("blocks", is_of(s, BuiltIn::district) ? std::to_string(s.blocks) : "");
    put("--walkers", std::to_string(s.walkers));
    put("--seed", std::to_string(s.seed));
    put("--character", told_people(s.people));
    for (const MixKey& of : k_mix) put(of.name, s.mix.*of.times == 1 ? "" : plainly(s.mix.*of.times));
    put("--force", options.force ? "yes" : "");
    put("--idle", told_idles(s.idles));
    put("--time", told_time(s));
    put("--weather", s.is_overcast ? "overcast" : "clear");
    if (s.side) put("--side", *s.side == PassOn::right ? "right" : "left");
    put("--stay", s.stays ? "yes" : "");
    put("--demand", s.demand.empty() ? "" : told_file(s.demand));
    if (options.lod > 0) put("--lod", plainly(options.lod));
    if (options.camera_path.empty())
        put("--camera", told_camera(s.camera));
    else
        put("--camera-path", told_file(options.camera_path));
    put("--fov", s.fov > 0 ? told_fov(s.fov) : "");
    put("--size", std::to_string(s.size.width) + "x" + std::to_string(s.size.height));
    put("--quality", s.quality);
    put("--transparent", options.is_transparent ? "yes" : "");
    put("--without", told_without(options.techniques, options.scene.limbs));
    put("--view", joined(names_of(s.views)));
    put("--frames", "from " + std::to_string(t.first) + " by " + std::to_string(t.step));
    return record.dump(-1, ' ', true, Json::error_handler_t::replace);
}

Result<void> check_record(const std::string& path, const std::string& begun, const std::string& now) {
    const std::string refused = "Cannot go on with " + path + ": it ";
    const Json was = parsed(begun), is = parsed(now);
    if (was.empty())
        return Error{refused +
                     "does not say which command began it; give another --out, or draw it anew "
                     "without --resume."};
    Json options = is;
    options.update(was);
    std::vector<std::string> before, after;
    for (const auto& [option, value] : options.items()) {
        if (was.contains(option) && is.contains(option) && was[option] == is[option]) continue;
        before.push_back(told(option, was));
        after.push_back(told(option, is));
    }
    if (before.empty()) return {};
    return Error{refused + "was begun with " + joined(before) + ", not " + joined(after) + "."};
}

}  // namespace flaneur
