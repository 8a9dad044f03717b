// Another program at work beside this one, whose standard output is read. It ends with this one.
#pragma once

#include <sys/types.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/base/result.h"

namespace flaneur {

struct OtherProgram {
    std::string name;
    pid_t id = -1;    // of it, and of the group that it and what it starts are
    int output = -1;  // what it prints
    int said = -1;    // a file without a name, with what it says on standard error
};
// Ends it, if it still runs.
struct OtherProgramDelete {
    void operator()(OtherProgram*) const;
};
using OtherProgramPtr = std::unique_ptr<OtherProgram, OtherProgramDelete>;

// A program, by path or by PATH, and its arguments; no shell. One at a time.
Result<OtherProgramPtr> start_other(const std::vector<std::string>& words);

// The last two lines that it said on standard error, with " / " between them; "": none.
std::string last_said(const OtherProgram& other);

// How it ended: "with exit code 2", "by SIGSEGV". For one that closed its output, or soon does: reads what is
// left of that and waits, up to a second in all. Nothing: it is still at work.
struct OtherEnd {
    bool has_failed = false;
    std::string told;
};
std::optional<OtherEnd> end_of(OtherProgram& other);

// Ends it at once, on any thread: when this program is about to end.
void abandon_other();

}  // namespace flaneur
