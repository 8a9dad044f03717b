#include <fcntl.h>
#include <unistd.h>
#include <zstd.h>

#include <cassert>
#include <cerrno>
#include <cstring>

#include "assets/recording/container_form.h"

namespace flaneur {

namespace {

// Packs what is text or numbers side by side; what the coder of waves made has nothing left to pack.
constexpr int k_packing = 3;

Error not_written(const std::string& path) {
    return {"Cannot write " + path + ": " + std::strerror(errno) +
            ". Check that the folder is there, may be written to, and has room."};
}

}  // namespace

struct RecordingWriter {
    std::string path;
    int file = -1;
    uint64_t size = 0;
    std::vector<ChunkPlace> chunks;
    std::string bytes;  // of the chunk that is being written
};

void RecordingWriterDelete::operator()(RecordingWriter* writer) const {
    if (writer->file >= 0) close(writer->file);
    delete writer;
}

// At the file's end; what cannot be written whole is taken back.
static Result<void> append(RecordingWriter& writer, std::string_view bytes) {
    size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t wrote = pwrite(writer.file, bytes.data() + done, bytes.size() - done,
                                     static_cast<off_t>(writer.size + done));
        if (wrote > 0) {
            done += static_cast<size_t>(wrote);
        } else if (wrote == 0 || errno != EINTR) {
            const Error error = not_written(writer.path);
            (void)!ftruncate(writer.file, static_cast<off_t>(writer.size));
            return error;
        }
    }
    writer.size += bytes.size();
    return {};
}

Result<RecordingWriterPtr> begin_recording(const std::string& path, std::string_view head) {
    RecordingWriterPtr writer(new RecordingWriter);
    writer->path = path;
    writer->file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (writer->file < 0) return not_written(path);
    std::string bytes(k_recording_magic);
    put_number(bytes, k_recording_format);
    put_number(bytes, uint32_t{0});
    if (Result<void> begun = append(*writer, bytes); !begun) return begun.error();
    if (Result<void> added = add_chunk(*writer, k_head_chunk, 0, 0, head); !added) return added.error();
    return writer;
}

Result<void> add_chunk(RecordingWriter& writer, uint32_t kind, uint32_t first, uint32_t ticks,
                       std::string_view bytes) {
    assert(bytes.size() <= k_most_chunk_bytes);
    ChunkPlace chunk{writer.size, kind, first, ticks, 0, static_cast<uint32_t>(bytes.size()), 0};
    std::string& packed = writer.bytes;
    packed.resize(k_chunk_head + ZSTD_compressBound(bytes.size()));
    const size_t size = ZSTD_compress(packed.data() + k_chunk_head, packed.size() - k_chunk_head,
                                      bytes.data(), bytes.size(), k_packing);
    if (!ZSTD_isError(size) && size < bytes.size()) {
        packed.resize(k_chunk_head + size);
    } else {
        packed.resize(k_chunk_head);
        packed += bytes;
    }
    const std::string_view stored = std::string_view(packed).substr(k_chunk_head);
    chunk.stored = static_cast<uint32_t>(stored.size());
    chunk.sum = sum_of(stored);
    packed.replace(0, k_chunk_head, chunk_head(chunk));
    if (Result<void> written = append(writer, packed); !written) return written;
    writer.chunks.push_back(chunk);
    return {};
}

Result<void> finish_recording(RecordingWriterPtr writer) {
    std::string entries;
    for (const ChunkPlace& chunk : writer->chunks) {
        put_number(entries, chunk.offset);
        put_chunk(entries, chunk);
    }
    std::string tail;
    put_number(tail, writer->size);
    tail += k_recording_end;
    if (entries.size() <= k_most_chunk_bytes) {
        if (Result<void> added = add_chunk(*writer, k_index_chunk, 0, 0, entries); !added) return added;
        if (Result<void> ended = append(*writer, tail); !ended) return ended;
    }
    const int file = std::exchange(writer->file, -1);
    return close(file) == 0 ? Result<void>() : not_written(writer->path);
}

uint64_t bytes_of(const RecordingWriter& writer) { return writer.size; }

}  // namespace flaneur
