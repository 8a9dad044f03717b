// Files in which what is dear to make is kept between runs. Each is named by a key that says what it was made
// from; one that is damaged, or made from something else, is not there. Nobody but their owner may read them,
// and those that were used least recently go when there are too many.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "sim/base/result.h"

namespace flaneur {

// Where they are kept, after the XDG base directory specification: $XDG_CACHE_HOME/flaneur, or else
// $HOME/.cache/flaneur. Empty, for nowhere, where neither is an absolute path or cache_limit() is 0.
std::string cache_folder();

// Bytes that they may take together: FLANEUR_CACHE_MAX, which is in MiB, or 1 GiB. Reading it refuses what is
// no whole number, for which cache_limit() takes 1 GiB.
constexpr uint64_t k_usual_cache_limit = uint64_t{1} << 30;
Result<uint64_t> read_cache_limit();
uint64_t cache_limit();

// Of the folder; refuses one that may not be looked into.
struct CacheStatus {
    size_t files = 0;
    uint64_t bytes = 0;
};
Result<CacheStatus> cache_status(const std::string& folder);

// Removes them, and nothing else that lies there; gives what was removed. Refuses what may not be removed.
Result<CacheStatus> clear_cache(const std::string& folder);

// FOLDER/KIND-<key>. KIND is impostors, levels, navmesh or person.
std::string kept_path(const std::string& folder, const char* kind, uint64_t key);

// The bytes that were kept under this key, if they are there and unharmed. At most `most` of them.
std::optional<std::string> read_kept(const std::string& path, uint64_t key, uint64_t most);

// Keeps them if it can and they are no more than `limit`, making folders as needed; others go until all are
// no more than `limit`. Written beside its place and renamed, so that nobody reads half of one; several
// threads and programs may keep the same.
void keep(const std::string& path, uint64_t key, std::string_view bytes, uint64_t limit = cache_limit());

}  // namespace flaneur
