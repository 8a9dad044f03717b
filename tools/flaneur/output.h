// Files that the program writes: pictures, films and texts. Everything is written beside its final place
// under a name that ends in .part, and renamed when it is whole; what fails or is given up on leaves nothing
// behind.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "sim/base/result.h"
#include "tools/flaneur/options.h"

namespace flaneur {

// A file under way. `file` is open for writing until keep_file.
struct PartFile {
    std::string path, part;
    std::string made_folder;  // the topmost folder made for it, removed with it while empty
    FILE* file = nullptr;
};
struct PartFileDelete {
    void operator()(PartFile*) const;
};
using PartFilePtr = std::unique_ptr<PartFile, PartFileDelete>;

// Makes missing folders. Refuses, at once, a place that cannot be written to.
Result<PartFilePtr> open_file(const std::string& path);
// Closes and renames.
Result<void> keep_file(PartFilePtr file);

// `rgba` has rows from the top; alpha is dropped.
Result<void> write_png(PartFilePtr file, const std::vector<uint8_t>& rgba, Size size);

// Where render's pictures go: FILE.png (one tick), a pattern such as DIR/%05d.png (numbered by tick), or
// FILE.mp4.
struct Output;
struct OutputDelete {
    void operator()(Output*) const;
};
using OutputPtr = std::unique_ptr<Output, OutputDelete>;

// Refuses what could not be finished: another ending, one picture for many ticks, no ffmpeg, a place that
// cannot be written to.
Result<OutputPtr> open_output(const std::string& path, Size size, const TickRange& ticks);
Result<void> write_image(Output& output, const std::vector<uint8_t>& rgba, uint32_t tick);
// To be called once after the last image. Numbered pictures are kept as they come.
Result<void> finish_output(Output& output);

}  // namespace flaneur
