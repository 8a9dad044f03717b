// A scene as the text of a file.
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "assets/files/words.h"
#include "assets/scene.h"

namespace flaneur {

namespace {

using Json = nlohmann::ordered_json;

// A number with as many digits as tell it from other floats, and no more.
Json short_number(float value) { return Json::parse(plainly(value)); }

Json people_of(const std::vector<PeopleShare>& people) {
    Json list = Json::array();
    for (const PeopleShare& some : people) {
        Json one;
        if (some.character.empty())
            one["builtin"] = true;
        else
            one["character"] = some.character;
        one["share"] = short_number(some.share);
        list.push_back(one);
    }
    return list;
}

Json added_of(const std::vector<Addition>& added) {
    Json list = Json::array();
    for (const Addition& a : added) {
        Json one = {{"what", k_added_names[static_cast<size_t>(a.kind)]}, {"at", told_spot(a.at)}};
        if (is_drawn_out(a.kind)) one["to"] = told_spot(a.to);
        if (is_turned(a.kind) && a.turn != 0) one["turn"] = short_number(a.turn);
        list.push_back(one);
    }
    return list;
}

template <class Item>
Json texts_of(const std::vector<Item>& items, std::string (*told)(const Item&)) {
    Json list = Json::array();
    for (const Item& item : items) list.push_back(told(item));
    return list;
}

}  // namespace

std::string told_time(float hour) {
    const int minutes = static_cast<int>(std::floor(hour * 60 + 0.5f)) % (24 * 60);
    char text[16];
    std::snprintf(text, sizeof text, "%02d:%02d", minutes / 60, minutes % 60);
    return text;
}

std::string scene_text(const Scene& s) {
    const Scene usual;
    Json json = Json::object();
    auto tell = [&](const char* key, const Json& value, bool is_told) {
        if (is_told) json[key] = value;
    };
    tell("about", s.about, !s.about.empty());
    tell("city", s.city, !s.city.empty());
    if (s.center) json["center"] = plainly(s.center->latitude) + "," + plainly(s.center->longitude);
    tell("radius", short_number(s.radius), s.radius > 0);
    tell("built", k_built_in_names[static_cast<int>(s.built)], s.built != usual.built);
    tell("platform", told_corners(s.platform), !s.platform.empty());
    tell("rock", s.rock, !s.rock.empty());
    tell("terrain", s.terrain, !s.terrain.empty());
    tell("scale", short_number(s.scale), s.scale != usual.scale);
    tell("blocks", s.blocks, is_of(s, BuiltIn::district));
    tell("trams", s.trams, s.trams);
    tell("seed", s.seed, s.seed != usual.seed);
    json["walkers"] = s.walkers;
    tell("creatures", s.creatures, s.creatures > 0);
    tell("habit", k_habit_names[static_cast<int>(s.habit)], s.habit != usual.habit);
    tell("limbs", k_limb_lead_names[static_cast<int>(s.limbs)], s.limbs != usual.limbs);
    tell("drunk", short_number(s.drunk), s.drunk > 0);
    tell("drunks", s.drunks, s.drunks > 0);
    tell("steppers", s.steppers, s.steppers > 0);
    tell("steppers_way", told_corners(s.steppers_way), !s.steppers_way.empty());
    tell("flat", s.flat, s.flat);
    if (s.look) json["look"] = told_spot(*s.look);
    tell("people", people_of(s.people), !s.people.empty());
    for (const MixKey& of : k_mix)
        tell(of.name, short_number(s.mix.*of.times), s.mix.*of.times != usual.mix.*of.times);
    tell("added", added_of(s.added), !s.added.empty());
    tell("pushes", texts_of(s.pushes, told_push), !s.pushes.empty());
    tell("balls", texts_of(s.balls, told_throw), !s.balls.empty());
    tell("helpers", short_number(s.helpers), s.helpers != usual.helpers);
    tell("lamps", s.lamps, s.lamps);
    tell("jaywalkers", short_number(s.jaywalkers), s.jaywalkers != usual.jaywalkers);
    tell("acquaintances", short_number(s.acquaintances), s.acquaintances > 0);
    if (s.groups != usual.groups) {
        const char* sizes[] = {"1", "2", "3", "4"};
        for (size_t k = 0; k < s.groups.size(); ++k) json["groups"][sizes[k]] = short_number(s.groups[k]);
    }
    const AlongShares& along = s.along;
    tell("dogs", short_number(along.dogs), along.dogs > 0);
    tell("wheelchairs", short_number(along.wheelchairs), along.wheelchairs > 0);
    tell("white_canes", short_number(along.white_canes), along.white_canes > 0);
    tell("umbrellas", short_number(along.umbrellas), along.umbrellas > 0);
    tell("musicians", along.musicians, along.musicians > 0);
    for (const PastimeKey& of : k_pastimes)
        tell(of.name, short_number(s.pastimes.*of.share), s.pastimes.*of.share > 0);
    tell("traffic", short_number(s.traffic), s.traffic != usual.traffic);
    tell("idles", s.idles, !s.idles.empty());
    json["time"] = told_time(s.hour);
    if (s.sun_height) json["sun_height"] = short_number(*s.sun_height);
    if (s.sun_heading) json["sun_heading"] = short_number(*s.sun_heading);
    tell("weather", "overcast", s.is_overcast);
    if (s.side) json["side"] = *s.side == PassOn::right ? "right" : "left";
    tell("coming", false, s.stays);
    tell("demand", s.demand, !s.demand.empty());
    if (s.reading == TrajectoryReading{} && s.entering == Entering::fade) {
        tell("trajectories", s.trajectories, is_recorded(s));
    } else {
        Json& to = json["trajectories"];
        to["file"] = s.trajectories;
        if (s.reading.fps > 0) to["fps"] = short_number(s.reading.fps);
        if (s.reading.unit > 0) to["unit"] = short_number(s.reading.unit);
        if (s.reading.up != 0) to["up"] = std::string(1, s.reading.up);
        if (s.reading.origin)
            to["origin"] = plainly(s.reading.origin->x) + "," + plainly(s.reading.origin->z);
        if (!s.reading.geometry.empty()) to["geometry"] = s.reading.geometry;
        if (s.entering != Entering::fade) to["enter"] = k_entering_names[static_cast<int>(s.entering)];
    }
    json["camera"] = told_camera(s.camera);
    tell("fov", Json::parse(told_fov(s.fov)), s.fov > 0);
    tell("size", std::to_string(s.size.width) + "x" + std::to_string(s.size.height), s.size != usual.size);
    tell("quality", s.quality, !s.quality.empty());
    tell("view", names_of(s.views), s.views != usual.views);
    return json.dump(4, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace flaneur
