// A film, written by ffmpeg through a pipe.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sim/base/result.h"
#include "tools/flaneur/options/options.h"

namespace flaneur {

struct Film;
struct FilmDelete {
    void operator()(Film*) const;
};
using FilmPtr = std::unique_ptr<Film, FilmDelete>;

// Whether a file of that name is a film.
bool is_film(const std::string& path);

// H.264 in an .mp4, one picture for every `step` ticks, in real time. Odd sizes are padded by a black line.
// The film keeps the record. `resume` goes on with a film that is there, which stays as it is until both are
// one; refuses what is no film, or one of another record, size or rate.
Result<FilmPtr> open_film(const std::string& path, Size size, uint32_t step, const std::string& record,
                          bool resume);
// How many pictures a film that goes on has: the first to be written is the one after them.
uint32_t pictures_begun_with(const Film& film);
Result<void> write_film(Film& film, const std::vector<uint8_t>& rgba);
Result<void> finish_film(FilmPtr film);
// Ends ffmpeg at once, on any thread: its film is not finished.
void abandon_films();

}  // namespace flaneur
