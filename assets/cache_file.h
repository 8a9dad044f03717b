// Files in which what is dear to make is kept between runs. Each is named by a key that says what it was made
// from; one that is damaged, or made from something else, is not there.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace flaneur {

// FOLDER/KIND-<key>.
std::string kept_path(const std::string& folder, const char* kind, uint64_t key);

// The bytes that were kept under this key, if they are there and unharmed. At most `most` of them.
std::optional<std::string> read_kept(const std::string& path, uint64_t key, uint64_t most);

// Keeps them if it can, making folders as needed. Written beside its place and renamed, so that nobody reads
// half of one; several threads and programs may keep the same.
void keep(const std::string& path, uint64_t key, std::string_view bytes);

}  // namespace flaneur
