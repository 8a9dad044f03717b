// A Vulkan that fails when it is told to, and counts what is made and destroyed: it stands between the
// renderer and the driver, whose calls it passes on.
#pragma once

#include <volk.h>

#include <functional>
#include <map>
#include <string>

#include "sim/base/result.h"

namespace flaneur {

struct Faults {
    int calls = 0;                          // that can fail, so far
    int fail_at = 0;                        // the number of the call that fails; 0: none
    std::string only;                       // if not empty, the function whose calls alone count
    VkResult code = VK_SUCCESS;             // what it returns
    std::string failed;                     // the function that has failed; empty: none has
    std::map<std::string, int> live;        // how many there are of each kind: "Buffer", "Memory", ...
    std::map<uint64_t, std::string> names;  // that debuggers show, of what is alive, by its handle
};

// Of all renderers made after the first call of this.
Faults& faults();

// What devices offer less than this one does, to those who open one from now on; drawn on this one all the
// same.
struct Poverty {
    bool has_own_memory = false;      // the device's memory is not the host's, but for the little below
    VkDeviceSize shared = 0;          // bytes at once that both reach fast
    bool presents_elsewhere = false;  // by a second family of queues
    uint32_t timestamp_bits = 64;     //
    bool lacks_options = false;       // every feature and limit that drawing can do without
    bool draws_no_rows = false;       // images lie as only the device knows: the host reads copies
    bool is_never_opaque =
        false;  // windows know one way to mix with what is behind: before they are handed on
};
Poverty& poverty();

// Counts calls anew, and lets the `number`th fail. Objects that are alive stay counted.
void fail_at(int number, VkResult code, const std::string& only = {});

// Lets call after call of `attempt` fail until it goes through without one; returns how many there were. Each
// failure must come back as a sentence, and `after` is run after each.
int fail_everywhere(const std::function<Result<void>()>& attempt, const std::function<void()>& after);

}  // namespace flaneur
