#include "tools/flaneur/output/parts.h"

#include <cstdio>
#include <filesystem>

#include "assets/files/file.h"
#include "assets/files/picture.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/console/ending.h"
#include "tools/flaneur/output/film.h"
#include "tools/flaneur/output/output.h"
#include "tools/flaneur/output/record.h"

namespace flaneur {

namespace {

namespace fs = std::filesystem;

std::string parts_folder(const std::string& film) { return film + ".parts"; }
std::string plan_path(const std::string& film) { return parts_folder(film) + "/plan"; }
// As many digits as the last of all ticks has.
std::string parts_pattern(const std::string& film) { return parts_folder(film) + "/%08d.png"; }

// Which film the pictures are of: in a file a line of numbers, and the record.
struct FilmPlan {
    TickRange ticks;
    Size size;
    std::string record;
};

std::string told_plan_frames(const TickRange& t) {
    return std::to_string(t.first) + ":" + std::to_string(t.last) + ":" + std::to_string(t.step);
}

std::string told_plan(const FilmPlan& plan) {
    return told_plan_frames(plan.ticks) + " " + std::to_string(plan.size.width) + "x" +
           std::to_string(plan.size.height) + "\n" + plan.record + "\n";
}

Result<FilmPlan> read_film_plan(const std::string& film) {
    constexpr size_t k_most_bytes = 1 << 20;
    const std::string path = plan_path(film);
    const Result<Bytes> bytes = read_bytes(path, k_most_bytes);
    if (!bytes)
        return Error{"The plan of parts, " + path + ", " + bytes.error().message +
                     ". Parts are drawn first: flaneur render --shard 1/8 --out " + film + ", and so on."};
    const std::string text(bytes->begin(), bytes->end());
    FilmPlan plan;
    const size_t line = text.find('\n');
    const bool is_plan = line != std::string::npos &&
                         std::sscanf(text.c_str(), "%u:%u:%u %dx%d", &plan.ticks.first, &plan.ticks.last,
                                     &plan.ticks.step, &plan.size.width, &plan.size.height) == 5 &&
                         plan.ticks.first <= plan.ticks.last && plan.ticks.last <= k_last_tick &&
                         plan.ticks.step > 0;
    if (is_plan) plan.record = text.substr(line + 1, text.size() - line - 2);
    if (!is_plan || told_plan(plan) != text)
        return Error{path + " is no plan of a film, or is damaged; remove " + parts_folder(film) +
                     " and draw the parts again."};
    return plan;
}

Result<void> check_film_plan(const std::string& film, const FilmPlan& now) {
    const Result<FilmPlan> begun = read_film_plan(film);
    if (!begun) return begun.error();
    if (Result<void> same = check_record(parts_folder(film), begun->record, now.record); !same) return same;
    if (told_plan(*begun) == told_plan(now)) return {};
    return Error{"Cannot go on with " + parts_folder(film) + ": its film is of --frames " +
                 told_plan_frames(begun->ticks) + ", not " + told_plan_frames(now.ticks) +
                 ". Give another --out, or remove that folder."};
}

// Refuses what has not all its pictures, before any is read.
Result<void> check_all_drawn(const std::string& film, const FilmPlan& plan) {
    const Result<OutputPtr> pictures =
        open_output(parts_pattern(film), plan.size, plan.ticks, plan.record, true);
    if (!pictures) return pictures.error();
    uint32_t missing = 0, first = 0;
    for (uint32_t i = count(plan.ticks); i-- > 0;) {
        const uint32_t tick = plan.ticks.first + i * plan.ticks.step;
        if (is_written(**pictures, i, tick)) continue;
        ++missing;
        first = tick;
    }
    if (missing == 0) return {};
    return Error{film + " lacks " + std::to_string(missing) + " of its " + std::to_string(count(plan.ticks)) +
                 " pictures, the first that of tick " + std::to_string(first) +
                 ". Run the parts that are not done again: they draw what is missing."};
}

Result<std::vector<uint8_t>> read_part_picture(const std::string& path, Size size) {
    const size_t pixels = static_cast<size_t>(size.width) * static_cast<size_t>(size.height);
    const Result<Bytes> bytes = read_bytes(path, size_t{1} << 30);
    if (!bytes) return Error{path + " " + bytes.error().message + "."};
    Result<DecodedPicture> picture =
        decode_picture({reinterpret_cast<const uint8_t*>(bytes->data()), bytes->size()}, pixels);
    if (!picture) return Error{path + " " + picture.error().message + "; remove it and draw its part again."};
    if (picture->width != size.width || picture->height != size.height)
        return Error{path + " has another size than its film; remove it and draw its part again."};
    return std::move(picture->rgba);
}

}  // namespace

PictureSpan pictures_of(Shard shard, uint32_t pictures) {
    auto begin = [&](uint32_t number) {
        return static_cast<uint32_t>(uint64_t{pictures} * number / shard.of);
    };
    return {begin(shard.number - 1), begin(shard.number)};
}

Result<std::string> begin_parts(const std::string& out, Size size, const TickRange& ticks,
                                const std::string& record) {
    if (is_stream(out) || (!is_film(out) && picture_path(out, 0) == out))
        return Error{"--shard draws parts of films and of numbered pictures, and --out " + out +
                     " is neither: give FILE.mp4 or DIR/%05d.png."};
    if (!is_film(out)) return out;
    const FilmPlan plan{ticks, size, record};
    // Who comes second, of two that write it at once, writes the same.
    if (std::error_code ignored; !fs::exists(plan_path(out), ignored))
        if (Result<void> written = write_file(plan_path(out), told_plan(plan)); !written)
            return written.error();
    if (Result<void> same = check_film_plan(out, plan); !same) return same.error();
    return parts_pattern(out);
}

Result<void> join_parts(const std::string& path) {
    if (!is_film(path)) return Error{"join makes a film of its parts: say flaneur join FILE.mp4."};
    const Result<FilmPlan> plan = read_film_plan(path);
    if (!plan) return plan.error();
    if (Result<void> drawn = check_all_drawn(path, *plan); !drawn) return drawn;
    Result<FilmPtr> film = open_film(path, plan->size, plan->ticks.step, plan->record, false);
    if (!film) return film.error();
    const uint32_t pictures = count(plan->ticks);
    for (uint32_t i = 0; i < pictures; ++i) {
        if (is_stopping()) return interrupted();
        show_progress("joining, picture " + std::to_string(i + 1) + " of " + std::to_string(pictures));
        const uint32_t tick = plan->ticks.first + i * plan->ticks.step;
        Result<std::vector<uint8_t>> rgba =
            read_part_picture(picture_path(parts_pattern(path), tick), plan->size);
        if (!rgba) return rgba.error();
        if (Result<void> written = write_film(**film, *rgba); !written) return written;
    }
    if (Result<void> finished = finish_film(std::move(*film)); !finished) return finished;
    clear_progress();
    say("Wrote " + path + " of " + std::to_string(pictures) + " pictures; " + parts_folder(path) +
        " may be removed");
    return {};
}

}  // namespace flaneur
