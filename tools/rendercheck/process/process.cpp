#include "tools/rendercheck/process/process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace flaneur {
namespace {

using Steady = std::chrono::steady_clock;

volatile std::sig_atomic_t told_to_stop = 0;

double seconds_since(Steady::time_point start) {
    return std::chrono::duration<double>(Steady::now() - start).count();
}

void point(int at, const std::string& file) {
    const int opened =
        file.empty() ? open("/dev/null", O_WRONLY) : open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (opened >= 0) dup2(opened, at);
}

// What is left of the keeper's child after fork(): becomes the command, or tells errno.
[[noreturn]] void become(const ProcessPlan& plan, int failure, pid_t keeper) {
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != keeper) _exit(127);
    for (int signal : {SIGTERM, SIGINT, SIGPIPE, SIGHUP}) std::signal(signal, SIG_DFL);
    const int nothing = open("/dev/null", O_RDONLY);
    dup2(nothing, STDIN_FILENO);
    point(STDOUT_FILENO, plan.stdout_file);
    point(STDERR_FILENO, plan.stderr_file);
    const rlimit disk{plan.disk_limit, plan.disk_limit}, no_core{0, 0};
    setrlimit(RLIMIT_FSIZE, &disk);
    setrlimit(RLIMIT_CORE, &no_core);
    for (const auto& [name, value] : plan.env)
        value ? setenv(name.c_str(), value->c_str(), 1) : unsetenv(name.c_str());
    int failed = 0;
    if (!plan.folder.empty() && chdir(plan.folder.c_str()) != 0) failed = errno;
    if (failed == 0) {
        std::vector<char*> words;
        for (const std::string& word : plan.words) words.push_back(const_cast<char*>(word.c_str()));
        words.push_back(nullptr);
        execvp(words[0], words.data());
        failed = errno;
    }
    [[maybe_unused]] const ssize_t told = write(failure, &failed, sizeof failed);
    _exit(127);
}

// Bytes on the disk, not those that a file with holes claims.
size_t bytes_in(const std::string& folder) {
    size_t sum = 0;
    std::error_code failed;
    for (std::filesystem::recursive_directory_iterator at(folder, failed), end; !failed && at != end;
         at.increment(failed)) {
        std::error_code ignored;
        if (at->is_regular_file(ignored) && !at->is_symlink(ignored))
            sum += static_cast<size_t>(at->file_size(ignored));
    }
    return sum;
}

std::vector<pid_t> own_children() {
    std::vector<pid_t> out;
    std::ifstream list("/proc/self/task/" + std::to_string(getpid()) + "/children");
    for (pid_t one = 0; list >> one;) out.push_back(one);
    return out;
}

// Children fall to us as their parents die, so those that are killed bring the next ones.
int end_descendants() {
    int ended = 0;
    for (;;) {
        const std::vector<pid_t> children = own_children();
        for (pid_t child : children) kill(child, SIGKILL);
        int status = 0;
        const pid_t one = waitpid(-1, &status, children.empty() ? WNOHANG : 0);
        if (one > 0) {
            if (WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) ++ended;
        } else if (one < 0 && errno == ECHILD) {
            return ended;
        } else if (one < 0 && errno != EINTR) {
            return ended;
        }
    }
}

// How the command's own process ended; the others may run on.
ProcessEnd wait_for(const ProcessPlan& plan, pid_t child) {
    constexpr double k_grace = 1;          // between asking it to end and ending it, s
    constexpr double k_count_every = 0.2;  // s
    const Steady::time_point start = Steady::now();
    ProcessEnd end;
    double counted = 0, asked = -1;
    for (useconds_t nap = 500;;) {
        int status = 0;
        const pid_t one = waitpid(-1, &status, WNOHANG);
        const double now = seconds_since(start);
        if (one == child) {
            end.seconds = now;
            if (asked >= 0) return end;
            end.how = WIFEXITED(status) ? HowEnded::exited : HowEnded::signalled;
            end.code = WIFEXITED(status) ? WEXITSTATUS(status) : WTERMSIG(status);
            // It, a shell's child, or somebody who went on with a file that was cut short.
            const int shell_told = 128 + SIGXFSZ;
            if (end.code == (end.how == HowEnded::signalled ? SIGXFSZ : shell_told) ||
                (!plan.watched.empty() && bytes_in(plan.watched) >= plan.disk_limit))
                end.how = HowEnded::wrote_too_much;
            return end;
        }
        if (one > 0) continue;
        if (asked < 0) {
            bool is_full = false;
            if (!plan.watched.empty() && now - counted > k_count_every)
                is_full = bytes_in(plan.watched) > plan.disk_limit, counted = now;
            if (told_to_stop || is_full || now > plan.time_limit) {
                end.how = told_to_stop ? HowEnded::stopped
                          : is_full    ? HowEnded::wrote_too_much
                                       : HowEnded::timed_out;
                kill(-child, SIGTERM);
                kill(child, SIGTERM);
                asked = now;
            }
        } else if (now - asked > k_grace) {
            end.seconds = now;
            return end;
        }
        usleep(nap);
        nap = std::min<useconds_t>(nap * 2, 5000);
    }
}

