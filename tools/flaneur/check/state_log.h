// Logs of states, `flaneur sim --state-log FILE`: which world it is, what its fields are called, a digest of
// its state at each tick, the beginning included, and all values of the last.
//
// Lines of text, to an empty one, then numbers, little-endian, and a sum of all bytes before it.
// docs/files.md says how they lie.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/hash.h"
#include "sim/base/result.h"
#include "sim/fields.h"

namespace flaneur {

struct StateLogHead {
    std::vector<std::string> words;  // what follows `flaneur sim` for such a world, without how long
    uint32_t walkers = 0;
    uint32_t last = 0;  // tick; the first is 0
    StateFields fields;
};

// What of a command's words decides its world. Threads and instruction sets do not.
std::vector<std::string> world_words(const std::vector<std::string>& words);

// A log that is written.
struct StateLogWriter {
    FILE* file = nullptr;       // not closed
    uint64_t sum = k_no_bytes;  // of what was written
};
// Refuses names of files that do not go into a line.
Result<void> write_state_log_head(StateLogWriter& log, const StateLogHead& head);
// Tick by tick from 0. Whether it could be written.
bool write_digest(StateLogWriter& log, const StateDigest& digest);
// And the log's end.
bool write_state_words(StateLogWriter& log, const std::vector<uint32_t>& words);

// A log that is read, from a file or from a program that is at it.
struct StateLogReader {
    int from = -1;        // a descriptor; not closed
    std::string name;     // for sentences
    bool is_one = false;  // its first line is a state log's
    StateLogHead head{};
    std::vector<char> read{};  // and not taken yet, from `taken` on
    size_t taken = 0;
    uint64_t sum = k_no_bytes;  // of what was taken
};
// Each refuses, in a sentence, what is cut short, no such log or one of another version, and gives up when
// the program is to stop (ending.h). Counts are believed only as far as bytes follow. Of a file all bytes are
// held against their sum before anything is believed; of a program that is when its end is read.
Result<void> read_state_log_head(StateLogReader& log);
Result<void> read_digest(StateLogReader& log, StateDigest& digest);
// And the log's end.
Result<std::vector<uint32_t>> read_state_words(StateLogReader& log);

}  // namespace flaneur
