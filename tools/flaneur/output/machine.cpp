#include "tools/flaneur/output/machine.h"

#include <sys/resource.h>
#include <unistd.h>

#include <bit>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

namespace flaneur {
namespace {

std::string first_line(const std::string& path) {
    std::ifstream file(path);
    std::string line;
    std::getline(file, line);
    return line;
}

// "2026-11-27T09:30:00+01:00"
std::string date_now() {
    const std::time_t now = std::time(nullptr);
    std::tm local{};
    localtime_r(&now, &local);
    char text[32], zone[8];
    std::strftime(text, sizeof text, "%FT%T", &local);
    std::strftime(zone, sizeof zone, "%z", &local);
    return std::string(text).append(zone, 3).append(":").append(zone + 3);
}

std::string host_name() {
    char name[256] = {};
    gethostname(name, sizeof name - 1);
    return name;
}

// What /proc/cpuinfo says of the first CPU; empty: nothing.
std::string cpu_says(const std::string& key) {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        const size_t colon = line.find(": ");
        if (line.starts_with(key) && colon != std::string::npos) return line.substr(colon + 2);
    }
    return "";
}

// Of a list such as "00000000,00000003".
int bits_in(const std::string& mask) {
    int bits = 0;
    for (char digit : mask)
        if (std::isxdigit(static_cast<unsigned char>(digit)))
            bits += std::popcount(std::stoul(std::string(1, digit), nullptr, 16));
    return bits;
}

nlohmann::ordered_json caches() {
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    for (int i = 0;; ++i) {
        std::string folder = "/sys/devices/system/cpu/cpu0/cache/index";
        folder.append(std::to_string(i)).append("/");
        const std::string level = first_line(folder + "level"), size = first_line(folder + "size");
        if (level.empty() || size.empty()) return all;
        const long times = size.back() == 'K' ? 1024 : size.back() == 'M' ? 1024 * 1024 : 1;
        all.push_back({{"type", first_line(folder + "type")},
                       {"level", std::atoi(level.c_str())},
                       {"size", std::atol(size.c_str()) * times},
                       {"num_sharing", bits_in(first_line(folder + "shared_cpu_map"))}});
    }
}

}  // namespace

nlohmann::ordered_json machine_context() {
    nlohmann::ordered_json context = {{"date", date_now()},
                                      {"host_name", host_name()},
                                      {"executable", "flaneur"},
                                      {"num_cpus", std::thread::hardware_concurrency()},
                                      {"mhz_per_cpu", std::lround(std::atof(cpu_says("cpu MHz").c_str()))}};
    const std::string governor =
        first_line("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor");  // none: no scaling
    context["cpu_scaling_enabled"] = !governor.empty() && governor != "performance";
    context["caches"] = caches();
    double load[3] = {};
    const int loads = getloadavg(load, 3);
    context["load_avg"] = nlohmann::ordered_json::array();
    for (int i = 0; i < loads; ++i) context["load_avg"].push_back(load[i]);
#ifdef NDEBUG
    context["library_build_type"] = "release";
#else
    context["library_build_type"] = "debug";
#endif
    context["library_version"] = "flaneur " FLANEUR_VERSION;
    context["commit"] = FLANEUR_COMMIT;
    context["cpu"] = cpu_name();
    return context;
}

std::string cpu_name() { return cpu_says("model name"); }

double peak_megabytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

}  // namespace flaneur
