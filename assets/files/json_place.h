// Where something stands in a JSON text.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace flaneur {

struct JsonPlace {
    int line = 1, column = 1;  // from 1; columns count characters
};

// Of the byte number `at`.
JsonPlace place_at(std::string_view text, size_t at);

// The value that a path of keys and of numbers in lists leads to, or, `of_key`, the last key itself. The text
// must be sound JSON that has it.
JsonPlace place_in_json(std::string_view text, const std::vector<std::string>& path, bool of_key);

// The value itself, as it is written.
std::string_view text_in_json(std::string_view text, const std::vector<std::string>& path);

// The byte where an object has a key that it had before; parsers would silently take the last. The text must
// be sound JSON.
std::optional<size_t> find_repeated_key(std::string_view text);

}  // namespace flaneur
