// Looking things up in JSON that may be anything.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

namespace flaneur {

using Json = nlohmann::json;

// A member, or null.
inline const Json& member(const Json& object, const char* key) {
    static const Json k_null;
    auto found = object.is_object() ? object.find(key) : object.end();
    return found == object.end() ? k_null : *found;
}

// An element of an array, or null.
inline const Json& element(const Json& array, size_t index) {
    static const Json k_null;
    return array.is_array() && index < array.size() ? array[index] : k_null;
}

inline constexpr size_t k_no_number = ~size_t{0};

// A whole number >= 0; k_no_number if the member is anything else; `otherwise` if it is not there.
inline size_t whole_number(const Json& object, const char* key, size_t otherwise = k_no_number) {
    const Json& value = member(object, key);
    if (value.is_null()) return otherwise;
    return value.is_number_unsigned() ? value.get<size_t>() : k_no_number;
}

inline std::string text(const Json& object, const char* key) {
    const Json& value = member(object, key);
    return value.is_string() ? value.get<std::string>() : std::string();
}

}  // namespace flaneur
