#include "tools/flaneur/bench/hardware.h"

#include <linux/perf_event.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace flaneur {
namespace {

struct Meter {
    const char* name;
    uint64_t event;
};
constexpr size_t k_events = k_meters - 1;  // and energy
constexpr Meter k_counted[k_events] = {{"instructions", PERF_COUNT_HW_INSTRUCTIONS},
                                       {"cycles", PERF_COUNT_HW_CPU_CYCLES},
                                       {"cache misses", PERF_COUNT_HW_CACHE_MISSES},
                                       {"branch misses", PERF_COUNT_HW_BRANCH_MISSES}};

struct Meters {
    int files[k_events] = {-1, -1, -1, -1};
    int refused = 0;                // errno
    std::vector<std::string> rapl;  // files of microjoules, of each package
    bool has_rapl_locked = false;   // they are there, but not ours to read
};
Meters& meters() {
    static Meters one;
    return one;
}

int open_event(uint64_t event) {
    perf_event_attr wanted{};
    wanted.size = sizeof wanted;
    wanted.type = PERF_TYPE_HARDWARE;
    wanted.config = event;
    wanted.inherit = 1;         // threads that come later
    wanted.exclude_kernel = 1;  // which perf_event_paranoid 2 asks for
    wanted.exclude_hv = 1;
    wanted.read_format = PERF_FORMAT_TOTAL_TIME_ENABLED | PERF_FORMAT_TOTAL_TIME_RUNNING;
    return static_cast<int>(syscall(SYS_perf_event_open, &wanted, 0, -1, -1, PERF_FLAG_FD_CLOEXEC));
}

std::optional<double> read_event(int file) {
    uint64_t value[3] = {};  // the count; nanoseconds that were to be counted, and that were
    if (file < 0 || read(file, value, sizeof value) != sizeof value || value[2] == 0) return std::nullopt;
    return static_cast<double>(value[0]) * static_cast<double>(value[1]) / static_cast<double>(value[2]);
}

std::optional<double> read_joules() {
    if (meters().rapl.empty()) return std::nullopt;
    double sum = 0;
    for (const std::string& path : meters().rapl) {
        std::ifstream file(path);
        double microjoules = 0;
        if (!(file >> microjoules)) return std::nullopt;
        sum += microjoules * 1e-6;
    }
    return sum;
}

void find_rapl(Meters& all) {
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator("/sys/class/powercap", ignored)) {
        const std::string name = entry.path().filename().string();
        if (!name.starts_with("intel-rapl:") || std::count(name.begin(), name.end(), ':') != 1) continue;
        const std::string path = entry.path().string() + "/energy_uj";
        if (access(path.c_str(), R_OK) == 0)
            all.rapl.push_back(path);
        else
            all.has_rapl_locked = true;
    }
}

std::string why_no_events() {
    const int why = meters().refused;
    if (why == EACCES || why == EPERM)
        return "none: the system does not allow it (kernel.perf_event_paranoid must be 2 or less)";
    if (why == ENOENT || why == EOPNOTSUPP || why == ENODEV)
        return "none: this machine shows the counters of its CPU to nobody, as many virtual ones do";
    return std::string("none: ") + std::strerror(why);
}

}  // namespace

void open_meters() {
    Meters& all = meters();
    for (size_t i = 0; i < k_events; ++i) {
        all.files[i] = open_event(k_counted[i].event);
        if (all.files[i] < 0 && all.refused == 0) all.refused = errno;
    }
    find_rapl(all);
}

MeterReading read_meters() {
    MeterReading reading;
    for (size_t i = 0; i < k_events; ++i) reading[i] = read_event(meters().files[i]);
    reading[k_events] = read_joules();
    return reading;
}

void add_meters(Figures& figures, const MeterReading& before, uint64_t frames, uint64_t walkers) {
    const MeterReading now = read_meters();
    const auto each = static_cast<double>(std::max<uint64_t>(frames * walkers, 1));
    std::string counted;
    for (size_t i = 0; i < k_events; ++i) {
        if (!now[i] || !before[i]) continue;
        figures.counts.emplace_back(std::string(k_counted[i].name) + " a walker",
                                    (*now[i] - *before[i]) / each);
        counted.append(counted.empty() ? "" : ", ").append(k_counted[i].name);
    }
    figures.setting.emplace_back("hardware counters", counted.empty() ? why_no_events() : counted);
    const std::optional<double>&from = before[k_events], &to = now[k_events];
    const bool has_energy = from && to && *to >= *from;  // the meter starts again at 0 now and then
    if (has_energy)
        figures.counts.emplace_back("joules a frame",
                                    (*to - *from) / static_cast<double>(std::max<uint64_t>(frames, 1)));
    figures.setting.emplace_back("energy", has_energy                 ? "by RAPL, of whole CPUs"
                                           : meters().has_rapl_locked ? "none: only root may read RAPL"
                                                                      : "none: there is no RAPL here");
}

}  // namespace flaneur
