#include "tools/flaneur/history/history.h"

#include <sys/resource.h>
#include <zlib.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <limits>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <utility>

#include "sim/state.h"

namespace flaneur {
namespace {

using Bytes = std::vector<std::byte>;
using Moment = std::chrono::steady_clock::time_point;

Moment now() { return std::chrono::steady_clock::now(); }

constexpr size_t k_chunk = size_t{64} << 10;
// States that are not packed yet: so many, in so much of the memory, but one in any case.
constexpr size_t k_most_waiting = 8, k_waiting_share = 4;
// States nearer together than k_history_ticks, as looking back and forth brings them, last so long.
constexpr uint32_t k_dense_reach = 120;
// Ticks at which what is kept may lie half as far apart as what is twice as old.
constexpr double k_young = 600;

double ms_since(Moment start) { return std::chrono::duration<double, std::milli>(now() - start).count(); }

// A piece of a state. What does not change from state to state is the same piece.
struct Chunk {
    Bytes packed;
    size_t size;                 // unpacked
    std::atomic<size_t>& total;  // bytes of all chunks that are there
    Chunk(Bytes bytes, size_t unpacked, std::atomic<size_t>& all)
        : packed(std::move(bytes)), size(unpacked), total(all) {
        total += packed.size();
    }
    ~Chunk() { total -= packed.size(); }
    Chunk(const Chunk&) = delete;
    Chunk& operator=(const Chunk&) = delete;
};
using ChunkPtr = std::shared_ptr<const Chunk>;

struct Kept {
    uint32_t tick = 0;
    bool is_for_good = false;
    Bytes raw;  // until it is packed
    std::vector<ChunkPtr> chunks;
};
using KeptPtr = std::shared_ptr<Kept>;

// Numbers of four bytes side by side have their high bytes in common, so these come together first.
Bytes spread(std::span<const std::byte> from) {
    Bytes to(from.size());
    const size_t words = from.size() / 4;
    for (size_t part = 0; part < 4; ++part)
        for (size_t i = 0; i < words; ++i) to[part * words + i] = from[i * 4 + part];
    std::copy(from.begin() + static_cast<std::ptrdiff_t>(words * 4), from.end(),
              to.begin() + static_cast<std::ptrdiff_t>(words * 4));
    return to;
}

void gather(const Bytes& from, std::byte* to) {
    const size_t words = from.size() / 4;
    for (size_t part = 0; part < 4; ++part)
        for (size_t i = 0; i < words; ++i) to[i * 4 + part] = from[part * words + i];
    std::copy(from.begin() + static_cast<std::ptrdiff_t>(words * 4), from.end(), to + words * 4);
}

// As it is where packing it would gain nothing.
ChunkPtr pack(std::span<const std::byte> from, Bytes& scratch, std::atomic<size_t>& total) {
    Bytes parts = spread(from);
    scratch.resize(compressBound(static_cast<uLong>(parts.size())));
    uLong size = static_cast<uLong>(scratch.size());
    const int done = compress2(reinterpret_cast<Bytef*>(scratch.data()), &size,
                               reinterpret_cast<const Bytef*>(parts.data()), static_cast<uLong>(parts.size()),
                               Z_BEST_SPEED);
    if (done == Z_OK && size < parts.size())
        parts.assign(scratch.begin(), scratch.begin() + static_cast<std::ptrdiff_t>(size));
    parts.shrink_to_fit();
    return std::make_shared<const Chunk>(std::move(parts), from.size(), total);
}

bool unpack(const Chunk& chunk, Bytes& scratch, std::byte* to) {
    if (chunk.packed.size() == chunk.size) {
        gather(chunk.packed, to);
        return true;
    }
    scratch.resize(chunk.size);
    uLong size = static_cast<uLong>(chunk.size);
    const int done = uncompress(reinterpret_cast<Bytef*>(scratch.data()), &size,
                                reinterpret_cast<const Bytef*>(chunk.packed.data()),
                                static_cast<uLong>(chunk.packed.size()));
    if (done != Z_OK || size != chunk.size) return false;
    gather(scratch, to);
    return true;
}

bool is_same(std::span<const std::byte> a, std::span<const std::byte> b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size()) == 0;
}

std::span<const std::byte> chunk_of(const Bytes& bytes, size_t index) {
    const size_t first = std::min(index * k_chunk, bytes.size());
    return std::span(bytes).subspan(first, std::min(k_chunk, bytes.size() - first));
}

}  // namespace

struct History {
    std::atomic<size_t> chunk_bytes = 0;  // outlives the chunks
    mutable std::mutex mutex;
    mutable std::condition_variable changed;
    std::vector<KeptPtr> kept;  // rising ticks
    std::vector<KeptPtr> waiting;
    std::vector<Bytes> spare;  // whose memory is used again
    // The state that was packed last, with which the next one shares what is the same.
    Bytes last;
    std::vector<ChunkPtr> last_chunks;
    size_t most_bytes = k_history_bytes;
    HistoryUse use;
    bool ends = false;
    bool is_packing = false;
    std::thread packer;
};

