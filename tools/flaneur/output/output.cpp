#include "tools/flaneur/output/output.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <future>
#include <mutex>
#include <optional>
#include <system_error>

#include "assets/files/file.h"
#include "assets/files/picture.h"
#include "tools/flaneur/console/ending.h"
#include "tools/flaneur/output/film.h"
#include "tools/flaneur/output/record.h"

namespace flaneur {

namespace fs = std::filesystem;

namespace {

Error cannot_write(const std::string& path, const std::string& why) {
    return Error{"Cannot write " + path + ": " + why + "."};
}

// Those under way, for abandon_outputs.
struct OpenFiles {
    std::mutex mutex;
    std::vector<const PartFile*> files;
    std::shared_future<std::vector<std::string>> inputs;
};

OpenFiles& open_files() {
    static auto* all = new OpenFiles;  // never destroyed: the process may be ending
    return *all;
}

void remember(const PartFile* file) {
    std::lock_guard lock(open_files().mutex);
    open_files().files.push_back(file);
}

// Opens the part of `f`, and remembers it at once. One of that name may have been left behind by another
// process that had our number.
void open_part(PartFile& f) {
    static int number = 0;
    std::lock_guard lock(open_files().mutex);
    do {
        // Short, so that whatever name fits may be asked for.
        std::string name = ".flaneur-" + std::to_string(getpid()) + "-" + std::to_string(number++) + ".part";
        f.part = (fs::path(f.target).parent_path() / name).string();
        f.file = std::fopen(f.part.c_str(), "wbxe");
    } while (!f.file && errno == EEXIST);
    if (f.file) open_files().files.push_back(&f);
}

// The topmost folder made for another file under way, where that is above `target` too; or an empty text.
std::string folder_made_for_another(const fs::path& target) {
    std::lock_guard lock(open_files().mutex);
    for (const PartFile* file : open_files().files) {
        fs::path made = file->made_folder;
        if (!made.empty() &&
            std::mismatch(made.begin(), made.end(), target.begin(), target.end()).first == made.end())
            return file->made_folder;
    }
    return "";
}

// Whether another file under way goes there too. Devices and pipes with names take any number.
bool is_taken(const std::string& target) {
    std::lock_guard lock(open_files().mutex);
    const std::vector<const PartFile*>& files = open_files().files;
    return std::any_of(files.begin(), files.end(), [&](const PartFile* file) {
        return !file->gives_way &&
               fs::path(file->target).lexically_normal() == fs::path(target).lexically_normal();
    });
}

bool is_read(const std::string& target) {
    const std::shared_future<std::vector<std::string>> inputs = open_files().inputs;
    return inputs.valid() &&
           std::any_of(inputs.get().begin(), inputs.get().end(), [&](const std::string& input) {
               std::error_code ignored;
               return fs::equivalent(input, target, ignored);
           });
}

void forget(const PartFile* file) {
    std::lock_guard lock(open_files().mutex);
    std::erase(open_files().files, file);
}

// The file itself, and the folders made for it.
void remove_traces(const PartFile& f) {
    std::error_code ignored;
    if (!f.part.empty()) fs::remove(f.part, ignored);
    for (fs::path p = fs::path(f.target).parent_path(); !f.made_folder.empty(); p = p.parent_path()) {
        if (!fs::remove(p, ignored) || p == f.made_folder) break;
    }
}

// The number of an open file that the path names, as /dev/stdout does in the end.
std::optional<int> descriptor_of(const std::string& path) {
    for (std::string_view folder : {"/proc/self/fd/", "/dev/fd/"}) {
        if (!path.starts_with(folder)) continue;
        int number = 0;
        const char* last = path.data() + path.size();
        auto [end, error] = std::from_chars(path.data() + folder.size(), last, number);
        if (error == std::errc() && end == last) return number;
    }
    return std::nullopt;
}

// Opens a descriptor again. Standard output goes to one file alone: what is printed from now on goes to
// standard error.
FILE* reopened(int descriptor) {
    std::fflush(stdout);
    int own = fcntl(descriptor, F_DUPFD_CLOEXEC, 0);
    if (own >= 0 && descriptor == STDOUT_FILENO) dup2(STDERR_FILENO, STDOUT_FILENO);
    return own >= 0 ? fdopen(own, "wb") : nullptr;
}

// Where the path leads: an absolute path that is no link.
Result<std::string> followed(const std::string& path) {
    constexpr int k_most_links = 40;
    if (path.empty()) return cannot_write("a file without a name", "say where");
    if (path == "-") return std::string("/proc/self/fd/1");
    std::error_code error;
    fs::path at = fs::absolute(path, error);
    for (int links = 0; links < k_most_links && !error; ++links) {
        if (std::optional<int> descriptor = descriptor_of(at.string()))
            return "/proc/self/fd/" + std::to_string(*descriptor);
        if (!fs::is_symlink(at, error)) return at.string();
        fs::path to = fs::read_symlink(at, error);
        at = to.is_absolute() ? to : at.parent_path() / to;
    }
    return cannot_write(path, error ? error.message() : "it is a link that leads nowhere");
}

// Makes the missing folders above `target`; gives the topmost of them, or an empty text.
Result<std::string> make_folders(const std::string& path, const std::string& target) {
    std::error_code error;
    std::string made;
    fs::path folder = fs::path(target).parent_path();
    for (fs::path p = folder; !p.empty() && !fs::exists(p, error) && !error; p = p.parent_path())
        made = p.string();
    if (!error) fs::create_directories(folder, error);
    if (error)
        return cannot_write(path,
                            "the folder " + folder.string() + " cannot be made (" + error.message() + ")");
    return made;
}

// A path whose last name has one place for a whole number, %d or %0Nd.
struct Numbered {
    std::string before, after;
    size_t digits = 0;
};

std::optional<Numbered> numbered_of(const std::string& path) {
    std::string name = fs::path(path).filename().string();
    size_t percent = name.find('%');
    if (percent == std::string::npos || name.find('%', percent + 1) != std::string::npos) return {};
    size_t end = name.find('d', percent);
    if (end == std::string::npos) return {};
    Numbered numbered{(fs::path(path).parent_path() / name.substr(0, percent)).string(),
                      name.substr(end + 1)};
    const char* first = name.data() + percent + 1;
    const char* last = name.data() + end;
    if (first == last) return numbered;
    auto [stop, error] = std::from_chars(first, last, numbered.digits);
    if (*first != '0' || error != std::errc() || stop != last || numbered.digits > 20) return {};
    return numbered;
}

std::string path_for(const Numbered& numbered, uint32_t tick) {
    std::string number = std::to_string(tick);
    if (number.size() < numbered.digits) number.insert(0, numbered.digits - number.size(), '0');
    return numbered.before + number + numbered.after;
}

}  // namespace

bool is_stream(const std::string& path) {
    Result<std::string> target = followed(path);
    struct stat now {};
    return target && (descriptor_of(*target) ||
                      (stat(target->c_str(), &now) == 0 && !S_ISREG(now.st_mode) && !S_ISDIR(now.st_mode)));
}

bool is_unread(FILE* file) {
    pollfd end{fileno(file), 0, 0};
    return poll(&end, 1, 0) > 0 && (end.revents & POLLERR) != 0;
}

void PartFileDelete::operator()(PartFile* f) const {
    if (f->file) {
        std::fclose(f->file);
        forget(f);
        remove_traces(*f);
    }
    delete f;
}

void abandon_outputs() {
    abandon_films();
    OpenFiles& all = open_files();
    std::lock_guard lock(all.mutex);
    for (const PartFile* f : all.files) remove_traces(*f);
}

void protect_inputs(std::function<std::vector<std::string>()> paths) {
    open_files().inputs = std::async(std::launch::deferred, std::move(paths)).share();
}

Result<PartFilePtr> open_file(const std::string& path) {
    PartFilePtr f(new PartFile);
    f->path = path;
    Result<std::string> target = followed(path);
    if (!target) return target.error();
    f->target = *target;
    std::optional<int> descriptor = descriptor_of(f->target);
    struct stat now {};
    bool is_there = stat(f->target.c_str(), &now) == 0;
    if (is_there && S_ISDIR(now.st_mode)) return cannot_write(path, "it is a folder");
    bool is_plain = !descriptor && (!is_there || S_ISREG(now.st_mode));
    if ((is_plain || descriptor) && is_taken(f->target))
        return cannot_write(path, "another output of this command goes there too");
    if (is_plain && is_there && is_read(f->target)) return cannot_write(path, "this command reads it");
    if (!is_plain) {
        f->file = descriptor ? reopened(*descriptor) : std::fopen(f->target.c_str(), "wbe");
        if (!f->file) return cannot_write(path, std::strerror(errno));
        remember(f.get());
        return f;
    }
    constexpr mode_t k_writable = S_IWUSR | S_IWGRP | S_IWOTH;
    if (is_there && ((now.st_mode & k_writable) == 0 || access(f->target.c_str(), W_OK) != 0))
        return cannot_write(path, "it is there already and protected from writing");
    Result<std::string> made = make_folders(path, f->target);
    if (!made) return made.error();
    f->made_folder = made->empty() ? folder_made_for_another(f->target) : *made;
    open_part(*f);
    bool has_name = f->file && (is_there || stat(f->target.c_str(), &now) == 0 || errno == ENOENT);
    if (!has_name) {  // that it may have
        Error error = cannot_write(path, std::strerror(errno));
        if (f->file) return error;
        f->part.clear();
        remove_traces(*f);
        return error;
    }
    if (is_there) fchmod(fileno(f->file), now.st_mode & 07777);
    return f;
}

Result<PartFilePtr> open_if_asked(const std::string& path) {
    return path.empty() ? PartFilePtr() : open_file(path);
}

Result<void> keep_file(PartFilePtr f) {
    if (f->part.empty()) std::fflush(stdout);  // which it may be
    bool whole = std::fflush(f->file) == 0 && std::ferror(f->file) == 0;
    int why = errno;
    if (!whole) return is_unread(f->file) ? unread() : cannot_write(f->path, std::strerror(why));
    std::error_code error;
    if (!f->part.empty()) fs::rename(f->part, f->target, error);
    if (error) return cannot_write(f->path, error.message());
    std::fclose(f->file);
    f->file = nullptr;
    forget(f.get());
    return {};
}

Result<void> write_file(PartFilePtr f, std::string_view bytes) {
    std::fwrite(bytes.data(), 1, bytes.size(), f->file);
    return keep_file(std::move(f));
}

Result<void> write_file(const std::string& path, std::string_view bytes) {
    Result<PartFilePtr> file = open_file(path);
    return file ? write_file(std::move(*file), bytes) : file.error();
}

Result<void> write_compressed(PartFilePtr f, std::string_view bytes) {
    if (bytes.empty()) return cannot_write(f->path, "there is not enough memory to compress the picture");
    return write_file(std::move(f), bytes);
}

Result<void> write_png(PartFilePtr f, const std::vector<uint8_t>& rgba, Size size, const std::string& comment,
                       Alpha alpha) {
    size_t pixels = static_cast<size_t>(size.width) * static_cast<size_t>(size.height);
    assert(rgba.size() == pixels * 4);
    if (alpha == Alpha::kept)
        return write_compressed(std::move(f), encode_png(rgba, size.width, size.height, 4, comment));
    std::vector<uint8_t> rgb(pixels * 3);
    for (size_t i = 0; i < pixels; ++i) std::memcpy(&rgb[i * 3], &rgba[i * 4], 3);
    return write_compressed(std::move(f), encode_png(rgb, size.width, size.height, 3, comment));
}

struct Output {
    Size size;
    PartFilePtr first;  // one picture; of numbered ones the first, opened early to see that it can be written
    std::optional<Numbered> numbered;
    FilmPtr film;
    std::string record;
    bool resume = false;
};

void OutputDelete::operator()(Output* output) const { delete output; }

std::string picture_path(const std::string& path, uint32_t tick) {
    std::optional<Numbered> numbered = numbered_of(path);
    return numbered && !is_film(path) ? path_for(*numbered, tick) : path;
}

// Whether the numbered pictures that are there were drawn by the same command.
static Result<void> check_pictures(const Output& output, const TickRange& ticks) {
    constexpr size_t k_head = 1 << 16;  // bytes, with the comment among them
    for (uint32_t i = 0; i < count(ticks); ++i) {
        uint32_t tick = ticks.first + i * ticks.step;
        std::string path = path_for(*output.numbered, tick);
        if (std::error_code ignored; !fs::exists(path, ignored)) continue;
        std::vector<uint8_t> head(k_head);
        std::ifstream file(path, std::ios::binary);
        file.read(reinterpret_cast<char*>(head.data()), k_head);
        head.resize(static_cast<size_t>(file.gcount()));
        if (Result<void> same = check_record(path, png_comment(head), output.record); !same) return same;
    }
    return {};
}

Result<OutputPtr> open_output(const std::string& path, Size size, const TickRange& ticks,
                              const std::string& record, bool resume) {
    OutputPtr output(new Output);
    output->size = size;
    output->record = record;
    output->resume = resume;
    if (is_film(path)) {
        Result<FilmPtr> film = open_film(path, size, ticks.step, record, resume);
        if (!film) return film.error();
        output->film = std::move(*film);
        return output;
    }
    if (!has_ending(path, ".png") && !is_stream(path))
        return Error{"--out " + path + " must end in .png for pictures or in .mp4 for a film."};
    output->numbered = numbered_of(path);
    if (!output->numbered && count(ticks) > 1) {
        return Error{"--out " + path + " is one picture, but --frames asks for " +
                     std::to_string(count(ticks)) +
                     "; number them with DIR/%05d.png, or write a film: FILE.mp4."};
    }
    if (!output->numbered && resume)
        return Error{"--resume goes on with films and numbered pictures, and --out " + path + " is neither."};
    if (resume) {
        if (Result<void> same = check_pictures(*output, ticks); !same) return same.error();
    }
    if (output->numbered) {  // the longest name of all
        Result<PartFilePtr> last = open_file(path_for(*output->numbered, ticks.last));
        if (!last) return last.error();
    }
    if (is_written(*output, 0, ticks.first)) return output;
    Result<PartFilePtr> file = open_file(output->numbered ? path_for(*output->numbered, ticks.first) : path);
    if (!file) return file.error();
    output->first = std::move(*file);
    return output;
}

// Its last chunk is there: what was cut short is drawn anew.
static bool is_whole_png(const std::string& path) {
    constexpr std::string_view k_end("\0\0\0\0IEND\xae\x42\x60\x82", 12);
    std::ifstream file(path, std::ios::binary);
    char end[k_end.size()] = {};
    return file.seekg(-static_cast<std::streamoff>(k_end.size()), std::ios::end) &&
           file.read(end, sizeof end) && std::string_view(end, sizeof end) == k_end;
}

bool is_written(const Output& output, uint32_t number, uint32_t tick) {
    if (!output.resume) return false;
    if (output.film) return number < pictures_begun_with(*output.film);
    return is_whole_png(path_for(*output.numbered, tick));
}

Result<void> write_image(Output& output, const std::vector<uint8_t>& rgba, uint32_t tick, Alpha alpha) {
    if (output.film) return write_film(*output.film, rgba);
    PartFilePtr picture = std::move(output.first);
    if (!picture) {
        Result<PartFilePtr> file = open_file(path_for(*output.numbered, tick));
        if (!file) return file.error();
        picture = std::move(*file);
    }
    return write_png(std::move(picture), rgba, output.size, output.numbered ? output.record : "", alpha);
}

Result<void> finish_output(Output& output) {
    if (output.film) return finish_film(std::move(output.film));
    return {};
}

}  // namespace flaneur
