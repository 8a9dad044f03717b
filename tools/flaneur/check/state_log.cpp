#include "tools/flaneur/check/state_log.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>

#include "assets/files/file.h"
#include "assets/files/words.h"
#include "tools/flaneur/console/ending.h"
#include "tools/flaneur/options/shell_words.h"

namespace flaneur {
namespace {

constexpr std::string_view k_kind = "flaneur state log ", k_version = "2";
constexpr std::array<std::string_view, 13> k_world_options = {
    "--scene",     "--city", "--center",  "--radius", "--terrain", "--scale", "--seed",
    "--character", "--idle", "--walkers", "--time",   "--side",    "--demand"};
constexpr std::array<std::string_view, 2> k_world_flags = {"--force", "--stay"};

constexpr size_t k_longest_line = 1 << 16;
constexpr size_t k_most_fields = 10'000, k_most_walkers = 1'000'000, k_most_ticks = 60'000'000;
constexpr size_t k_most_words = 1'000;  // of a command
constexpr size_t k_chunk = 1 << 16;

Error cut_short(const StateLogReader& log) {
    return Error{"The state log " + log.name +
                 " is cut short: who wrote it did not come to its end. Write it anew."};
}

Error not_one(const StateLogReader& log, const std::string& why) {
    return Error{log.name + " is no state log that can be read, for " + why +
                 ". Write one by `flaneur sim --state-log FILE`."};
}

Error damaged(const StateLogReader& log) {
    return Error{"The state log " + log.name +
                 " is damaged: copy it again, or write it anew if it was never whole."};
}

// Some more bytes; false: there are none.
Result<bool> read_more(StateLogReader& log) {
    log.read.erase(log.read.begin(), log.read.begin() + static_cast<ptrdiff_t>(log.taken));
    log.taken = 0;
    for (;;) {
        if (is_stopping()) return interrupted();
        pollfd waits{log.from, POLLIN, 0};
        constexpr int k_ms = 50;
        if (poll(&waits, 1, k_ms) == 0) continue;
        const size_t had = log.read.size();
        log.read.resize(had + k_chunk);
        const ssize_t got = read(log.from, log.read.data() + had, k_chunk);
        log.read.resize(had + (got > 0 ? static_cast<size_t>(got) : 0));
        if (got >= 0) return got > 0;
        if (errno != EINTR) return Error{"Cannot read " + log.name + ": " + std::strerror(errno) + "."};
    }
}

Result<void> take(StateLogReader& log, void* to, size_t size) {
    while (log.read.size() - log.taken < size) {
        const Result<bool> more = read_more(log);
        if (!more) return more.error();
        if (!*more) return cut_short(log);
    }
    if (size > 0) std::memcpy(to, log.read.data() + log.taken, size);
    log.sum = sum_bytes(log.sum, {log.read.data() + log.taken, size});
    log.taken += size;
    return {};
}

Result<std::string> take_line(StateLogReader& log) {
    for (size_t looked = 0;;) {
        const std::string_view there(log.read.data() + log.taken, log.read.size() - log.taken);
        const size_t end = there.find('\n', looked);
        if (end != std::string_view::npos) {
            log.taken += end + 1;
            log.sum = sum_bytes(log.sum, there.substr(0, end + 1));
            return std::string(there.substr(0, end));
        }
        looked = there.size();
        if (looked > k_longest_line) return not_one(log, "a line of it does not end");
        const Result<bool> more = read_more(log);
        if (!more) return more.error();
        if (!*more) return cut_short(log);
    }
}

// Whether the line begins with `key`, a space and what then is its `rest`.
bool is_line_of(std::string_view line, std::string_view key, std::string_view& rest) {
    if (!line.starts_with(key) || line.size() < key.size() + 2 || line[key.size()] != ' ') return false;
    rest = line.substr(key.size() + 1);
    return true;
}

// "f gait.left.phase"
bool parse_field(std::string_view text, std::vector<StateField>& fields) {
    const bool is_sound = text.size() > 2 && text[1] == ' ' &&
                          std::string_view("fiuhFIUH").find(text[0]) != std::string_view::npos;
    if (!is_sound || fields.size() >= k_most_fields) return false;
    fields.push_back({std::string(text.substr(2)), text[0]});
    return true;
}

// Holds all bytes of a file against the sum at its end. Of a pipe it knows nothing.
Result<void> check_file(const StateLogReader& log) {
    const off_t size = lseek(log.from, 0, SEEK_END);
    if (size < 0) return {};
    if (lseek(log.from, static_cast<off_t>(log.read.size()), SEEK_SET) < 0) return damaged(log);
    uint64_t sum = k_no_bytes, its = 0;
    const off_t summed = size - static_cast<off_t>(sizeof its);
    std::vector<char> bytes(k_chunk);
    for (off_t at = 0; at < summed;) {
        if (is_stopping()) return interrupted();
        const auto most = static_cast<size_t>(std::min<off_t>(k_chunk, summed - at));
        const ssize_t got = pread(log.from, bytes.data(), most, at);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return damaged(log);
        sum = sum_bytes(sum, {bytes.data(), static_cast<size_t>(got)});
        at += got;
    }
    if (pread(log.from, &its, sizeof its, summed) != sizeof its || its != sum) return damaged(log);
    return {};
}

bool put(StateLogWriter& log, std::string_view bytes) {
    log.sum = sum_bytes(log.sum, bytes);
    return std::fwrite(bytes.data(), 1, bytes.size(), log.file) == bytes.size();
}

template <class T>
bool put_list(StateLogWriter& log, const std::vector<T>& list) {
    return put(log, {reinterpret_cast<const char*>(list.data()), list.size() * sizeof(T)});
}

bool put_number(StateLogWriter& log, uint64_t number) {
    return put(log, {reinterpret_cast<const char*>(&number), sizeof number});
}

bool parse_count(std::string_view text, size_t most, uint32_t& to) {
    return parse_number(text, to) && to <= most;
}

}  // namespace

std::vector<std::string> world_words(const std::vector<std::string>& words) {
    return only_options(words, k_world_options, k_world_flags);
}

Result<void> write_state_log_head(StateLogWriter& log, const StateLogHead& head) {
    std::string text = std::string(k_kind).append(k_version).append("\n");
    auto add = [&](std::string_view key, const std::string& value) {
        text.append(key).append(" ").append(value).append("\n");
    };
    for (const std::string& word : head.words) {
        if (word.empty() || word.find('\n') != std::string::npos)
            return Error{"A state log has no room for a name with a line break, as in " + excerpt(word) +
                         "; give the file another name."};
        add("word", word);
    }
    add("walkers", std::to_string(head.walkers));
    add("last", std::to_string(head.last));
    for (const StateField& f : head.fields.walkers) add("walker", std::string{f.kind, ' '} + f.name);
    for (const StateField& f : head.fields.crowd) add("crowd", std::string{f.kind, ' '} + f.name);
    text += '\n';
    (void)put(log, text);  // what fails is told by who writes on
    return {};
}

bool write_digest(StateLogWriter& log, const StateDigest& digest) {
    return put_number(log, digest.hash) && put_list(log, digest.fields) && put_list(log, digest.walkers);
}

bool write_state_words(StateLogWriter& log, const std::vector<uint32_t>& words) {
    return put_list(log, words) && put_number(log, log.sum);
}

Result<void> read_state_log_head(StateLogReader& log) {
    std::array<char, k_kind.size()> kind{};
    if (Result<void> begun = take(log, kind.data(), kind.size()); !begun)
        return is_stopping() ? begun.error() : not_one(log, "it begins otherwise");
    if (std::string_view(kind.data(), kind.size()) != k_kind) return not_one(log, "it begins otherwise");
    log.is_one = true;
    const Result<std::string> version = take_line(log);
    if (!version) return version.error();
    if (*version != k_version)
        return not_one(log, "it is of version " + excerpt(*version) + ", and this flaneur reads version " +
                                std::string(k_version));
    if (Result<void> whole = check_file(log); !whole) return whole;
    StateLogHead head;
    bool has_walkers = false, has_last = false;
    for (;;) {
        const Result<std::string> line = take_line(log);
        if (!line) return line.error();
        if (line->empty()) break;
        std::string_view rest;
        bool is_sound = true;
        if (is_line_of(*line, "word", rest))
            head.words.emplace_back(rest);
        else if (is_line_of(*line, "walkers", rest))
            is_sound = has_walkers = parse_count(rest, k_most_walkers, head.walkers);
        else if (is_line_of(*line, "last", rest))
            is_sound = has_last = parse_count(rest, k_most_ticks, head.last);
        else if (is_line_of(*line, "walker", rest))
            is_sound = parse_field(rest, head.fields.walkers);
        else if (is_line_of(*line, "crowd", rest))
            is_sound = parse_field(rest, head.fields.crowd);
        else
            is_sound = false;
        if (!is_sound || head.words.size() > k_most_words)
            return not_one(log, "its line " + excerpt(*line) + " is not understood");
    }
    if (!has_walkers || !has_last) return not_one(log, "it does not say how many walkers and ticks it has");
    // Nothing but a world may be asked for by a file.
    if (world_words(head.words) != head.words)
        return not_one(log, "it has words that are no world's: " + excerpt(shell_line(head.words)));
    log.head = std::move(head);
    return {};
}

Result<void> read_digest(StateLogReader& log, StateDigest& digest) {
    digest.fields.resize(log.head.fields.walkers.size() + log.head.fields.crowd.size());
    digest.walkers.resize(log.head.walkers);
    if (Result<void> taken = take(log, &digest.hash, sizeof digest.hash); !taken) return taken;
    for (auto* list : {&digest.fields, &digest.walkers})
        if (Result<void> taken = take(log, list->data(), list->size() * sizeof(uint16_t)); !taken)
            return taken;
    return {};
}

Result<std::vector<uint32_t>> read_state_words(StateLogReader& log) {
    std::vector<uint32_t> words;
    auto add = [&](size_t count) {
        const size_t had = words.size();
        words.resize(had + count);
        return take(log, words.data() + had, count * sizeof(uint32_t));
    };
    for (uint32_t i = 0; i < log.head.walkers; ++i)
        if (Result<void> taken = add(log.head.fields.walkers.size()); !taken) return taken.error();
    if (Result<void> taken = add(log.head.fields.crowd.size()); !taken) return taken.error();
    const uint64_t sum = log.sum;
    uint64_t its = 0;
    if (Result<void> taken = take(log, &its, sizeof its); !taken) return taken.error();
    const Result<bool> more = log.read.size() > log.taken ? Result<bool>(true) : read_more(log);
    if (!more) return more.error();
    if (its != sum || *more) return damaged(log);
    return words;
}

}  // namespace flaneur