[[noreturn]] void keep(const ProcessPlan& plan, int news, pid_t parent) {
    setpgid(0, 0);  // so that Ctrl-C is told by the program, not to everybody at once
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    prctl(PR_SET_CHILD_SUBREAPER, 1);
    std::signal(SIGINT, SIG_IGN);
    std::signal(SIGTERM, [](int) { told_to_stop = 1; });
    if (getppid() != parent) _exit(1);
    int failure[2];
    ProcessEnd end;
    if (pipe2(failure, O_CLOEXEC) == 0) {
        const pid_t self = getpid(), child = fork();
        if (child == 0) become(plan, failure[1], self);
        close(failure[1]);
        int failed = child < 0 ? errno : 0;
        if (child > 0) {
            if (read(failure[0], &failed, sizeof failed) != sizeof failed) failed = 0;
            end = wait_for(plan, child);
            kill(-child, SIGKILL);
        }
        if (failed != 0) end = {HowEnded::not_started, failed, 0, 0};
        // What was stopped halfway leaves its own behind, which is no news.
        const int left_over = end_descendants();
        if (end.how == HowEnded::exited || end.how == HowEnded::signalled) end.left_over = left_over;
    }
    [[maybe_unused]] const ssize_t told = write(news, &end, sizeof end);
    _exit(0);
}

}  // namespace

Result<Process> start_process(const ProcessPlan& plan) {
    int news[2];
    if (pipe2(news, O_CLOEXEC) != 0)
        return Error{std::string("No process can be made: ") + std::strerror(errno) + "."};
    std::fflush(nullptr);
    const pid_t self = getpid(), keeper = fork();
    if (keeper == 0) {
        close(news[0]);
        keep(plan, news[1], self);
    }
    close(news[1]);
    if (keeper < 0) {
        close(news[0]);
        return Error{std::string("No process can be made: ") + std::strerror(errno) + "."};
    }
    return Process{keeper, news[0]};
}

std::optional<ProcessEnd> poll_process(Process& process) {
    pollfd ready{process.news, POLLIN, 0};
    if (poll(&ready, 1, 0) <= 0) return std::nullopt;
    ProcessEnd end;
    // A keeper that was killed says nothing.
    if (read(process.news, &end, sizeof end) != sizeof end) end = {HowEnded::stopped, 0, 0, 0};
    close(process.news);
    waitpid(process.keeper, nullptr, 0);
    return end;
}

void stop_process(const Process& process) { kill(process.keeper, SIGTERM); }

Result<ProcessEnd> run_process(const ProcessPlan& plan, bool (*should_stop)()) {
    Result<Process> process = start_process(plan);
    if (!process) return process.error();
    for (;;) {
        if (should_stop && should_stop()) stop_process(*process);
        if (std::optional<ProcessEnd> end = poll_process(*process)) return *end;
        usleep(2000);
    }
}

std::string told_end(const ProcessEnd& end, const ProcessPlan& plan) {
    char seconds[32];
    std::snprintf(seconds, sizeof seconds, "%g", plan.time_limit);
    switch (end.how) {
        case HowEnded::exited:
            return "ended with " + std::to_string(end.code);
        case HowEnded::signalled:
            return "was ended by signal " + std::to_string(end.code) + " (" + strsignal(end.code) + ")";
        case HowEnded::timed_out:
            return std::string("did not end within ") + seconds +
                   " s and was ended: make it faster, or give it more with \"time_limit\"";
        case HowEnded::wrote_too_much:
            return "wrote more than the " + std::to_string(plan.disk_limit >> 20) +
                   " MiB that it may: \"disk_limit\" says how much";
        case HowEnded::stopped:
            return "was interrupted";
        default:
            return std::string("cannot be started: ") + std::strerror(end.code);
    }
}

}  // namespace flaneur
