#include "tools/flaneur/recording/playing.h"

#include <algorithm>
#include <cstring>

#include "assets/recording/recorder.h"
#include "sim/base/tick.h"
#include "sim/state.h"
#include "tools/flaneur/console/ending.h"
#include "tools/flaneur/recording/chunks.h"
#include "tools/flaneur/recording/program.h"
#include "tools/flaneur/recording/shown.h"

namespace flaneur {

namespace {

const std::string& path_of(const Playing& p) { return p.replay.recording->path; }

// The last of a kind at a tick or before it; null: there is none.
const ChunkPlace* chunk_before(const Recording& recording, uint32_t kind, uint32_t tick) {
    const ChunkPlace* found = nullptr;
    for (const ChunkPlace& chunk : recording.chunks)
        if (chunk.kind == kind && chunk.first <= tick) found = &chunk;
    return found;
}

Error lacks(const Playing& p, uint32_t tick) {
    return {path_of(p) + " has nothing of tick " + std::to_string(tick) + ": it has ticks " +
            std::to_string(p.first) + " to " + std::to_string(p.last) + "."};
}

void find_ticks(Playing& p) {
    const uint32_t kind = p.head.as == RecordedAs::motion ? k_columns_chunk : k_hash_chunk;
    bool is_any = false;
    for (const ChunkPlace& chunk : p.replay.recording->chunks) {
        if (chunk.kind != kind || chunk.ticks == 0) continue;
        p.first = is_any ? std::min(p.first, chunk.first) : chunk.first;
        p.last = is_any ? std::max(p.last, chunk.first + chunk.ticks - 1) : chunk.first + chunk.ticks - 1;
        is_any = true;
    }
    if (!is_any) p.first = 1, p.last = 0;
}

// Bodies by their joints.
void put_bodies(const Playing& p, uint32_t tick, World& w) {
    const MotionChunk& motion = p.replay.motion;
    parallel_for(*w.workers, motion.tracks.size(), 64, [&](size_t begin, size_t end, int) {
        MotionPose pose;
        for (size_t i = begin; i < end; ++i) {
            const uint32_t slot = walker_of(motion.tracks[i].mover.id).index;
            if (slot >= w.crowd.count || !pose_at(motion, i, p.replay.trees, tick, pose)) continue;
            const uint32_t tree = motion.tracks[i].mover.tree;
            if (p.replay.trees[tree].parents.size() != k_joint_count) continue;
            PoseBlock& block = w.poses[slot / k_block];
            const int lane = lane_of(slot);
            const float origin[3] = {pose.origin.x, pose.origin.y, pose.origin.z};
            for (size_t axis = 0; axis < 3; ++axis) block.origin[axis][lane] = origin[axis];
            for (size_t j = 0; j < k_joint_count; ++j) {
                const Vec3 at = pose.places[j];
                const Quat turn = pose.turns[j];
                const float place[3] = {at.x, at.y, at.z}, rotation[4] = {turn.x, turn.y, turn.z, turn.w};
                for (size_t axis = 0; axis < 3; ++axis) block.position[j][axis][lane] = place[axis];
                for (size_t axis = 0; axis < 4; ++axis) block.rotation[j][axis][lane] = rotation[axis];
            }
        }
    });
}

void note_who(Playing& p, const World& w) {
    p.before.assign(w.crowd.count, k_nobody);
    for (const WalkerId id : w.crowd.slots.living) p.before[id.index] = id.generation;
}

void copy_lane(const PoseBlock& from, int lane, PoseBlock& to) {
    for (size_t row = 0; row < sizeof(PoseBlock) / sizeof(float) / k_block; ++row) {
        const size_t at = (row * k_block + static_cast<size_t>(lane)) * sizeof(float);
        std::memcpy(reinterpret_cast<std::byte*>(&to) + at, reinterpret_cast<const std::byte*>(&from) + at,
                    sizeof(float));
    }
}

// Who has come was here the tick before too, and stood still.
void stand_comers(const Playing& p, World& w) {
    for (const WalkerId id : w.crowd.slots.living) {
        if (id.index < p.before.size() && p.before[id.index] == id.generation) continue;
        const size_t block = id.index / k_block;
        copy_lane(w.poses[block], lane_of(id.index), w.previous_poses[block]);
        if (p.has_trails) continue;
        for (auto* trails : {&w.trails, &w.previous_trails}) forget_trail(*trails, id.index);
    }
}

// One tick, the one after the world's or any.
Result<void> put_tick(Playing& p, World& w, uint32_t tick) {
    Result<bool> has = seek_columns(p.replay, tick);
    if (has && *has) has = seek(p.replay, tick);
    if (!has) return has.error();
    if (!*has) return lacks(p, tick);
    note_who(p, w);
    const ColumnChunk& columns = p.replay.columns;
    put_shown(columns, tick - columns.first, w);
    put_bodies(p, tick, w);
    p.has_trails = columns.columns.contains("trails.moving");
    stand_comers(p, w);
    if (!p.has_trails)
        parallel_for(*w.workers, w.poses.size(), 4, [&](size_t begin, size_t end, int) {
            advance_trails(w.previous_poses, w.poses, begin, end, k_tick, w.previous_trails, w.trails);
        });
    p.shown = tick;
    return {};
}

Result<void> show_motion(Playing& p, World& w, uint32_t tick) {
    if (p.shown == tick) return {};
    if (p.shown && *p.shown + 1 == tick) return put_tick(p, w, tick);
    // What drags behind bodies lags by a tenth of a second: after some of those it hangs as it did.
    constexpr uint32_t k_lags = 30;
    const Result<bool> has = seek_columns(p.replay, tick);
    if (!has) return has.error();
    if (!*has) return lacks(p, tick);
    const uint32_t before = p.replay.columns.columns.contains("trails.moving") ? 1 : k_lags;
    uint32_t from = std::max(tick - std::min(before, tick), p.first);
    while (from < tick && !chunk_at(*p.replay.recording, k_columns_chunk, from)) ++from;
    w.crowd.slots.living.clear();  // so that everybody has come
    for (uint32_t t = from; t <= tick; ++t)
        if (Result<void> put = put_tick(p, w, t); !put) return put;
    return {};
}

Result<void> put_state(const Playing& p, const ChunkPlace& chunk, World& w) {
    const Result<std::string> bytes = read_chunk(*p.replay.recording, chunk);
    if (!bytes) return bytes.error();
    Result<void> loaded = load_state(w, std::as_bytes(std::span(bytes->data(), bytes->size())));
    if (!loaded) return Error{path_of(p) + ": " + loaded.error().message};
    return {};
}

Result<void> show_inputs(Playing& p, World& w, uint32_t tick) {
    const Recording& recording = *p.replay.recording;
    const ChunkPlace* near = chunk_before(recording, k_state_chunk, tick > p.first ? tick - 1 : tick);
    const ChunkPlace* change = chunk_before(recording, k_change_chunk, tick > p.first ? tick - 1 : tick);
    if (near && change && change->first >= near->first) near = change;
    if (!near || tick < p.first) return lacks(p, tick);
    const bool is_on_the_way = p.shown && *p.shown == w.tick && w.tick <= tick && w.tick >= near->first;
    if (!is_on_the_way)
        if (Result<void> put = put_state(p, *near, w); !put) return put;
    while (w.tick < tick) {
        if (is_stopping()) return interrupted();
        step(w);
        p.shown = w.tick;
        const ChunkPlace* now = chunk_before(recording, k_change_chunk, w.tick);
        if (now && now->first == w.tick)
            if (Result<void> put = put_state(p, *now, w); !put) return put;
    }
    p.shown = w.tick;
    return {};
}

}  // namespace

Result<PlayingPtr> open_playing(const std::string& path, int threads) {
    Result<Replay> replay = open_replay(path, threads);
    if (!replay) return replay.error();
    Result<RecordingHead> head = parse_recording_head(path, replay->recording->head);
    if (!head) return head.error();
    if (head->as == RecordedAs::inputs && head->program != this_program())
        return Error{path + " was recorded as inputs by flaneur " + head->program + ", and this is flaneur " +
                     this_program() +
                     ", which may simulate otherwise: replay it with that one, or record it "
                     "as motion, which any version shows."};
    auto playing = std::make_unique<Playing>();
    playing->head = std::move(*head);
    playing->replay = std::move(*replay);
    find_ticks(*playing);
    if (playing->first > playing->last)
        return Error{path +
                     " holds no tick: it was cut short before the first half second was written. Record "
                     "it again."};
    return playing;
}

Result<void> look_again(Playing& playing) {
    Result<void> looked = refresh(*playing.replay.recording);
    if (looked) find_ticks(playing);
    return looked;
}

Result<void> show_tick(Playing& p, World& w, uint32_t tick) {
    if (tick < p.first || tick > p.last) return lacks(p, tick);
    return p.head.as == RecordedAs::motion ? show_motion(p, w, tick) : show_inputs(p, w, tick);
}

Result<std::optional<uint64_t>> hash_at(const Recording& recording, uint32_t tick) {
    const ChunkPlace* chunk = chunk_at(recording, k_hash_chunk, tick);
    if (!chunk) return std::optional<uint64_t>();
    const Result<std::string> bytes = read_chunk(recording, *chunk);
    if (!bytes) return bytes.error();
    uint64_t hash = 0;
    if (bytes->size() != sizeof hash)
        return Error{recording.path + " is damaged at byte " + std::to_string(chunk->offset) +
                     ": a hash of another size. Record it again."};
    std::memcpy(&hash, bytes->data(), sizeof hash);
    return std::optional(hash);
}

}  // namespace flaneur
