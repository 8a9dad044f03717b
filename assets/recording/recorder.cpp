#include "assets/recording/recorder.h"

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "assets/recording/container.h"

namespace flaneur {

static_assert(k_trees_chunk == chunk_kind("tree") && k_motion_chunk == chunk_kind("moti") &&
              k_columns_chunk == chunk_kind("cols"));

// The ticks of a chunk.
struct Filling {
    MotionFrames motion;
    std::array<ColumnTick, k_chunk_ticks> columns;
    bool has_columns = false;
};

struct Recorder {
    RecorderOptions options;
    WorkersPtr workers;
    std::unique_ptr<Filling> filling = std::make_unique<Filling>();
    std::vector<BoneTree> trees;  // all that were added

    // Between both threads.
    mutable std::mutex mutex;
    std::condition_variable changed;
    std::unique_ptr<Filling> encoding = std::make_unique<Filling>();
    std::vector<BoneTree> known;  // trees of what is being encoded
    RecordingWriterPtr writer;
    bool is_full = false;  // `encoding` waits, or is being encoded
    bool ends = false;
    Result<void> written;
    RecorderCount count;

    std::thread thread;
};

namespace {

// What the thread does for each chunk, apart from the lock.
void encode(Recorder& r, size_t& trees_written, uint32_t& chunks, MotionMeans& key) {
    const MotionFrames& frames = r.encoding->motion;
    const std::string trees = encode_trees(std::span<const BoneTree>(r.known).subspan(trees_written));
    const bool is_key = chunks++ % k_chunks_to_a_key == 0;
    EncodedMotion encoded =
        encode_motion(frames, r.known, r.options.bound, is_key ? nullptr : &key, *r.workers);
    const std::string& bytes = encoded.bytes;
    if (is_key) key = std::move(encoded.means);
    std::string columns;
    if (r.encoding->has_columns) columns = encode_columns(std::span(r.encoding->columns).first(frames.ticks));
    const std::lock_guard lock(r.mutex);
    Result<void> written = r.written;
    if (written && std::max(bytes.size(), columns.size()) > k_most_chunk_bytes)
        written = Error{"More moves than a recording can hold: record fewer walkers."};
    if (written && trees_written < r.known.size())
        written = add_chunk(*r.writer, k_trees_chunk, frames.first, 0, trees);
    if (written && r.encoding->has_columns)
        written = add_chunk(*r.writer, k_columns_chunk, frames.first, frames.ticks, columns);
    if (written) written = add_chunk(*r.writer, k_motion_chunk, frames.first, frames.ticks, bytes);
    trees_written = r.known.size();
    r.written = written;
    r.count.missed += encoded.missed;
}

void run(Recorder& r) {
    size_t trees_written = 0;
    uint32_t chunks = 0;
    MotionMeans key;
    while (true) {
        {
            std::unique_lock lock(r.mutex);
            r.changed.wait(lock, [&] { return r.is_full || r.ends; });
            if (!r.is_full) return;
        }
        encode(r, trees_written, chunks, key);
        {
            const std::lock_guard lock(r.mutex);
            r.is_full = false;
        }
        r.changed.notify_all();
    }
}

// Hands over what was filled.
Result<void> hand_over(Recorder& r) {
    if (r.filling->motion.ticks == 0) return {};
    {
        std::unique_lock lock(r.mutex);
        if (r.is_full) ++r.count.waits;
        r.changed.wait(lock, [&] { return !r.is_full; });
        if (!r.written) return r.written;
        std::swap(r.filling, r.encoding);
        r.known = r.trees;
        r.is_full = true;
    }
    r.changed.notify_all();
    r.filling->motion.ticks = 0;
    return {};
}

void end(Recorder& r) {
    if (!r.thread.joinable()) return;
    {
        const std::lock_guard lock(r.mutex);
        r.ends = true;
    }
    r.changed.notify_all();
    r.thread.join();
}

}  // namespace

void RecorderDelete::operator()(Recorder* recorder) const {
    end(*recorder);
    delete recorder;
}

Result<RecorderPtr> begin_recorder(const std::string& path, std::string_view head,
                                   const RecorderOptions& options) {
    Result<RecordingWriterPtr> writer = begin_recording(path, head);
    if (!writer) return writer.error();
    RecorderPtr recorder(new Recorder);
    recorder->options = options;
    recorder->workers = make_workers(options.threads);
    recorder->writer = std::move(*writer);
    recorder->thread = std::thread([r = recorder.get()] { run(*r); });
    return recorder;
}

uint32_t add_tree(Recorder& recorder, const BoneTree& tree) {
    recorder.trees.push_back(tree);
    return static_cast<uint32_t>(recorder.trees.size() - 1);
}

static Result<void> take_tick(Recorder& r, uint32_t tick, const std::vector<PoseBlock>& poses,
                              std::span<const BodyMember> bodies, std::span<const RigidMember> things,
                              ColumnTick* columns) {
    const MotionFrames& so_far = r.filling->motion;
    if (so_far.ticks == k_chunk_ticks || (so_far.ticks > 0 && tick != so_far.first + so_far.ticks))
        if (Result<void> handed = hand_over(r); !handed) return handed;
    MotionFrames& frames = r.filling->motion;
    if (frames.ticks == 0) frames.first = tick;
    r.filling->has_columns = columns;
    if (columns) std::swap(*columns, r.filling->columns[frames.ticks]);
    take_poses(poses, bodies, things, frames.frames[frames.ticks++]);
    return frames.ticks == k_chunk_ticks ? hand_over(r) : Result<void>();
}

Result<void> add_tick(Recorder& recorder, uint32_t tick, const std::vector<PoseBlock>& poses,
                      std::span<const BodyMember> bodies, std::span<const RigidMember> things) {
    return take_tick(recorder, tick, poses, bodies, things, nullptr);
}

Result<void> add_tick(Recorder& recorder, uint32_t tick, const std::vector<PoseBlock>& poses,
                      std::span<const BodyMember> bodies, std::span<const RigidMember> things,
                      ColumnTick& columns) {
    return take_tick(recorder, tick, poses, bodies, things, &columns);
}

Result<void> add_other(Recorder& r, uint32_t kind, uint32_t first, uint32_t ticks, std::string_view bytes) {
    const std::lock_guard lock(r.mutex);
    if (r.written) r.written = add_chunk(*r.writer, kind, first, ticks, bytes);
    return r.written;
}

RecorderCount count_of(const Recorder& r) {
    const std::lock_guard lock(r.mutex);
    RecorderCount count = r.count;
    count.bytes = bytes_of(*r.writer);
    return count;
}

Result<RecorderCount> finish_recorder(RecorderPtr recorder) {
    const Result<void> handed = hand_over(*recorder);
    end(*recorder);
    if (!handed) return handed.error();
    if (!recorder->written) return recorder->written.error();
    const RecorderCount count = count_of(*recorder);
    if (Result<void> finished = finish_recording(std::move(recorder->writer)); !finished)
        return finished.error();
    return count;
}

}  // namespace flaneur
