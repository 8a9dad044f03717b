// What tools/flaneur/load says and asks of a console, where that is Python.
#include <atomic>

#include "python/native/native.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/console/ending.h"

namespace flaneur {
namespace {

thread_local bool is_loading = false;
thread_local std::vector<std::string> said;
std::atomic<bool> is_interrupted = false;

}  // namespace

void begin_loading() {
    is_loading = true;
    is_interrupted = false;
    said.clear();
}

std::vector<std::string> end_loading() {
    is_loading = false;
    return std::exchange(said, {});
}

// Asked by threads that Python knows nothing of too.
bool is_stopping() {
    if (!is_loading || is_interrupted) return is_interrupted;
    const pybind11::gil_scoped_acquire held;
    if (PyErr_CheckSignals() != 0) is_interrupted = true;
    return is_interrupted;
}

Error interrupted(const std::string& what) { return Error{"Interrupted; " + what + "."}; }

void say(std::string_view line) { said.emplace_back(line); }
void show_progress(const std::string&) {}
void clear_progress() {}

}  // namespace flaneur