namespace {

auto place_of(const History& h, uint32_t tick) {
    return std::lower_bound(h.kept.begin(), h.kept.end(), tick,
                            [](const KeptPtr& kept, uint32_t at) { return kept->tick < at; });
}

size_t bytes_of(const History& h) {
    size_t bytes = h.chunk_bytes.load() + h.last.capacity();
    for (const Bytes& some : h.spare) bytes += some.capacity();
    for (const KeptPtr& some : h.waiting) bytes += some->raw.capacity();
    for (const KeptPtr& some : h.kept) bytes += some->chunks.capacity() * sizeof(ChunkPtr);
    return bytes;
}

void erase(History& h, size_t index) {
    const KeptPtr gone = h.kept[index];
    h.kept.erase(h.kept.begin() + static_cast<std::ptrdiff_t>(index));
    std::erase(h.waiting, gone);
}

// Whose absence would be felt least: the smallest gap for its age. Neither the first nor the last, nor any
// for good; none if only these are left.
std::optional<size_t> least_missed(const History& h) {
    std::optional<size_t> found;
    double least = std::numeric_limits<double>::max();
    for (size_t i = 1; i + 1 < h.kept.size(); ++i) {
        if (h.kept[i]->is_for_good || !h.kept[i]->raw.empty()) continue;
        const double gap = h.kept[i + 1]->tick - h.kept[i - 1]->tick,
                     age = h.kept.back()->tick - h.kept[i]->tick, felt = gap / (age + k_young);
        if (felt < least) least = felt, found = i;
    }
    return found;
}

void thin_out(History& h, size_t most) {
    while (bytes_of(h) > most) {
        const std::optional<size_t> least = least_missed(h);
        if (!least) break;
        erase(h, *least);
    }
}

// Those that lie close together far from `now`.
void thin_dense(History& h, uint32_t now) {
    for (size_t i = h.kept.size(); i-- > 2;) {
        const Kept& middle = *h.kept[i - 1];
        const uint32_t off = std::max(middle.tick, now) - std::min(middle.tick, now);
        if (off <= k_dense_reach || middle.is_for_good || !middle.raw.empty()) continue;
        if (h.kept[i]->tick - h.kept[i - 2]->tick <= k_history_ticks) erase(h, i - 1);
    }
}

// The chunks of `raw`, those of the state packed last where they are the same.
std::vector<ChunkPtr> packed(const Bytes& raw, History& h) {
    std::vector<ChunkPtr> chunks((raw.size() + k_chunk - 1) / k_chunk);
    Bytes scratch;
    for (size_t i = 0; i < chunks.size(); ++i) {
        const auto piece = chunk_of(raw, i);
        const bool is_known = i < h.last_chunks.size() && is_same(piece, chunk_of(h.last, i));
        chunks[i] = is_known ? h.last_chunks[i] : pack(piece, scratch, h.chunk_bytes);
    }
    return chunks;
}

void run_packer(History& h) {
    // Behind all who move and draw people; of this thread alone.
    constexpr int k_niceness = 5;
    setpriority(PRIO_PROCESS, 0, k_niceness);
    std::unique_lock lock(h.mutex);
    for (;;) {
        h.changed.wait(lock, [&] { return h.ends || !h.waiting.empty(); });
        if (h.ends) return;
        const KeptPtr kept = h.waiting.front();
        h.is_packing = true;
        const size_t before = h.chunk_bytes;
        lock.unlock();
        const Moment start = now();
        // Nobody else changes what waits, nor what was packed last.
        std::vector<ChunkPtr> chunks = packed(kept->raw, h);
        const double took = ms_since(start);
        lock.lock();
        h.is_packing = false;
        h.use.pack_ms = took;
        h.use.packed_bytes = h.chunk_bytes - std::min(before, h.chunk_bytes.load());
        h.last_chunks = chunks;
        h.last.swap(kept->raw);
        if (h.spare.empty()) h.spare.push_back(std::move(kept->raw));
        kept->raw = {};
        kept->chunks = std::move(chunks);
        std::erase(h.waiting, kept);
        thin_out(h, h.most_bytes);
        h.changed.notify_all();
    }
}

// With the lock held by `lock`.
void keep(History& h, const World& world, bool is_for_good) {
    const auto at = place_of(h, world.tick);
    if (at != h.kept.end() && (*at)->tick == world.tick) {
        (*at)->is_for_good |= is_for_good;
        return;
    }
    // Room for this one, as it is and packed, and for those that wait, packed.
    const size_t wanted = (2 + h.waiting.size()) * h.use.state_bytes;
    thin_out(h, h.most_bytes - std::min(h.most_bytes, wanted));
    auto kept = std::make_shared<Kept>();
    kept->tick = world.tick;
    kept->is_for_good = is_for_good;
    if (!h.spare.empty()) {
        kept->raw = std::move(h.spare.back());
        h.spare.pop_back();
    }
    const auto start = now();
    save_state(world, kept->raw);
    h.use.copy_ms = ms_since(start);
    h.use.state_bytes = kept->raw.size();
    h.kept.insert(place_of(h, world.tick), kept);
    h.waiting.push_back(kept);
    thin_dense(h, world.tick);
    h.changed.notify_all();
}

// Whether one more can be copied.
bool has_room(const History& h) {
    if (h.waiting.empty()) return true;
    const size_t waiting = (h.waiting.size() + 1) * h.use.state_bytes;
    return h.waiting.size() < k_most_waiting && waiting <= h.most_bytes / k_waiting_share;
}

}  // namespace

