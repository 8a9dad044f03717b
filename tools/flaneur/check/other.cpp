#include "tools/flaneur/check/other.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>

#include "tools/flaneur/console/ending.h"

namespace flaneur {
namespace {

std::atomic<pid_t> running = -1;

// Waits up to a second for one that was asked to end, and then makes it.
void end_group(pid_t id) {
    kill(-id, SIGTERM);
    constexpr timespec k_while{0, 10'000'000};
    bool has_ended = false;
    for (int i = 0; i < 100 && !has_ended; ++i) {
        has_ended = waitpid(id, nullptr, WNOHANG) != 0;
        if (!has_ended) nanosleep(&k_while, nullptr);
    }
    kill(-id, SIGKILL);  // and what it left
    while (!has_ended && waitpid(id, nullptr, 0) < 0 && errno == EINTR) {
    }
}

Error no_start(const std::string& name, int why) {
    return Error{"Cannot run " + name + ": " + std::strerror(why) +
                 ". Give a flaneur to compare with, by its path, as in --with ./build/release/flaneur."};
}

}  // namespace

Result<OtherProgramPtr> start_other(const std::vector<std::string>& words) {
    OtherProgramPtr other(new OtherProgram);
    other->name = words[0];
    int ends[2];
    other->said = memfd_create("said", MFD_CLOEXEC);
    if (other->said < 0 || pipe2(ends, O_CLOEXEC) != 0) return no_start(words[0], errno);
    other->output = ends[0];
    std::vector<char*> pointers;
    pointers.reserve(words.size() + 1);
    for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&files, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&files, other->said, STDERR_FILENO);
    // As from a shell: in a group of its own, with no signal blocked or ignored.
    posix_spawnattr_t how;
    posix_spawnattr_init(&how);
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    posix_spawnattr_setsigmask(&how, &none);
    posix_spawnattr_setsigdefault(&how, &all);
    posix_spawnattr_setflags(&how, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
    const int failure = posix_spawnp(&other->id, pointers[0], &files, &how, pointers.data(), environ);
    posix_spawnattr_destroy(&how);
    posix_spawn_file_actions_destroy(&files);
    close(ends[1]);
    if (failure != 0) {
        other->id = -1;
        return no_start(words[0], failure);
    }
    running = other->id;
    return other;
}

void OtherProgramDelete::operator()(OtherProgram* other) const {
    if (other->output >= 0) close(other->output);
    if (other->id > 0) end_group(other->id);
    running = -1;
    if (other->said >= 0) close(other->said);
    delete other;
}

std::string last_said(const OtherProgram& other) {
    std::array<char, 4096> end{};
    const off_t size = lseek(other.said, 0, SEEK_END);
    const off_t from = std::max<off_t>(0, size - static_cast<off_t>(end.size()));
    const ssize_t got = pread(other.said, end.data(), end.size(), from);
    std::string text(end.data(), got > 0 ? static_cast<size_t>(got) : 0);
    // From the end on, but for lines of nothing.
    std::string last;
    for (int lines = 0; lines < 2 && !text.empty();) {
        const size_t begin = text.rfind('\n') + 1;  // 0 where there is none
        const std::string line = text.substr(begin);
        text.resize(begin > 0 ? begin - 1 : 0);
        if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
        last = line + (last.empty() ? "" : " / " + last);
        ++lines;
    }
    return last;
}

std::optional<OtherEnd> end_of(OtherProgram& other) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point until = Clock::now() + std::chrono::seconds(1);
    std::array<char, 4096> left{};
    while (Clock::now() < until && !is_stopping()) {
        int status = 0;
        const pid_t ended = waitpid(other.id, &status, WNOHANG);
        if (ended == other.id) {
            kill(-other.id, SIGKILL);  // what it left
            other.id = -1;
            running = -1;
            if (!WIFSIGNALED(status))
                return OtherEnd{WEXITSTATUS(status) != 0,
                                "with exit code " + std::to_string(WEXITSTATUS(status))};
            const char* const name = sigabbrev_np(WTERMSIG(status));
            return OtherEnd{
                true, name ? std::string("by SIG") + name : "by signal " + std::to_string(WTERMSIG(status))};
        }
        // It may wait for somebody who reads.
        pollfd output{other.output, POLLIN, 0};
        const bool has_more = poll(&output, 1, 0) > 0 && read(other.output, left.data(), left.size()) > 0;
        if (has_more) continue;
        constexpr timespec k_while{0, 10'000'000};
        nanosleep(&k_while, nullptr);
    }
    return {};
}

void abandon_other() {
    if (const pid_t id = running; id > 0) kill(-id, SIGKILL);
}

}  // namespace flaneur
