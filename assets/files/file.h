// Files that come from outside: of what kind they are, their bytes within limits, and how they are quoted.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/result.h"

namespace flaneur {

using Bytes = std::vector<uint8_t>;

enum class FileKind {
    map,    // OpenStreetMap: .osm, .pbf, .osm.pbf, also .osm.gz and .osm.bz2
    gltf,   // .glb, .gltf, .vrm
    other,  // anything else
};

// By how its name ends, in capitals or not.
FileKind kind_of(std::string_view path);

// Whether a path ends so, in capitals or not. `ending` is in small letters.
bool has_ending(std::string_view path, std::string_view ending);

// Refuses, in a sentence, a path that leads to no regular file: to nothing, to a folder, to a pipe.
Result<void> find_file(const std::string& path);

// The bytes of a regular file of at most `most` of them: never waits for a pipe or a device, which a path may
// name. The error's sentence has no subject: "cannot be opened as a file; check ...".
Result<Bytes> read_bytes(const std::string& path, size_t most);

// What parse(text) makes of a file of at most so many bytes. The error of what is refused: "`so_what`, for
// FILE" and the parser's sentence, which has no subject.
template <class T>
Result<T> read_parsed(const std::string& path, size_t most, Result<T> (*parse)(std::string_view),
                      const char* so_what) {
    const Result<Bytes> bytes = read_bytes(path, most);
    Result<T> read =
        bytes ? parse({reinterpret_cast<const char*>(bytes->data()), bytes->size()}) : bytes.error();
    if (read) return read;
    std::string why = read.error().message;
    if (why.ends_with('.')) why.pop_back();
    return Error{std::string(so_what) + ", for " + path + " " + why + "."};
}

// Where a program keeps files of one kind for its user, after the XDG base directory specification: `flaneur`
// in the folder that the environment's `variable` names, or else in $HOME/`usual`. Empty, for nowhere, where
// neither is an absolute path.
std::string user_folder(const char* variable, const char* usual);

// What a file says, as a sentence may quote it: at most 60 characters, and nothing that steers a terminal.
std::string excerpt(std::string_view text);

// Refuses JSON that is nested deeper than `depth` or has more values than `values`, before a parser, whose
// stack and memory they take, sees it. The error's sentence has no subject.
Result<void> check_json(std::string_view json, size_t depth, size_t values);

}  // namespace flaneur
