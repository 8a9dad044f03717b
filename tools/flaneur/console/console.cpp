#include "tools/flaneur/console/console.h"

#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <mutex>

namespace flaneur {

namespace {

std::mutex progress_mutex;
std::string progress;

bool is_terminal() {
    static const bool terminal = isatty(STDERR_FILENO) != 0;
    return terminal;
}

// The bytes of the UTF-8 character that `text` begins with; 0 where it begins with none.
size_t character_length(std::string_view text) {
    auto byte = [&](size_t i) { return i < text.size() ? static_cast<uint8_t>(text[i]) : 0u; };
    auto follows = [&](size_t i) { return (byte(i) & 0xc0u) == 0x80; };
    if (byte(0) < 0x80) return 1;
    if (byte(0) >= 0xc2 && byte(0) < 0xe0 && follows(1)) return 2;
    if (byte(0) >= 0xe0 && byte(0) < 0xf0 && follows(1) && follows(2))
        return byte(0) == 0xe0 && byte(1) < 0xa0 ? 0 : 3;
    if (byte(0) >= 0xf0 && byte(0) < 0xf5 && follows(1) && follows(2) && follows(3))
        return byte(0) == 0xf0 && byte(1) < 0x90 ? 0 : 4;
    return 0;
}

// What steers a terminal, breaks a line, or has what follows shown from right to left.
bool is_control(std::string_view character) {
    auto byte = [&](size_t i) { return static_cast<uint8_t>(character[i]); };
    if (character.size() == 1) return byte(0) < 0x20 || byte(0) == 0x7f;
    if (character.size() == 2)
        return (byte(0) == 0xc2 && byte(1) < 0xa0) || character == "\u061c";  // U+0080 to U+009F
    if (byte(0) != 0xe2) return false;
    bool is_mark = character == "\u200e" || character == "\u200f";
    bool is_separator = character == "\u2028" || character == "\u2029";
    bool is_embedding = character >= "\u202a" && character <= "\u202e";
    bool is_isolate = character >= "\u2066" && character <= "\u2069";
    return is_mark || is_separator || is_embedding || is_isolate;
}

}  // namespace

std::string printable(std::string_view text) {
    std::string out;
    while (!text.empty()) {
        size_t length = character_length(text);
        std::string_view character = text.substr(0, length == 0 ? 1 : length);
        if (length > 0 && !is_control(character)) {
            out += character;
        } else {
            for (char c : character) {
                char code[8];
                std::snprintf(code, sizeof code, "\\x%02x", static_cast<unsigned>(static_cast<uint8_t>(c)));
                out += code;
            }
        }
        text.remove_prefix(character.size());
    }
    return out;
}

void say(std::string_view line) {
    clear_progress();
    std::fprintf(stderr, "%s\n", printable(line).c_str());
}

void show_progress(const std::string& line) {
    std::lock_guard lock(progress_mutex);
    if (is_terminal() && !(line.empty() && progress.empty()))
        std::fprintf(stderr, "\r\033[K%s", printable(line).c_str());
    progress = line;
}

void clear_progress() { show_progress(""); }

std::string progress_line() {
    std::lock_guard lock(progress_mutex);
    return progress;
}

}  // namespace flaneur
