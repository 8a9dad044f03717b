#include <cstdio>

#include "assets/cache/cache_file.h"
#include "tools/flaneur/commands.h"
#include "tools/flaneur/console/console.h"

namespace flaneur {

static void print_amount(const char* what, const CacheStatus& status) {
    std::printf("%s%zu %s, %.1f MiB", what, status.files, status.files == 1 ? "file" : "files",
                static_cast<double>(status.bytes) / (1 << 20));
}

Result<void> run_cache(const Options& options) {
    std::string folder = cache_folder();
    if (folder.empty()) {
        std::printf("Nothing is kept: %s.\n", cache_limit() == 0
                                                  ? "FLANEUR_CACHE_MAX is 0"
                                                  : "neither XDG_CACHE_HOME nor HOME names a folder");
        return {};
    }
    if (!options.clear_cache) {
        Result<CacheStatus> status = cache_status(folder);
        if (!status) return status.error();
        std::printf("%s\n", printable(folder).c_str());
        print_amount("", *status);
        std::printf(" of at most %.0f\n", static_cast<double>(cache_limit()) / (1 << 20));
        return {};
    }
    Result<CacheStatus> removed = clear_cache(folder);
    if (!removed) return removed.error();
    print_amount("Removed ", *removed);
    std::printf(" from %s\n", printable(folder).c_str());
    return {};
}

}  // namespace flaneur
