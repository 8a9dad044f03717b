#include "tools/flaneur/output.h"

#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <optional>
#include <system_error>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#include <stb/stb_image_write.h>

#include "tools/flaneur/film.h"

namespace flaneur {

namespace fs = std::filesystem;

namespace {

Error cannot_write(const std::string& path, const std::string& why) {
    return Error{"Cannot write " + path + ": " + why + "."};
}

// Makes the missing folders above `path`; gives the topmost of them, or an empty text.
Result<std::string> make_folders(const std::string& path) {
    std::error_code error;
    std::string made;
    fs::path folder = fs::absolute(path).parent_path();
    for (fs::path p = folder; !p.empty() && !fs::exists(p, error) && !error; p = p.parent_path())
        made = p.string();
    if (!error) fs::create_directories(folder, error);
    if (error)
        return cannot_write(path,
                            "the folder " + folder.string() + " cannot be made (" + error.message() + ")");
    return made;
}

// A text with one place for a whole number, %d or %0Nd.
struct Numbered {
    std::string before, after;
    size_t digits = 0;
};

std::optional<Numbered> parse_numbered(const std::string& path) {
    size_t percent = path.find('%');
    if (percent == std::string::npos || path.find('%', percent + 1) != std::string::npos) return {};
    size_t end = path.find('d', percent);
    if (end == std::string::npos) return {};
    Numbered numbered{path.substr(0, percent), path.substr(end + 1)};
    const char* first = path.data() + percent + 1;
    const char* last = path.data() + end;
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

void PartFileDelete::operator()(PartFile* f) const {
    if (f->file) {
        std::fclose(f->file);
        std::error_code ignored;
        fs::remove(f->part, ignored);
        for (fs::path p = fs::absolute(f->path).parent_path(); !f->made_folder.empty(); p = p.parent_path()) {
            if (!fs::remove(p, ignored) || p == f->made_folder) break;
        }
    }
    delete f;
}

Result<PartFilePtr> open_file(const std::string& path) {
    std::error_code error;
    if (fs::is_directory(path, error)) return cannot_write(path, "it is a folder");
    Result<std::string> made = make_folders(path);
    if (!made) return made.error();
    PartFilePtr f(new PartFile);
    f->path = path;
    f->part = path + "." + std::to_string(getpid()) + ".part";
    f->made_folder = *made;
    f->file = std::fopen(f->part.c_str(), "wbe");
    if (!f->file) return cannot_write(path, std::strerror(errno));
    return f;
}

Result<void> keep_file(PartFilePtr f) {
    bool whole = std::fflush(f->file) == 0 && std::ferror(f->file) == 0;
    if (!whole) return cannot_write(f->path, std::strerror(errno));
    std::error_code error;
    fs::rename(f->part, f->path, error);
    if (error) return cannot_write(f->path, error.message());
    std::fclose(f->file);
    f->file = nullptr;
    return {};
}

Result<void> write_png(PartFilePtr f, const std::vector<uint8_t>& rgba, Size size) {
    size_t pixels = static_cast<size_t>(size.width) * static_cast<size_t>(size.height);
    assert(rgba.size() == pixels * 4);
    std::vector<uint8_t> rgb(pixels * 3);
    for (size_t i = 0; i < pixels; ++i) std::memcpy(&rgb[i * 3], &rgba[i * 4], 3);
    auto append = [](void* file, void* bytes, int count) {
        std::fwrite(bytes, 1, static_cast<size_t>(count), static_cast<FILE*>(file));
    };
    if (!stbi_write_png_to_func(append, f->file, size.width, size.height, 3, rgb.data(), size.width * 3))
        return cannot_write(f->path, "there is not enough memory to compress the picture");
    return keep_file(std::move(f));
}

struct Output {
    Size size;
    PartFilePtr first;  // one picture; of numbered ones the first, opened early to see that it can be written
    std::optional<Numbered> numbered;
    FilmPtr film;
};

void OutputDelete::operator()(Output* output) const { delete output; }

Result<OutputPtr> open_output(const std::string& path, Size size, const TickRange& ticks) {
    OutputPtr output(new Output);
    output->size = size;
    if (path.ends_with(".mp4")) {
        Result<FilmPtr> film = open_film(path, size, ticks.step);
        if (!film) return film.error();
        output->film = std::move(*film);
        return output;
    }
    if (!path.ends_with(".png"))
        return Error{"--out " + path + " must end in .png for pictures or in .mp4 for a film."};
    output->numbered = parse_numbered(fs::path(path).filename().string());
    if (output->numbered) {
        output->numbered->before = (fs::path(path).parent_path() / output->numbered->before).string();
    } else if (count(ticks) > 1) {
        return Error{"--out " + path + " is one picture, but --frames asks for " +
                     std::to_string(count(ticks)) +
                     "; number them with DIR/%05d.png, or write a film: FILE.mp4."};
    }
    Result<PartFilePtr> file = open_file(output->numbered ? path_for(*output->numbered, ticks.first) : path);
    if (!file) return file.error();
    output->first = std::move(*file);
    return output;
}

Result<void> write_image(Output& output, const std::vector<uint8_t>& rgba, uint32_t tick) {
    if (output.film) return write_film(*output.film, rgba);
    if (output.first) return write_png(std::move(output.first), rgba, output.size);
    Result<PartFilePtr> file = open_file(path_for(*output.numbered, tick));
    if (!file) return file.error();
    return write_png(std::move(*file), rgba, output.size);
}

Result<void> finish_output(Output& output) {
    if (output.film) return finish_film(std::move(output.film));
    return {};
}

}  // namespace flaneur
