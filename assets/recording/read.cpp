#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zstd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <tuple>

#include "assets/recording/container_form.h"

namespace flaneur {

namespace {

// Fewer bytes than asked for where the file ends.
std::string read_at(int file, uint64_t offset, size_t size) {
    std::string bytes(size, '\0');
    size_t done = 0;
    while (done < size) {
        const ssize_t got = pread(file, bytes.data() + done, size - done, static_cast<off_t>(offset + done));
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) break;
        done += static_cast<size_t>(got);
    }
    bytes.resize(done);
    return bytes;
}

uint64_t size_of(int file) {
    struct stat status {};
    return fstat(file, &status) == 0 ? static_cast<uint64_t>(status.st_size) : 0;
}

bool is_whole(const Recording& recording, const ChunkPlace& chunk) {
    const std::string stored = read_at(recording.file, chunk.offset + k_chunk_head, chunk.stored);
    return stored.size() == chunk.stored && sum_of(stored) == chunk.sum;
}

// Ahead from where the last whole chunk ended. Only of the last one are the bytes themselves looked at here:
// those before it were written whole before it was begun.
void scan(Recording& recording, uint64_t size) {
    std::vector<ChunkPlace> found;
    uint64_t at = recording.end;
    while (size - at >= k_chunk_head) {
        const std::optional<ChunkPlace> chunk =
            read_chunk_head(read_at(recording.file, at, k_chunk_head), at);
        if (!chunk || chunk->stored > size - at - k_chunk_head) break;
        found.push_back(*chunk);
        at += k_chunk_head + chunk->stored;
    }
    while (!found.empty() && !is_whole(recording, found.back())) {
        at = found.back().offset;
        found.pop_back();
    }
    recording.end = at;
    for (const ChunkPlace& chunk : found) {
        if (chunk.kind == k_index_chunk) {
            recording.is_finished = true;
        } else {
            recording.chunks.push_back(chunk);
        }
    }
}

// The chunks of a file that was finished, as its index has them; false where it has none that is sound.
bool take_index(Recording& recording, uint64_t size) {
    if (size < k_file_head + k_chunk_head + k_file_tail) return false;
    const std::string tail = read_at(recording.file, size - k_file_tail, k_file_tail);
    std::string_view rest = tail;
    uint64_t offset = 0;
    if (!take_number(rest, offset) || rest != k_recording_end || offset > size - k_file_tail - k_chunk_head)
        return false;
    const std::optional<ChunkPlace> index =
        read_chunk_head(read_at(recording.file, offset, k_chunk_head), offset);
    if (!index || index->kind != k_index_chunk || index->stored != size - k_file_tail - k_chunk_head - offset)
        return false;
    const Result<std::string> entries = read_chunk(recording, *index);
    if (!entries || entries->size() % k_index_entry != 0) return false;
    std::string_view bytes = *entries;
    std::vector<ChunkPlace> chunks(entries->size() / k_index_entry);
    uint64_t at = k_file_head;
    for (ChunkPlace& chunk : chunks) {
        if (!take_number(bytes, chunk.offset) || !take_chunk(bytes, chunk) || chunk.offset != at)
            return false;
        at += k_chunk_head + chunk.stored;
        if (at > offset) return false;
    }
    if (at != offset) return false;
    recording.chunks = std::move(chunks);
    recording.end = size - k_file_tail;
    recording.is_finished = true;
    return true;
}

bool comes_before(const ChunkPlace& a, const ChunkPlace& b) {
    return std::tie(a.kind, a.first) < std::tie(b.kind, b.first);
}

}  // namespace

Recording::~Recording() {
    if (file >= 0) close(file);
}

Result<void> refresh(Recording& recording) {
    const uint64_t size = size_of(recording.file);
    if (size < recording.end)
        return Error{recording.path + " has become shorter since it was opened: open it again."};
    if (!recording.is_finished) scan(recording, size);
    recording.left_out = size - recording.end;
    if (recording.is_finished)  // the index's own tail, where it is whole
        recording.left_out -= std::min<uint64_t>(recording.left_out, k_file_tail);
    std::stable_sort(recording.chunks.begin(), recording.chunks.end(), comes_before);
    return {};
}

Result<RecordingPtr> open_recording(const std::string& path) {
    auto recording = std::make_unique<Recording>();
    recording->path = path;
    recording->file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    struct stat status {};
    if (recording->file < 0 || fstat(recording->file, &status) != 0 || !S_ISREG(status.st_mode))
        return Error{path + " cannot be opened as a file; check the path, and that it may be read."};
    const std::string begin = read_at(recording->file, 0, k_file_head);
    std::string_view bytes = begin;
    if (!bytes.starts_with(k_recording_magic) || bytes.size() < k_file_head)
        return Error{path + " is no recording: it does not begin as one does. Make one with --record."};
    bytes.remove_prefix(k_recording_magic.size());
    uint32_t format = 0;
    take_number(bytes, format);
    if (format == 0 || format > k_recording_format)
        return Error{path + " is a recording of format " + std::to_string(format) +
                     ", and this program reads format " + std::to_string(k_recording_format) +
                     ": take the version that made it, or a later one."};
    recording->end = k_file_head;
    take_index(*recording, size_of(recording->file));
    if (Result<void> looked = refresh(*recording); !looked) return looked.error();
    const std::vector<ChunkPlace> heads = chunks_of(*recording, k_head_chunk);
    if (heads.empty() || heads[0].offset != k_file_head)
        return Error{path +
                     " is a recording that was cut short before it said what it is of: record it again."};
    Result<std::string> head = read_chunk(*recording, heads[0]);
    if (!head) return head.error();
    recording->head = std::move(*head);
    return recording;
}

Result<std::string> read_chunk(const Recording& recording, const ChunkPlace& chunk) {
    const Error broken{recording.path + " is damaged at byte " + std::to_string(chunk.offset) +
                       ": what stands there is not what was written. Copy it anew, or record it again."};
    // Before anything is allocated: a chunk that is no longer there, or never was.
    const uint64_t size = size_of(recording.file), begin = chunk.offset + k_chunk_head;
    if (begin > size || chunk.stored > size - begin) return broken;
    std::string stored = read_at(recording.file, begin, chunk.stored);
    if (stored.size() != chunk.stored || sum_of(stored) != chunk.sum) return broken;
    if (chunk.stored == chunk.whole) return stored;
    if (ZSTD_getFrameContentSize(stored.data(), stored.size()) != chunk.whole) return broken;
    std::string whole(chunk.whole, '\0');
    const size_t got = ZSTD_decompress(whole.data(), whole.size(), stored.data(), stored.size());
    if (ZSTD_isError(got) || got != chunk.whole) return broken;
    return whole;
}

const ChunkPlace* chunk_at(const Recording& recording, uint32_t kind, uint32_t tick) {
    ChunkPlace asked;
    asked.kind = kind;
    asked.first = tick;
    const auto after =
        std::upper_bound(recording.chunks.begin(), recording.chunks.end(), asked, comes_before);
    if (after == recording.chunks.begin()) return nullptr;
    const ChunkPlace& chunk = *std::prev(after);
    return chunk.kind == kind && tick - chunk.first < chunk.ticks ? &chunk : nullptr;
}

std::vector<ChunkPlace> chunks_of(const Recording& recording, uint32_t kind) {
    std::vector<ChunkPlace> some;
    for (const ChunkPlace& chunk : recording.chunks)
        if (chunk.kind == kind) some.push_back(chunk);
    return some;
}

}  // namespace flaneur
