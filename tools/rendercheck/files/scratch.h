// A folder for the time being, which goes with what is in it.
#pragma once

#include <string>
#include <utility>

#include "sim/base/result.h"

namespace flaneur {

struct ScratchFolder {
    std::string path;
    ScratchFolder() = default;
    explicit ScratchFolder(std::string made) : path(std::move(made)) {}
    ~ScratchFolder();
    ScratchFolder(ScratchFolder&& other) noexcept : path(std::exchange(other.path, "")) {}
    ScratchFolder& operator=(ScratchFolder&& other) noexcept {
        std::swap(path, other.path);
        return *this;
    }
};

// In the folder that TMPDIR names, or in /tmp.
Result<ScratchFolder> make_scratch();

}  // namespace flaneur
