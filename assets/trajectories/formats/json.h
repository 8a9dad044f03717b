// Looking things up in JSON that may be anything. Private to assets/trajectories.
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

#include "assets/files/file.h"

namespace flaneur {

using TracksJson = nlohmann::json;

// A member, or null.
inline const TracksJson& in_json(const TracksJson& object, const char* key) {
    static const TracksJson k_null;
    const auto found = object.is_object() ? object.find(key) : object.end();
    return object.is_object() && found != object.end() ? *found : k_null;
}

// The error's sentence has no subject.
inline Result<TracksJson> parse_tracks_json(std::string_view text, size_t most_values) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    if (Result<void> small = check_json(text, 64, most_values); !small) return small.error();
    TracksJson root = TracksJson::parse(text, nullptr, false);
    if (root.is_discarded()) return Error{"is no sound JSON"};
    return root;
}

}  // namespace flaneur
