#include "tools/rendercheck/files/scratch.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

namespace flaneur {

ScratchFolder::~ScratchFolder() {
    if (path.empty()) return;
    std::error_code ignored;
    // What a command protected from itself goes too.
    for (std::filesystem::recursive_directory_iterator at(path, ignored), end; !ignored && at != end;
         at.increment(ignored)) {
        std::error_code one;
        if (at->is_directory(one) && !at->is_symlink(one))
            std::filesystem::permissions(at->path(), std::filesystem::perms::owner_all,
                                         std::filesystem::perm_options::add, one);
    }
    std::filesystem::remove_all(path, ignored);
}

Result<ScratchFolder> make_scratch() {
    const char* asked = std::getenv("TMPDIR");
    std::error_code failed;
    std::filesystem::path folder = std::filesystem::absolute(asked && *asked ? asked : "/tmp", failed);
    std::string name = (folder / "rendercheck-XXXXXX").string();
    if (failed || !mkdtemp(name.data()))
        return Error{"No folder can be made in " + folder.string() + ": " + std::strerror(errno) +
                     ". TMPDIR may name another."};
    return ScratchFolder(name);
}

}  // namespace flaneur
