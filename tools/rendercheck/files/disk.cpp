#include "tools/rendercheck/files/disk.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

namespace flaneur {
namespace {

struct Descriptor {
    int number = -1;
    explicit Descriptor(int opened) : number(opened) {}
    ~Descriptor() {
        if (number >= 0) close(number);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
};

std::string why() { return std::strerror(errno); }

// Fewer bytes where the file ends.
bool read_all(int file, uint8_t* to, size_t& count) {
    size_t done = 0;
    while (done < count) {
        const ssize_t got = read(file, to + done, count - done);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return false;
        if (got == 0) break;
        done += static_cast<size_t>(got);
    }
    count = done;
    return true;
}

}  // namespace

Result<std::vector<uint8_t>> read_whole(const std::string& path, size_t most) {
    const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    struct stat facts {};
    if (file.number < 0 || fstat(file.number, &facts) != 0)
        return Error{path + " cannot be read: " + why() + "."};
    if (!S_ISREG(facts.st_mode)) return Error{path + " is no regular file."};
    const auto size = static_cast<size_t>(facts.st_size);
    if (size > most)
        return Error{path + " has " + std::to_string(size) + " bytes, more than the " + std::to_string(most) +
                     " that are read."};
    std::vector<uint8_t> bytes(size);
    size_t count = size;
    if (!read_all(file.number, bytes.data(), count)) return Error{path + " cannot be read: " + why() + "."};
    bytes.resize(count);
    return bytes;
}

Result<void> write_whole(const std::string& path, std::span<const uint8_t> bytes) {
    std::error_code failed;
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    if (!folder.empty()) std::filesystem::create_directories(folder, failed);
    std::string part = path + ".part-XXXXXX";
    const Descriptor file(mkostemp(part.data(), O_CLOEXEC));
    if (file.number < 0) return Error{"Cannot write " + path + ": " + why() + "."};
    size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t put = write(file.number, bytes.data() + done, bytes.size() - done);
        if (put < 0 && errno == EINTR) continue;
        if (put <= 0) break;
        done += static_cast<size_t>(put);
    }
    const mode_t mask = umask(0);
    umask(mask);
    if (done == bytes.size() && fchmod(file.number, 0666 & ~mask) == 0 &&
        std::rename(part.c_str(), path.c_str()) == 0)
        return {};
    const std::string reason = why();
    unlink(part.c_str());
    return Error{"Cannot write " + path + ": " + reason + "."};
}

Result<void> write_whole(const std::string& path, std::string_view text) {
    return write_whole(path, std::span(reinterpret_cast<const uint8_t*>(text.data()), text.size()));
}

std::string tail_of(const std::string& path, size_t most) {
    const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    struct stat facts {};
    if (file.number < 0 || fstat(file.number, &facts) != 0 || !S_ISREG(facts.st_mode)) return "";
    const auto size = static_cast<size_t>(facts.st_size);
    size_t count = std::min(size, most);
    if (lseek(file.number, static_cast<off_t>(size - count), SEEK_SET) < 0) return "";
    std::string text(count, ' ');
    if (!read_all(file.number, reinterpret_cast<uint8_t*>(text.data()), count)) return "";
    text.resize(count);
    if (size > most) text.erase(0, text.find('\n') + 1);
    return text;
}

}  // namespace flaneur
