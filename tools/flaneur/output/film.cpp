#include "tools/flaneur/output/film.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <initializer_list>

#include "assets/files/file.h"
#include "tools/flaneur/output/output.h"
#include "tools/flaneur/output/record.h"

namespace flaneur {

struct Film {
    PartFilePtr file;
    Size size;
    std::string record, comment;  // as ffmpeg takes it: with the record
    uint32_t step = 1;
    bool goes_on = false;  // with the film that is there
    uint32_t begun = 0;    // how many pictures that has
    uint32_t more = 0;     // how many were written
    int pipe = -1;
    pid_t ffmpeg = -1;
};

namespace {

std::atomic<pid_t> running = -1;  // the ffmpeg that makes a film, or joins two

struct Pipe {
    int read = -1, write = -1;
};

Result<Pipe> make_pipe() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
        return Error{std::string("Cannot make a pipe: ") + std::strerror(errno) + "."};
    return Pipe{ends[0], ends[1]};
}

// Starts a program of ffmpeg with some of its standard files at the end of a pipe, which is closed here.
// Signals that are blocked here are blocked there: Ctrl-C reaches both, and ffmpeg must go on until it has
// what was drawn.
Result<pid_t> start(const std::vector<std::string>& words, int end, std::initializer_list<int> standards) {
    std::vector<char*> pointers;
    pointers.reserve(words.size() + 1);
    for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    for (int standard : standards) posix_spawn_file_actions_adddup2(&actions, end, standard);
    pid_t started = -1;
    int failure = posix_spawnp(&started, pointers[0], &actions, nullptr, pointers.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(end);
    if (failure == 0) return started;
    return Error{"A film needs the program " + words[0] + ", which does not start (" +
                 std::string(std::strerror(failure)) +
                 "); install ffmpeg, or write numbered pictures: --out DIR/%05d.png."};
}

// Starts an ffmpeg that makes a film of what `input` says, and of what comes by the pipe.
Result<pid_t> start_ffmpeg(const std::vector<std::string>& input, const Pipe& pipe,
                           const std::string& comment, const PartFile& to) {
    std::vector<std::string> words{"ffmpeg", "-y", "-loglevel", "error"};
    words.insert(words.end(), input.begin(), input.end());
    // Without "file:", a colon in a path would begin a protocol.
    words.insert(words.end(), {"-metadata", comment, "-movflags", "+faststart", "-fflags", "+bitexact", "-f",
                               "mp4", "file:" + to.part});
    Result<pid_t> ffmpeg = start(words, pipe.read, {STDIN_FILENO});
    if (ffmpeg) running = *ffmpeg;
    return ffmpeg;
}

// Waits for the program; whether it was content.
bool has_ended_well(pid_t program) {
    int status = 1;
    while (waitpid(program, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

bool write_all(int to, const void* data, size_t size) {
    const auto* bytes = static_cast<const char*>(data);
    for (size_t done = 0; done < size;) {
        ssize_t wrote = write(to, bytes + done, size - done);
        if (wrote < 0 && errno != EINTR) return false;
        if (wrote > 0) done += static_cast<size_t>(wrote);
    }
    return true;
}

// Closes the pipe and waits; whether ffmpeg was content.
bool end_ffmpeg(Film& film) {
    if (film.pipe >= 0) close(film.pipe);
    film.pipe = -1;
    bool content = film.ffmpeg >= 0 && has_ended_well(film.ffmpeg);
    running = film.ffmpeg = -1;
    return content;
}

int even(int length) { return length + length % 2; }

// How many pictures a film has that is to go on, or that went on; `path` is what it is called.
Result<uint32_t> count_pictures(const Film& film, const std::string& at, const std::string& path) {
    Result<Pipe> pipe = make_pipe();
    if (!pipe) return pipe.error();
    Result<pid_t> probe =
        start({"ffprobe", "-loglevel", "error", "-select_streams", "v:0", "-count_packets", "-show_entries",
               "stream=width,height,r_frame_rate,nb_read_packets:format_tags=comment", "-of",
               "default=noprint_wrappers=1:nokey=1", "file:" + at},
              pipe->write, {STDOUT_FILENO, STDERR_FILENO});  // what is wrong with it comes first
    std::string said;
    char some[4096];
    for (ssize_t got = 1; got > 0;) {
        got = read(pipe->read, some, sizeof some);
        said.append(some, static_cast<size_t>(std::max<ssize_t>(got, 0)));
    }
    close(pipe->read);
    if (!probe) return probe.error();
    bool content = has_ended_well(*probe);
    int width = 0, height = 0, length = 0;
    uint32_t rate = 0, seconds = 0, pictures = 0;
    if (!content || std::sscanf(said.c_str(), "%d %d %u/%u %u %n", &width, &height, &rate, &seconds,
                                &pictures, &length) != 5)
        return Error{"Cannot go on with " + path +
                     ": ffprobe cannot read it to its end, so it is damaged or no film."};
    if (Result<void> same = check_record(path, said.substr(static_cast<size_t>(length)), film.record); !same)
        return same.error();
    if (width != even(film.size.width) || height != even(film.size.height) ||
        rate * film.step != 60 * seconds)
        return Error{"Cannot go on with " + path + ": it is " + std::to_string(width) + "x" +
                     std::to_string(height) + " at " + std::to_string(rate / std::max(1u, seconds)) +
                     " pictures a second; give the --size and the step of --frames that it was begun with."};
    return pictures;
}

// In a list for ffmpeg.
std::string list_line(const std::string& path) {
    std::string text = "file 'file:";
    for (char c : path) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'\n";
}

// One film of the one that is there and the one that goes on with it, picture for picture.
Result<void> join(Film& film) {
    PartFilePtr tail = std::move(film.file);
    Result<uint32_t> now = count_pictures(film, tail->target, tail->path);
    if (!now) return now.error();
    if (*now != film.begun)
        return Error{"Cannot go on with " + tail->path + ": it had " + std::to_string(film.begun) +
                     " pictures and has " + std::to_string(*now) +
                     " now, so another command wrote it; give each a film of its own."};
    tail->gives_way = true;
    Result<PartFilePtr> whole = open_file(tail->path);
    if (!whole) return whole.error();
    Result<Pipe> pipe = make_pipe();
    if (!pipe) return pipe.error();
    Result<pid_t> ffmpeg = start_ffmpeg(
        {"-f", "concat", "-safe", "0", "-protocol_whitelist", "file,pipe", "-i", "-", "-c", "copy"}, *pipe,
        film.comment, **whole);
    // Exactly, for what the file says of itself is rounded to milliseconds.
    std::string begun = std::to_string(static_cast<double>(film.begun * film.step) / 60);
    std::string list = list_line(tail->target) + "duration " + begun + "\n" + list_line(tail->part);
    bool told = write_all(pipe->write, list.data(), list.size());
    close(pipe->write);
    if (!ffmpeg) return ffmpeg.error();
    bool content = has_ended_well(*ffmpeg);
    running = -1;
    if (!content || !told)
        return Error{"ffmpeg could not join " + tail->path +
                     " and what goes on with it; it may have said why above."};
    Result<uint32_t> joined = count_pictures(film, (*whole)->part, tail->path);
    if (!joined || *joined != film.begun + film.more)
        return Error{"ffmpeg could not join " + tail->path +
                     " and what goes on with it, so it is left as it was."};
    film.file = std::move(*whole);
    return {};
}

}  // namespace

void abandon_films() {
    if (pid_t ffmpeg = running; ffmpeg > 0) kill(ffmpeg, SIGKILL);
}

void FilmDelete::operator()(Film* film) const {
    end_ffmpeg(*film);
    delete film;
}

bool is_film(const std::string& path) { return has_ending(path, ".mp4"); }

Result<FilmPtr> open_film(const std::string& path, Size size, uint32_t step, const std::string& record,
                          bool resume) {
    // Before it is opened, which takes until a pipe has a reader.
    if (is_stream(path)) return Error{"A film takes a plain file, which " + path + " is not."};
    Result<PartFilePtr> file = open_file(path);
    if (!file) return file.error();
    FilmPtr film(new Film);
    film->file = std::move(*file);
    film->size = size;
    film->record = record;
    film->comment = "comment=" + record;
    film->step = step;
    if (resume && std::filesystem::exists(film->file->target)) {
        Result<uint32_t> begun = count_pictures(*film, film->file->target, path);
        if (!begun) return begun.error();
        film->goes_on = true;
        film->begun = *begun;
    }

    Result<Pipe> pipe = make_pipe();
    if (!pipe) return pipe.error();
    film->pipe = pipe->write;
    std::string pixels = std::to_string(size.width) + "x" + std::to_string(size.height);
    Result<pid_t> ffmpeg = start_ffmpeg({"-f",   "rawvideo", "-pix_fmt", "rgba",
                                         "-s",   pixels,     "-r",       "60/" + std::to_string(step),
                                         "-i",   "-",        "-vf",      "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                                         "-c:v", "libx264",  "-preset",  "veryfast",
                                         "-crf", "20",       "-pix_fmt", "yuv420p"},
                                        *pipe, film->comment, *film->file);
    if (!ffmpeg) return ffmpeg.error();
    film->ffmpeg = *ffmpeg;
    return film;
}

uint32_t pictures_begun_with(const Film& film) { return film.begun; }

Result<void> write_film(Film& film, const std::vector<uint8_t>& rgba) {
    ++film.more;
    if (write_all(film.pipe, rgba.data(), rgba.size())) return {};
    return Error{"ffmpeg stopped before " + film.file->path + " was done; it may have said why above."};
}

Result<void> finish_film(FilmPtr film) {
    if (film->goes_on && film->more == 0) {  // it was whole
        abandon_films();
        return {};
    }
    if (!end_ffmpeg(*film))
        return Error{"ffmpeg could not finish " + film->file->path + "; it may have said why above."};
    if (film->goes_on) {
        Result<void> joined = join(*film);
        if (!joined) return joined;
    }
    return keep_file(std::move(film->file));
}

}  // namespace flaneur
