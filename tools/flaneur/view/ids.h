// What a picture shows besides its light, as files beside it, and what its ids stand for.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "assets/city.h"
#include "renderer/renderer.h"
#include "tools/flaneur/options/options.h"
#include "tools/flaneur/output/output.h"

namespace flaneur {

// Of those that are in the picture, growing: what each is, its number, what kind of ground or prop, how many
// pixels it has and the box that holds them (left, upper, width, height). docs/files.md has the keys.
std::string legend_of(const std::vector<uint32_t>& ids, Size size, const City& city);

// Open before the picture is drawn; null where they are not asked for.
struct ChannelFiles {
    PartFilePtr depths, ids, legend;
};
// By these paths, of which either may be "": see output/channels.h. The legend lies beside the ids.
Result<ChannelFiles> open_channels(const std::string& depth, const std::string& ids);
// The image has what was opened.
Result<void> write_channels(ChannelFiles files, const Image& image, const City& city);

}  // namespace flaneur
