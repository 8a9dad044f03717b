// A film, or numbered pictures, drawn in parts by several processes, on one machine or on many that share a
// folder. Pictures of a film's parts lie beside it in FILM.parts, without loss and numbered by tick, with a
// plan that tells which film they are of; joined, they are the film that one process would have written, byte
// for byte.
#pragma once

#include <cstdint>
#include <string>

#include "sim/base/result.h"
#include "tools/flaneur/options/options.h"

namespace flaneur {

// Numbers of pictures, from 0.
struct PictureSpan {
    uint32_t first = 0, beyond = 0;
};
// The part of so many pictures that a shard draws: all parts are of one size, or one picture more.
PictureSpan pictures_of(Shard shard, uint32_t pictures);

// Where a part's pictures go, as open_output() takes it: for a film into FILM.parts, which is made, with its
// plan, where it is not there. Refuses one picture alone, and parts of another film.
Result<std::string> begin_parts(const std::string& out, Size size, const TickRange& ticks,
                                const std::string& record);

// The film of its parts. Refuses, in a sentence, to join what lacks pictures; leaves the parts where they
// are.
Result<void> join_parts(const std::string& film);

}  // namespace flaneur
