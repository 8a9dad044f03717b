#include "tools/flaneur/view/path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "assets/files/file.h"
#include "assets/files/words.h"
#include "assets/look.h"
#include "sim/base/math.h"
#include "tools/flaneur/view/camera.h"
#include "tools/flaneur/view/rig.h"

namespace flaneur {
namespace {

using Json = nlohmann::ordered_json;

constexpr size_t k_most_bytes = 4 << 20, k_most_depth = 8, k_most_values = 200'000;
constexpr double k_far = 1e6;  // metres

// --- between keys

// From a to b in `span` seconds, leaving and arriving so fast; `share` of the time has gone by.
double cubic(double a, double b, double leaving, double arriving, double span, double share) {
    const double t = share, t2 = t * t, t3 = t2 * t;
    return (2 * t3 - 3 * t2 + 1) * a + (t3 - 2 * t2 + t) * span * leaving + (3 * t2 - 2 * t3) * b +
           (t3 - t2) * span * arriving;
}

// How fast a value passes a key between two others: Catmull and Rom's, or, so that nothing overshoots, at
// most three times the slower change about it, and not at all where it turns.
double passing(double before, double here, double after, double to_here, double from_here, bool is_monotone) {
    const double in = (here - before) / to_here, out = (after - here) / from_here;
    if (is_monotone && in * out <= 0) return 0;
    const double middle = (in * from_here + out * to_here) / (to_here + from_here);
    if (!is_monotone) return middle;
    const double most = 3 * std::min(std::fabs(in), std::fabs(out));
    return std::clamp(middle, -most, most);
}

// Long stretches beside short ones do not swing out: a place is passed so fast at most that it would take the
// longer stretch's time for three times the shorter one's length.
double most_passing(const CameraKey& before, const CameraKey& here, const CameraKey& after) {
    constexpr double k_swing = 3;
    const float shorter = std::min(length(here.eye - before.eye), length(after.eye - here.eye));
    return k_swing * static_cast<double>(shorter) / std::max(here.time - before.time, after.time - here.time);
}

constexpr size_t k_places = 3;  // values of a key: x, y, z; then heading, pitch, lens
using KeyValues = std::array<double, 6>;

// A speed among places.
void hold_back(KeyValues& speed, double most) {
    const double now = std::hypot(speed[0], speed[1], speed[2]);
    if (now <= most) return;
    for (size_t i = 0; i < k_places; ++i) speed[i] *= most / now;
}

// Headings go on from `before` the shorter way round.
KeyValues values_of(const CameraKey& key, double before) {
    Camera camera = make_camera(key.eye, key.target);
    const Gaze gaze = gaze_of(camera);
    const double yaw = before + static_cast<double>(wrap_angle(gaze.yaw - static_cast<float>(before)));
    return {static_cast<double>(key.eye.x),  static_cast<double>(key.eye.y),
            static_cast<double>(key.eye.z),  yaw,
            static_cast<double>(gaze.pitch), static_cast<double>(key.fov)};
}

Camera camera_of(const KeyValues& v) {
    auto f = [&](size_t i) { return static_cast<float>(v[i]); };
    return camera_of(Gaze{{f(0), f(1), f(2)}, f(3), f(4), f(5)});
}

// --- files

Error wrong(size_t key, const std::string& what) {
    return Error{"has a key " + std::to_string(key + 1) + " " + what};
}

Result<double> number_in(const Json& json, size_t key, const std::string& name, double low, double high) {
    if (json.is_number()) {
        const double value = json.get<double>();
        if (value >= low && value <= high) return value;
    }
    return wrong(key, "whose \"" + name + "\" is not a number from " + plainly(low) + " to " + plainly(high));
}

Result<Vec3> place_in(const Json& json, size_t key, const std::string& name) {
    if (!json.is_array() || json.size() != 3)
        return wrong(key, "whose \"" + name + "\" is not three numbers in metres, such as [0, 1.7, -20]");
    float values[3];
    for (size_t i = 0; i < 3; ++i) {
        Result<double> value = number_in(json[i], key, name, -k_far, k_far);
        if (!value) return value.error();
        values[i] = static_cast<float>(*value);
    }
    return Vec3{values[0], values[1], values[2]};
}

Result<CameraKey> key_in(const Json& json, size_t number, double before) {
    if (!json.is_object()) return wrong(number, "that is no object with time, eye and target");
    for (const auto& [name, value] : json.items())
        if (name != "time" && name != "eye" && name != "target" && name != "fov")
            return wrong(number, "with " + excerpt(name) +
                                     ", which is not known; there are time, eye, target and fov");
    for (const char* name : {"time", "eye", "target"})
        if (!json.contains(name)) return wrong(number, std::string("without \"") + name + "\"");
    CameraKey key;
    Result<double> time = number_in(json["time"], number, "time", 0, k_longest_path);
    if (!time) return time.error();
    if (!(*time > before))
        return wrong(number, "that is no later than the one before it; \"time\" grows from key to key");
    key.time = *time;
    Result<Vec3> eye = place_in(json["eye"], number, "eye");
    if (!eye) return eye.error();
    Result<Vec3> target = place_in(json["target"], number, "target");
    if (!target) return target.error();
    key.eye = *eye, key.target = *target;
    if (!(length(key.target - key.eye) > 1e-3f))
        return wrong(number, "that looks at where it stands; \"eye\" and \"target\" must differ");
    key.fov = k_fov;
    if (!json.contains("fov")) return key;
    Result<double> fov = number_in(json["fov"], number, "fov", k_least_fov, k_most_fov);
    if (!fov) return fov.error();
    key.fov = fov_of(*fov);
    return key;
}

}  // namespace

CameraKey key_of(const Camera& camera, double time) {
    return {time,
            {camera.eye.x, camera.eye.y, camera.eye.z},
            {camera.target.x, camera.target.y, camera.target.z},
            camera.vertical_fov};
}

double duration(const CameraPath& path) {
    return path.keys.empty() ? 0 : path.keys.back().time - path.keys.front().time;
}

Camera camera_at(const CameraPath& path, double seconds) {
    const std::vector<CameraKey>& keys = path.keys;
    auto rest = [](const CameraKey& key) {
        Camera camera = make_camera(key.eye, key.target);
        camera.vertical_fov = key.fov;
        return camera;
    };
    const double time = keys.front().time + seconds;
    if (time <= keys.front().time) return rest(keys.front());
    if (time >= keys.back().time) return rest(keys.back());
    const auto next =
        static_cast<size_t>(std::upper_bound(keys.begin(), keys.end(), time,
                                             [](double t, const CameraKey& key) { return t < key.time; }) -
                            keys.begin());
    // The keys about this stretch; beyond both ends of the path there are none.
    const size_t a = next - 1, b = next;
    const bool has_before = a > 0, has_after = b + 1 < keys.size();
    const KeyValues from = values_of(keys[a], 0), to = values_of(keys[b], from[k_places]);
    const KeyValues before = has_before ? values_of(keys[a - 1], from[k_places]) : from;
    const KeyValues after = has_after ? values_of(keys[b + 1], to[k_places]) : to;
    const double span = keys[b].time - keys[a].time;
    const double share = (time - keys[a].time) / span;
    KeyValues leaving{}, arriving{}, now;
    for (size_t i = 0; i < now.size(); ++i) {
        const bool is_monotone = i >= k_places;
        if (has_before)
            leaving[i] =
                passing(before[i], from[i], to[i], keys[a].time - keys[a - 1].time, span, is_monotone);
        if (has_after)
            arriving[i] =
                passing(from[i], to[i], after[i], span, keys[b + 1].time - keys[b].time, is_monotone);
    }
    if (has_before) hold_back(leaving, most_passing(keys[a - 1], keys[a], keys[b]));
    if (has_after) hold_back(arriving, most_passing(keys[a], keys[b], keys[b + 1]));
    for (size_t i = 0; i < now.size(); ++i)
        now[i] = cubic(from[i], to[i], leaving[i], arriving[i], span, share);
    return camera_of(now);
}

std::string path_text(const CameraPath& path) {
    auto place = [](Vec3 v) {
        std::string text("[");
        return text.append(plainly(v.x))
            .append(", ")
            .append(plainly(v.y))
            .append(", ")
            .append(plainly(v.z))
            .append("]");
    };
    std::string text = "{\n    \"keys\": [";
    for (size_t i = 0; i < path.keys.size(); ++i) {
        const CameraKey& key = path.keys[i];
        text.append(i == 0 ? "\n" : ",\n");
        text.append("        { \"time\": ").append(plainly(key.time));
        text.append(", \"eye\": ").append(place(key.eye));
        text.append(", \"target\": ").append(place(key.target));
        text.append(", \"fov\": ").append(told_fov(key.fov)).append(" }");
    }
    return text + "\n    ]\n}\n";
}

Result<CameraPath> parse_path(std::string_view text) {
    if (Result<void> sound = check_json(text, k_most_depth, k_most_values); !sound) return sound.error();
    const Json json = Json::parse(text, nullptr, false);
    if (json.is_discarded()) return Error{"is not JSON"};
    if (!json.is_object() || !json.contains("keys") || !json["keys"].is_array())
        return Error{
            R"(is no camera path, which is { "keys": [ { "time": 0, "eye": [0, 1.7, -20], "target": )"
            R"([0, 1.5, 0], "fov": 32 }, ... ] })"};
    for (const auto& [name, value] : json.items())
        if (name != "keys") return Error{"has " + excerpt(name) + ", which is not known; a path has keys"};
    const Json& keys = json["keys"];
    if (keys.empty()) return Error{"has no key"};
    if (keys.size() > k_most_keys) return Error{"has more than " + std::to_string(k_most_keys) + " keys"};
    CameraPath path;
    for (size_t i = 0; i < keys.size(); ++i) {
        Result<CameraKey> key = key_in(keys[i], i, i == 0 ? -1 : path.keys.back().time);
        if (!key) return key.error();
        path.keys.push_back(*key);
    }
    return path;
}

Result<CameraPath> load_path(const std::string& file) {
    const std::string subject = "The camera path " + excerpt(file) + " ";
    const Result<Bytes> bytes = read_bytes(file, k_most_bytes);
    if (!bytes) return Error{subject + bytes.error().message + "."};
    Result<CameraPath> path = parse_path({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
    if (!path) return Error{subject + path.error().message + "."};
    return path;
}

}  // namespace flaneur
