#include <nlohmann/json.hpp>

#include "assets/camera_path.h"
#include "assets/files/file.h"
#include "assets/files/words.h"
#include "assets/look.h"

namespace flaneur {
namespace {

using Json = nlohmann::ordered_json;

constexpr size_t k_most_bytes = 4 << 20, k_most_depth = 8, k_most_values = 200'000;
constexpr double k_far = 1e6;  // metres

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
