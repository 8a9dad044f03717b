// replay FOLDER MEGABYTES SECONDS: feeds a target the files of a folder, without libFuzzer. One that keeps a
// core busy for longer, or takes more memory than that, ends it as one that crashes does; the last name
// printed is its.
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

namespace {

rusage used() {
    rusage so_far{};
    getrusage(RUSAGE_SELF, &so_far);
    return so_far;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 4 || !std::filesystem::is_directory(argv[1])) {
        std::fprintf(stderr, "%s FOLDER MEGABYTES SECONDS\n", argv[0]);
        return 2;
    }
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(argv[1])) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const auto& path : files) {
        std::printf("%s\n", path.c_str());
        std::fflush(stdout);
        std::ifstream file(path, std::ios::binary);
        std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
        rusage before = used();
        rlim_t end =
            static_cast<rlim_t>(before.ru_utime.tv_sec + before.ru_stime.tv_sec + std::atol(argv[3]));
        rlimit limit{end, RLIM_INFINITY};
        setrlimit(RLIMIT_CPU, &limit);
        LLVMFuzzerTestOneInput(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
        if (long megabytes = used().ru_maxrss >> 10; megabytes > std::atol(argv[2])) {
            std::printf("takes %ld megabytes\n", megabytes);
            return 1;
        }
    }
    return files.empty();
}
