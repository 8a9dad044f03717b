// A command as a process that leaves nothing behind: it, and whatever it starts, ends with it or is ended.
//
// Each command runs under a process of its own that waits for it, and that descendants fall to when their
// parents die; so they are all found, in whatever session or group they hide.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/base/result.h"

namespace flaneur {

struct ProcessPlan {
    std::vector<std::string> words;  // a program, by PATH or path, and its arguments
    std::vector<std::pair<std::string, std::optional<std::string>>> env;  // besides ours; none: taken out
    std::string folder;                                                   // where it runs
    std::string stdout_file, stderr_file;  // where they go; "": nowhere. It reads nothing
    std::string watched;                   // a folder whose files are counted; "": none
    double time_limit = 60;                // seconds
    size_t disk_limit = 1 << 28;           // bytes of each file that it writes, and of all in `watched`
};

enum class HowEnded { exited, signalled, timed_out, wrote_too_much, not_started, stopped };

struct ProcessEnd {
    HowEnded how = HowEnded::not_started;
    int code = 0;  // exit status, signal, or errno of what could not be started
    double seconds = 0;
    int left_over = 0;  // processes that it left running and that were ended
};

struct Process {
    pid_t keeper = 0;  // the process that waits for it
    int news = -1;     // where the end is told
};

// From a program of one thread. Refuses where no process can be made.
Result<Process> start_process(const ProcessPlan& plan);
// None while it runs.
std::optional<ProcessEnd> poll_process(Process& process);
// Ends it, and all that it started; poll_process() then tells of `stopped`.
void stop_process(const Process& process);

// Waits. Ends it when `should_stop` says so.
Result<ProcessEnd> run_process(const ProcessPlan& plan, bool (*should_stop)() = nullptr);

// "ended with 3", "was ended by signal 11 (Segmentation fault)", "did not end within 60 s"
std::string told_end(const ProcessEnd& end, const ProcessPlan& plan);

}  // namespace flaneur
