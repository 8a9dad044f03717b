// Files that the program writes: pictures, films and texts. A file is written beside its final place under a
// name that ends in .part, and renamed when it is whole; what fails or is given up on leaves nothing behind.
// Links are followed, and stay. A device, a pipe or a socket, and what /dev/stdout and /dev/fd/3 stand for,
// is written to as it is; "-" is standard output. A file that goes there has it for itself: what is printed
// goes to standard error then.
#pragma once

#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/result.h"
#include "tools/flaneur/options/options.h"

namespace flaneur {

// A file under way. `file` is open for writing until keep_file.
struct PartFile {
    std::string path;         // as it was asked for
    std::string target;       // where it will be: where `path` leads
    std::string part;         // where it is meanwhile; empty: written in place
    std::string made_folder;  // the topmost folder made for it, removed with it while empty
    bool gives_way = false;   // another one is to be opened that comes in its place
    FILE* file = nullptr;
};
struct PartFileDelete {
    void operator()(PartFile*) const;
};
using PartFilePtr = std::unique_ptr<PartFile, PartFileDelete>;

// Files that this command reads, if they are there: nothing is written over them. `paths` is asked once, when
// the first output is there already.
void protect_inputs(std::function<std::vector<std::string>()> paths);

// Makes missing folders. Refuses, at once, a place that cannot be written to, a name that is too long, a file
// that is protected from writing, one that the command reads, and where another file under way goes.
Result<PartFilePtr> open_file(const std::string& path);
// The same of a file that may be asked for: null where the path is empty.
Result<PartFilePtr> open_if_asked(const std::string& path);
// Closes and renames. Fails by unread() (ending.h) where nobody reads the pipe any more.
Result<void> keep_file(PartFilePtr file);

// Writes all that a file is to hold, and keeps it.
Result<void> write_file(PartFilePtr file, std::string_view bytes);
Result<void> write_file(const std::string& path, std::string_view bytes);
// The same of what was compressed; there is none where memory was too short for that.
Result<void> write_compressed(PartFilePtr file, std::string_view bytes);

// Whether what is written goes on at once, to a pipe or a device.
bool is_stream(const std::string& path);
// Whether it is a pipe whose reader has gone.
bool is_unread(FILE* file);

// Removes what is under way, and ends ffmpeg, while other threads may still be at work on it: to be called
// when the process is about to end.
void abandon_outputs();

// `rgba` has rows from the top.
enum class Alpha : uint8_t { dropped, kept };
Result<void> write_png(PartFilePtr file, const std::vector<uint8_t>& rgba, Size size,
                       const std::string& comment = {}, Alpha alpha = Alpha::dropped);

// Where render's pictures go: FILE.png or a stream (one tick), a pattern such as DIR/%05d.png (numbered by
// tick), or FILE.mp4.
struct Output;
struct OutputDelete {
    void operator()(Output*) const;
};
using OutputPtr = std::unique_ptr<Output, OutputDelete>;

// Refuses what could not be finished: another ending, one picture for many ticks, no ffmpeg, a place that
// cannot be written to. `resume` goes on with a film or numbered pictures that were given up on, and refuses
// those whose record (record.h) is another.
Result<OutputPtr> open_output(const std::string& path, Size size, const TickRange& ticks,
                              const std::string& record = {}, bool resume = false);
// Where the picture of a tick goes: `path`, with its number where that is a pattern.
std::string picture_path(const std::string& path, uint32_t tick);
// Whether the picture, the one with this number from 0, was there when it went on.
bool is_written(const Output& output, uint32_t number, uint32_t tick);
Result<void> write_image(Output& output, const std::vector<uint8_t>& rgba, uint32_t tick,
                         Alpha alpha = Alpha::dropped);
// To be called once after the last image. Numbered pictures are kept as they come; a film of the images so
// far is whole.
Result<void> finish_output(Output& output);

}  // namespace flaneur
