#include "assets/recording/head.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "assets/recording/container.h"
#include "assets/recording/container_form.h"

namespace flaneur {

using Json = nlohmann::ordered_json;

std::string recording_head(const RecordingHead& head) {
    Json json;
    json["flaneur"] = head.program;
    json["as"] = head.as == RecordedAs::inputs ? "inputs" : "motion";
    json["first"] = head.first;
    json["error"] = head.error;
    json["force"] = head.force;
    json["name"] = head.scene_name;
    json["scene"] = Json::parse(head.scene);
    return json.dump(2) + "\n";
}

Result<RecordingHead> parse_recording_head(const std::string& path, std::string_view text) {
    const Json json = Json::parse(text, nullptr, false);
    RecordingHead head;
    try {
        const std::string as = json.at("as").get<std::string>();
        if (as != "motion" && as != "inputs")
            return Error{path + " is recorded as " + as +
                         ", which this flaneur does not know: a later one does."};
        head.as = as == "inputs" ? RecordedAs::inputs : RecordedAs::motion;
        head.program = json.at("flaneur").get<std::string>();
        head.first = json.at("first").get<uint32_t>();
        head.error = json.at("error").get<float>();
        head.force = json.at("force").get<bool>();
        head.scene_name = json.at("name").get<std::string>();
        head.scene = json.at("scene").dump(2);
    } catch (const Json::exception&) {
        return Error{path +
                     " is a recording that does not tell its scene, as those of --record do: it cannot "
                     "be shown by itself."};
    }
    return head;
}

bool looks_recorded(const std::string& path) {
    std::string begins(k_recording_magic.size(), 0);
    return std::ifstream(path, std::ios::binary).read(begins.data(), std::ssize(begins)) &&
           begins == k_recording_magic;
}

Result<RecordingHead> read_recording_head(const std::string& path) {
    const Result<RecordingPtr> recording = open_recording(path);
    if (!recording) return recording.error();
    return parse_recording_head(path, (*recording)->head);
}

}  // namespace flaneur
