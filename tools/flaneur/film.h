// A film, written by ffmpeg through a pipe.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sim/base/result.h"
#include "tools/flaneur/options.h"

namespace flaneur {

struct Film;
struct FilmDelete {
    void operator()(Film*) const;
};
using FilmPtr = std::unique_ptr<Film, FilmDelete>;

// H.264 in an .mp4, one picture for every `step` ticks, in real time. Odd sizes are padded by a black line.
Result<FilmPtr> open_film(const std::string& path, Size size, uint32_t step);
Result<void> write_film(Film& film, const std::vector<uint8_t>& rgba);
Result<void> finish_film(FilmPtr film);

}  // namespace flaneur
