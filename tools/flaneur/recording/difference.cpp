#include "tools/flaneur/recording/difference.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>

#include "assets/files/file.h"
#include "sim/base/math.h"
#include "sim/pose/pose.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/console/ending.h"
#include "tools/flaneur/load/load.h"
#include "tools/flaneur/recording/chunks.h"
#include "tools/flaneur/recording/playing.h"
#include "tools/flaneur/recording/shown.h"

namespace flaneur {

namespace {

constexpr const char* k_joint_names[k_joint_count] = {
    "hips",           "spine",           "chest",           "upper_chest",     "neck",
    "head",           "left_shoulder",   "left_upper_arm",  "left_lower_arm",  "left_hand",
    "right_shoulder", "right_upper_arm", "right_lower_arm", "right_hand",      "left_upper_leg",
    "left_lower_leg", "left_foot",       "left_toes",       "right_upper_leg", "right_lower_leg",
    "right_foot",     "right_toes"};
static_assert(right_toes == 21 && left_upper_leg == 14 && left_shoulder == 6 && right_shoulder == 10 &&
              head == 5);

// One of both, at a tick. Of inputs a world is simulated beside it.
struct OneRecording {
    PlayingPtr playing;
    std::optional<Loaded> loaded;
    ColumnChunk columns;  // of inputs: of the one tick
    ColumnTick scratch;
};

struct SeenBody {
    std::array<Vec3, k_joint_count> places;
    std::array<Quat, k_joint_count> turns;
};
using SeenBodies = std::map<uint64_t, SeenBody>;

struct SeenTick {
    SeenBodies bodies;
    const ColumnChunk* columns = nullptr;
    uint32_t at = 0;  // tick, from the columns' first
};

struct SeenDifference {
    std::string what;    // "left_hand"
    double off = 0;      // metres or degrees
    std::string amount;  // "0.012 m"
    std::optional<WalkerId> walker;
};

Result<OneRecording> open_one(const std::string& path, const Options& options) {
    Result<PlayingPtr> playing = open_playing(path, options.threads);
    if (!playing) return playing.error();
    OneRecording side{std::move(*playing), {}, {}, {}};
    const RecordingHead& head = side.playing->head;
    if (head.as == RecordedAs::motion) return side;
    Options own = options;
    Result<Scene> scene = parse_scene(head.scene, head.scene_name);
    if (!scene) return Error{"The scene of " + path + " cannot be made: " + scene.error().message};
    own.scene = std::move(*scene);
    own.force = head.force;
    if (Result<void> found = find_files(own.scene); !found) return found.error();
    Result<Loaded> loaded = load(own);
    if (!loaded) return loaded.error();
    side.loaded = std::move(*loaded);
    return side;
}

float float_of(const SeenTick& s, const ColumnChunk::Column& c, uint32_t item, uint32_t word) {
    return std::bit_cast<float>(value_of(*s.columns, c, s.at, item, word));
}

const ColumnChunk::Column* column_of(const SeenTick& s, std::string_view name) {
    const auto at = s.columns->columns.find(name);
    return at == s.columns->columns.end() || at->second.items[s.at] == k_no_items ? nullptr : &at->second;
}

// SeenBodies that are told to the last bit are columns, sixteen side by side.
void take_exact(SeenTick& s) {
    const auto* slots = column_of(s, "living.slot");
    const auto* turns_there = column_of(s, "living.generation");
    const auto *origin = column_of(s, "poses.origin"), *places = column_of(s, "poses.places"),
               *turns = column_of(s, "poses.turns");
    if (!slots || !turns_there || !origin || !places || !turns) return;
    for (uint32_t i = 0; i < slots->items[s.at]; ++i) {
        const WalkerId id{value_of(*s.columns, *slots, s.at, i, 0),
                          value_of(*s.columns, *turns_there, s.at, i, 0)};
        const uint32_t block = id.index / k_block, lane = id.index % k_block;
        if (block >= std::min(places->items[s.at], turns->items[s.at])) continue;
        auto at = [&](const ColumnChunk::Column& c, size_t row) {
            return float_of(s, c, block, static_cast<uint32_t>(row) * k_block + lane);
        };
        SeenBody& body = s.bodies[body_id(id)];
        for (size_t j = 0; j < k_joint_count; ++j) {
            body.places[j] = Vec3{at(*origin, 0), at(*origin, 1), at(*origin, 2)} +
                             Vec3{at(*places, 3 * j), at(*places, 3 * j + 1), at(*places, 3 * j + 2)};
            body.turns[j] = {at(*turns, 4 * j), at(*turns, 4 * j + 1), at(*turns, 4 * j + 2),
                             at(*turns, 4 * j + 3)};
        }
    }
}

void take_tracks(const Replay& replay, uint32_t tick, SeenTick& s) {
    MotionPose pose;
    for (size_t i = 0; i < replay.motion.tracks.size(); ++i) {
        const RecordedMover& mover = replay.motion.tracks[i].mover;
        if (replay.trees[mover.tree].parents.size() != k_joint_count) continue;
        if (!pose_at(replay.motion, i, replay.trees, tick, pose)) continue;
        SeenBody& body = s.bodies[mover.id];
        for (size_t j = 0; j < k_joint_count; ++j)
            body.places[j] = pose.origin + pose.places[j], body.turns[j] = pose.turns[j];
    }
}

Result<SeenTick> see_tick(OneRecording& side, uint32_t tick) {
    SeenTick seen;
    Replay& replay = side.playing->replay;
    if (side.loaded) {
        World& w = *side.loaded->world;
        if (Result<void> shown = show_tick(*side.playing, w, tick); !shown) return shown.error();
        take_shown(w, w.poses, true, side.scratch);
        Result<ColumnChunk> columns = decode_columns(encode_columns({&side.scratch, 1}), tick, 1);
        if (!columns) return columns.error();
        side.columns = std::move(*columns);
        seen.columns = &side.columns;
    } else {
        Result<bool> has = seek_columns(replay, tick);
        if (has && *has) has = seek(replay, tick);
        if (!has) return has.error();
        if (!*has)
            return Error{replay.recording->path + " has nothing of tick " + std::to_string(tick) + "."};
        seen.columns = &replay.columns;
        seen.at = tick - replay.columns.first;
        take_tracks(replay, tick, seen);
    }
    take_exact(seen);
    return seen;
}

std::string told_amount(double value, const char* unit) {
    char text[48];
    std::snprintf(text, sizeof text, "%.3g %s", value, unit);
    return text;
}

// Of the smaller angle between both.
double degrees_between(Quat a, Quat b) {
    const double cosine = std::abs(static_cast<double>(a.x) * b.x + static_cast<double>(a.y) * b.y +
                                   static_cast<double>(a.z) * b.z + static_cast<double>(a.w) * b.w);
    const bool is_same = a.x == b.x && a.y == b.y && a.z == b.z && a.w == b.w;
    return is_same ? 0 : 2 * std::acos(std::min(cosine, 1.0)) * 180 / static_cast<double>(k_pi);
}

bool are_same(Vec3 a, Vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

// Half as many degrees as millimetres.
constexpr double k_degrees = 500;  // for a metre

// Whose joints differ, each by the one that differs most.
void compare_bodies(const SeenTick& here, const SeenTick& there, double within,
                    std::vector<SeenDifference>& found) {
    for (const auto& [id, a] : here.bodies) {
        const auto other = there.bodies.find(id);
        if (other == there.bodies.end()) {
            found.push_back({"is here alone", 0, "", walker_of(id)});
            continue;
        }
        const SeenBody& b = other->second;
        SeenDifference worst;
        for (size_t j = 0; j < k_joint_count; ++j) {
            const double off = static_cast<double>(length(a.places[j] - b.places[j]));
            if (off > within && off >= worst.off && !are_same(a.places[j], b.places[j]))
                worst = {std::string(k_joint_names[j]) + ", place", off, told_amount(off, "m"),
                         walker_of(id)};
        }
        for (size_t j = 0; j < k_joint_count && worst.what.empty(); ++j) {
            const double off = degrees_between(a.turns[j], b.turns[j]);
            if (off > within * k_degrees)
                worst = {std::string(k_joint_names[j]) + ", turn", off, told_amount(off, "degrees"),
                         walker_of(id)};
        }
        if (!worst.what.empty()) found.push_back(worst);
    }
    for (const auto& [id, b] : there.bodies)
        if (!here.bodies.contains(id)) found.push_back({"is there alone", 0, "", walker_of(id)});
}

std::string unit_of(std::string_view name) {
    for (const std::string_view angle : {"heading", "pitch", "steer", "gaze", "bend"})
        if (name.ends_with(angle)) return "radians";
    for (const std::string_view place :
         {"position", "place", "places", "middle", "grip", "hat", "at", "targets"})
        if (name.ends_with(place)) return "m";
    return "";
}

// What is no body's joint, each name by its first item that differs.
void compare_columns(const SeenTick& here, const SeenTick& there, double within,
                     std::vector<SeenDifference>& found) {
    for (const auto& [name, a] : here.columns->columns) {
        const auto* b = column_of(there, name);
        // SeenBodies were compared; and how what hangs on them drags is theirs.
        if (!b || !column_of(here, name) || a.words != b->words || name.starts_with("poses.") ||
            name.starts_with("trails."))
            continue;
        const uint32_t count = std::min(a.items[here.at], b->items[there.at]);
        if (a.items[here.at] != b->items[there.at]) {
            found.push_back(
                {name,
                 0,
                 std::to_string(a.items[here.at]) + " here, " + std::to_string(b->items[there.at]) + " there",
                 {}});
            continue;
        }
        // Steps that were taken are no difference.
        const double bound =
            std::max({within, static_cast<double>(a.step), static_cast<double>(b->step), 0.0});
        const bool is_float = a.step != 0 || b->step != 0, are_alike = a.step == b->step;
        for (uint32_t i = 0; i < count * a.words; ++i) {
            const uint32_t x = value_of(*here.columns, a, here.at, i / a.words, i % a.words),
                           y = value_of(*there.columns, *b, there.at, i / a.words, i % a.words);
            if (x == y) continue;
            const double off =
                std::abs(static_cast<double>(std::bit_cast<float>(x)) - std::bit_cast<float>(y));
            if (is_float && off <= (are_alike ? within : bound)) continue;
            const std::string words = is_float ? told_amount(off, unit_of(name).c_str())
                                               : std::to_string(x) + " here, " + std::to_string(y) + " there";
            found.push_back({name + " of number " + std::to_string(i / a.words), off, words, {}});
            break;
        }
    }
}

Error they_differ(uint32_t tick, const std::vector<SeenDifference>& bodies,
                  const std::vector<SeenDifference>& things) {
    std::printf("The first difference is after tick %u, at %.3f s:\n", tick, tick / 60.0);
    constexpr size_t k_most = 12;
    auto row = [](const SeenDifference& d) {
        const std::string who = d.walker ? "walker " + std::to_string(d.walker->index) : "";
        std::printf("  %-14s %-36s %s\n", who.c_str(), d.what.c_str(), d.amount.c_str());
    };
    for (size_t i = 0; i < std::min(bodies.size(), k_most); ++i) row(bodies[i]);
    if (bodies.size() > k_most) std::printf("  and %zu more walkers\n", bodies.size() - k_most);
    for (size_t i = 0; i < std::min(things.size(), k_most); ++i) row(things[i]);
    if (things.size() > k_most) std::printf("  and %zu more\n", things.size() - k_most);
    const SeenDifference& first = bodies.empty() ? things[0] : bodies[0];
    const std::string who = first.walker ? "walker " + std::to_string(first.walker->index) + ", " : "";
    return Error{"The two part at tick " + std::to_string(tick) + ": " + who + first.what +
                 (first.amount.empty() ? "" : ", " + first.amount) + "."};
}

// By slot, as walkers are called.
void sort_by_walker(std::vector<SeenDifference>& found) {
    std::ranges::stable_sort(found, {},
                             [](const SeenDifference& d) { return d.walker ? d.walker->index : 0; });
}

}  // namespace

Result<void> compare_recordings(const std::string& here, const std::string& there, float within,
                                const Options& options) {
    Result<OneRecording> a = open_one(here, options);
    if (!a) return a.error();
    Result<OneRecording> b = open_one(there, options);
    if (!b) return b.error();
    const uint32_t first = std::max(a->playing->first, b->playing->first),
                   last = std::min(a->playing->last, b->playing->last);
    if (first > last)
        return Error{"Nothing is compared: " + here + " and " + there + " have no tick in common."};
    if (a->playing->head.scene != b->playing->head.scene)
        say("The two are of other scenes: they may well differ.");
    const double bound = static_cast<double>(within);
    for (uint32_t tick = first; tick <= last; ++tick) {
        if (is_stopping()) return interrupted("they are equal to tick " + std::to_string(tick));
        if (tick % 60 == 0) show_progress("comparing, tick " + std::to_string(tick));
        const Result<SeenTick> x = see_tick(*a, tick);
        if (!x) return x.error();
        const Result<SeenTick> y = see_tick(*b, tick);
        if (!y) return y.error();
        std::vector<SeenDifference> bodies, things;
        compare_bodies(*x, *y, bound, bodies);
        compare_columns(*x, *y, bound, things);
        if (bodies.empty() && things.empty()) continue;
        clear_progress();
        sort_by_walker(bodies);
        return they_differ(tick, bodies, things);
    }
    clear_progress();
    const std::string as = within > 0 ? " within " + told_amount(bound * 1000, "mm") : "";
    std::printf("All %u ticks that both have, %u to %u, are equal%s.\n", last - first + 1, first, last,
                as.c_str());
    if (a->playing->first != b->playing->first || a->playing->last != b->playing->last)
        std::printf("%s has ticks %u to %u, %s %u to %u.\n", here.c_str(), a->playing->first,
                    a->playing->last, there.c_str(), b->playing->first, b->playing->last);
    return {};
}

}  // namespace flaneur
