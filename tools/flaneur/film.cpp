#include "tools/flaneur/film.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "tools/flaneur/output.h"

namespace flaneur {

struct Film {
    PartFilePtr file;
    int pipe = -1;
    pid_t ffmpeg = -1;
};

namespace {

// Closes the pipe and waits; whether ffmpeg was content.
bool end_ffmpeg(Film& film) {
    if (film.pipe >= 0) close(film.pipe);
    film.pipe = -1;
    int status = 1;
    if (film.ffmpeg >= 0) {
        while (waitpid(film.ffmpeg, &status, 0) < 0 && errno == EINTR) {
        }
    }
    film.ffmpeg = -1;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

void FilmDelete::operator()(Film* film) const {
    end_ffmpeg(*film);
    delete film;
}

Result<FilmPtr> open_film(const std::string& path, Size size, uint32_t step) {
    Result<PartFilePtr> file = open_file(path);
    if (!file) return file.error();
    FilmPtr film(new Film);
    film->file = std::move(*file);

    std::string pixels = std::to_string(size.width) + "x" + std::to_string(size.height);
    std::string rate = "60/" + std::to_string(step);
    const char* words[] = {"ffmpeg",
                           "-y",
                           "-loglevel",
                           "error",
                           "-f",
                           "rawvideo",
                           "-pix_fmt",
                           "rgba",
                           "-s",
                           pixels.c_str(),
                           "-r",
                           rate.c_str(),
                           "-i",
                           "-",
                           "-vf",
                           "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                           "-c:v",
                           "libx264",
                           "-preset",
                           "veryfast",
                           "-crf",
                           "20",
                           "-pix_fmt",
                           "yuv420p",
                           "-movflags",
                           "+faststart",
                           "-fflags",
                           "+bitexact",
                           "-f",
                           "mp4",
                           film->file->part.c_str(),
                           nullptr};

    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
        return Error{std::string("Cannot make a pipe: ") + std::strerror(errno) + "."};
    film->pipe = ends[1];
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
    int failure =
        posix_spawnp(&film->ffmpeg, "ffmpeg", &actions, nullptr, const_cast<char**>(words), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[0]);
    if (failure != 0) {
        film->ffmpeg = -1;
        return Error{"A film needs the program ffmpeg, which does not start (" +
                     std::string(std::strerror(failure)) +
                     "); install it, or write numbered pictures: --out DIR/%05d.png."};
    }
    return film;
}

Result<void> write_film(Film& film, const std::vector<uint8_t>& rgba) {
    for (size_t done = 0; done < rgba.size();) {
        ssize_t wrote = write(film.pipe, rgba.data() + done, rgba.size() - done);
        if (wrote > 0) {
            done += static_cast<size_t>(wrote);
        } else if (errno != EINTR) {
            return Error{"ffmpeg stopped before " + film.file->path +
                         " was done; it may have said why above."};
        }
    }
    return {};
}

Result<void> finish_film(FilmPtr film) {
    if (!end_ffmpeg(*film))
        return Error{"ffmpeg could not finish " + film->file->path + "; it may have said why above."};
    return keep_file(std::move(film->file));
}

}  // namespace flaneur