HistoryPtr make_history(size_t most_bytes) {
    HistoryPtr history(new History);
    history->most_bytes = most_bytes;
    history->packer = std::thread([&h = *history] { run_packer(h); });
    return history;
}

void HistoryDelete::operator()(History* history) const {
    {
        const std::lock_guard lock(history->mutex);
        history->ends = true;
        history->changed.notify_all();
    }
    history->packer.join();
    delete history;
}

void set_most_bytes(History& h, size_t most_bytes) {
    const std::lock_guard lock(h.mutex);
    h.most_bytes = most_bytes;
    thin_out(h, most_bytes);
}

void follow(History& h, const World& world) {
    const std::lock_guard lock(h.mutex);
    const auto after = place_of(h, world.tick + 1);
    if (after != h.kept.begin()) {
        const uint32_t before = (*std::prev(after))->tick;
        if (world.tick - before < k_history_ticks) return;
        // Where the past was thinned out on purpose, looking at it again does not fill it up.
        if (after != h.kept.end()) return;
    }
    if (has_room(h)) keep(h, world, false);
}

void keep_now(History& h, const World& world) {
    const std::lock_guard lock(h.mutex);
    if (has_room(h)) keep(h, world, false);
}

void keep_for_good(History& h, const World& world) {
    const std::lock_guard lock(h.mutex);
    while (!h.kept.empty() && h.kept.back()->tick >= world.tick) erase(h, h.kept.size() - 1);
    keep(h, world, true);
}

void forget(History& h) {
    const std::lock_guard lock(h.mutex);
    while (!h.kept.empty()) erase(h, h.kept.size() - 1);
}

std::vector<uint32_t> kept_ticks(const History& h) {
    const std::lock_guard lock(h.mutex);
    std::vector<uint32_t> ticks;
    for (const KeptPtr& kept : h.kept) ticks.push_back(kept->tick);
    return ticks;
}

std::optional<uint32_t> kept_before(const History& h, uint32_t tick) {
    const std::lock_guard lock(h.mutex);
    auto at = place_of(h, tick);
    if (at != h.kept.end() && (*at)->tick == tick) return tick;
    return at == h.kept.begin() ? std::nullopt : std::optional((*std::prev(at))->tick);
}

bool is_for_good(const History& h, uint32_t tick) {
    const std::lock_guard lock(h.mutex);
    const auto at = place_of(h, tick);
    return at != h.kept.end() && (*at)->tick == tick && (*at)->is_for_good;
}

Result<void> restore(const History& h, uint32_t tick, World& world) {
    std::vector<ChunkPtr> chunks;
    {
        const std::lock_guard lock(h.mutex);
        const auto at = place_of(h, tick);
        if (at == h.kept.end() || (*at)->tick != tick)
            return Error{"Nothing is kept of tick " + std::to_string(tick) + "."};
        if (!(*at)->raw.empty()) return load_state(world, (*at)->raw);
        chunks = (*at)->chunks;
    }
    size_t size = 0;
    for (const ChunkPtr& chunk : chunks) size += chunk->size;
    Bytes raw(size), scratch;
    size_t first = 0;
    for (const ChunkPtr& chunk : chunks) {
        if (!unpack(*chunk, scratch, raw.data() + first))
            return Error{"What is kept of tick " + std::to_string(tick) + " is damaged."};
        first += chunk->size;
    }
    return load_state(world, raw);
}

HistoryUse history_use(const History& h) {
    const std::lock_guard lock(h.mutex);
    HistoryUse use = h.use;
    use.states = h.kept.size();
    use.bytes = bytes_of(h);
    return use;
}

void settle(const History& h) {
    std::unique_lock lock(h.mutex);
    h.changed.wait(lock, [&] { return h.waiting.empty() && !h.is_packing; });
}

}  // namespace flaneur
