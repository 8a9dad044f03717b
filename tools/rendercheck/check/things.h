// What lies where pictures differ, by pictures of ids and their legends: {"things": [{"id", "kind", "number",
// "what"}]}, as `flaneur render --ids` writes them.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tools/rendercheck/verdict/verdict.h"

namespace flaneur {

struct IdPicture {
    int width = 0;
    std::vector<uint32_t> ids;              // of each pixel
    std::map<uint32_t, std::string> names;  // "walker 12", "road"
};

// Of a PNG, red + 256 green + 65536 blue, or an EXR of whole numbers. False where it cannot be read.
bool read_ids(const std::vector<uint8_t>& file, const std::string& legend, IdPicture& to);

// A legend without what the picture itself tells: how many pixels things have and where. "" where it is none.
std::string short_legend(const std::string& legend);

// Sentences: what is missing or new in the picture, and what is in the boxes that changed. `before` may be
// null.
std::vector<std::string> told_things(const Judgement& judgement, const IdPicture& now,
                                     const IdPicture* before);

}  // namespace flaneur
