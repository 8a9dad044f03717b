#include "tools/flaneur/export/motion.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>

#include "assets/files/file.h"
#include "sim/base/tick.h"
#include "sim/world.h"
#include "tools/extract/extract.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/export/people.h"
#include "tools/flaneur/export/source.h"
#include "tools/flaneur/motion/bvh.h"
#include "tools/flaneur/tracks/record.h"

namespace flaneur {

namespace {

constexpr size_t k_most_poses = 500'000;  // of 784 bytes each

Error too_many() {
    return {"That is more than " + std::to_string(k_most_poses) +
            " poses, people times frames, which no program opens with ease: choose fewer with --walkers, "
            "--seconds or --fps."};
}

std::string told(double number, const char* unit) {
    char text[40];
    std::snprintf(text, sizeof text, "%.1f %s", number, unit);
    return text;
}

void tell(const std::string& path, size_t bytes) {
    say("Wrote " + path + ", " + told(static_cast<double>(bytes) / 1e6, "MB"));
}

// Frames in which it is not there are as the one before.
std::string bvh_of(const GlbPerson& person, double fps) {
    std::vector<JointPoses> ticks;
    for (size_t i = 0; i < person.frames.size(); ++i) {
        while (i > 0 && ticks.size() < person.frames[i] - person.frames[0]) ticks.push_back(ticks.back());
        ticks.push_back(joints_of(person, i));
    }
    return bvh_text(scaled_body(person.character->body, person.scale), ticks, fps);
}

Result<void> write_bvh(PartFilePtr file, const GlbGroup& group) {
    const double fps = group.fps;
    auto write = [&](PartFilePtr own, const GlbPerson& person) -> Result<void> {
        const std::string text = bvh_of(person, fps), to = own->path;
        if (Result<void> kept = write_file(std::move(own), text); !kept) return kept;
        tell(to + ", from " + told(person.frames[0] / fps, "s"), text.size());
        return {};
    };
    if (group.people.size() == 1) return write(std::move(file), group.people[0]);
    const std::filesystem::path path = file->path;
    file.reset();
    for (const GlbPerson& person : group.people) {
        std::string name = person.name;
        std::ranges::replace(name, ' ', '_');
        Result<PartFilePtr> own = open_file((path.parent_path() / path.stem() / (name + ".bvh")).string());
        if (!own) return own.error();
        if (Result<void> kept = write(std::move(*own), person); !kept) return kept;
    }
    return {};
}

}  // namespace

Result<void> export_motion(const Options& options, PartFilePtr file) {
    Result<ExportSource> opened = open_source(options);
    if (!opened) return opened.error();
    ExportSource& source = *opened;
    const uint32_t fps = options.exported.fps > 0 ? options.exported.fps : k_ticks_a_second;
    PeopleTaking taking;
    taking.wanted = options.exported.walkers;
    taking.has_their_numbers = !source.playing;
    taking.group.fps = static_cast<float>(fps);
    const Result<void> done = for_each_tick(source, [&](const World& world) -> Result<void> {
        take_people(taking, world, source.loaded.characters, world.tick - source.first);
        return taking.poses > k_most_poses ? Result<void>(too_many()) : Result<void>();
    });
    if (!done) return done;
    if (Result<void> good = check_seen(options, {taking.seen.begin(), taking.seen.end()}); !good) return good;
    if (has_ending(file->path, ".bvh")) return write_bvh(std::move(file), taking.group);
    show_progress("writing " + file->path);
    const std::string bytes = group_glb(taking.group), path = file->path;
    if (bytes.size() >= 0xffffffffu) return too_many();
    if (Result<void> kept = write_file(std::move(file), bytes); !kept) return kept;
    tell(path + ": " + std::to_string(taking.group.people.size()) +
             (taking.group.people.size() == 1 ? " person, " : " people, ") +
             told(taking.group.frames / static_cast<double>(fps), "s"),
         bytes.size());
    return {};
}

}  // namespace flaneur
