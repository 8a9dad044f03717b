#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "assets/files/words.h"
#include "tools/flaneur/options/shell_words.h"
#include "tools/flaneur/options/spelling.h"
#include "tools/rendercheck/commands.h"
#include "tools/rendercheck/references/device.h"
#include "tools/rendercheck/references/references.h"

namespace flaneur {

int run_explain(const CheckOptions& options, const std::string& name) {
    Result<Suite> suite = load_with_programs(options);
    if (!suite) return fail_with(k_exit_usage, suite.error().message);
    std::vector<std::string> names;
    const SuiteCase* found = nullptr;
    for (const SuiteCase& one : suite->cases) {
        names.push_back(one.name);
        if (one.name == name) found = &one;
    }
    if (!found)
        return fail_with(k_exit_usage,
                         options.suite + " has no case " + name + "." + did_you_mean(name, names));
    const SuiteCase& one = *found;
    const Placeholders places = placeholders_of(*suite, "DIR");
    Result<std::vector<std::string>> words = command_of(one, places);
    if (!words) return fail_with(k_exit_usage, words.error().message);
    Result<Environment> env = environment_of(*suite, one, places);
    if (!env) return fail_with(k_exit_usage, env.error().message);
    const std::string folder =
        one.folder.empty() ? suite->folder
                           : (std::filesystem::path(suite->folder) / one.folder).lexically_normal().string();
    std::printf("%s runs, in %s:\n  %s\n", name.c_str(), folder.c_str(), shell_line(*words).c_str());
    for (const auto& [variable, value] : *env)
        std::printf("  with %s\n", value ? shell_line({variable + "=" + *value}).c_str()
                                         : (variable + " taken out").c_str());
    std::printf("It may take %g s and write %g MiB, and runs %d time%s; once more where it differs.\n",
                one.time_limit, one.disk_limit, one.runs, one.runs == 1 ? "" : "s");
    const Tolerance& t = one.tolerance;
    std::printf(
        "It passes where its picture equals the reference, or at most %g %% of the pixels differ, %g %% by "
        "more than %g/255, and %d of those within 16x16%s.\n",
        t.differing * 100, t.over * 100, t.step, t.in_window,
        t.flip < 1 ? (", with a mean FLIP of " + plainly(t.flip) + " at most").c_str() : "");
    if (!one.mask.empty()) std::printf("Where %s is white it may differ.\n", one.mask.c_str());
    std::string key = suite->key;
    if (key.empty()) {
        Result<std::vector<VulkanDriver>> drivers = ask_drivers(own_program(), suite->env);
        Result<VulkanDriver> driver = drivers ? choose_driver(*drivers, suite->device) : drivers.error();
        if (!driver) return fail_with(k_exit_device, driver.error().message);
        key = driver->key;
        std::printf("%s, %s draws here.\n", driver->device.c_str(), driver->info.c_str());
    }
    const std::string golden = golden_folder(*suite);
    for (size_t n = 0; n < one.pictures.size(); ++n) {
        const std::string path = reference_path(golden, key, one, n);
        std::error_code failed;
        std::printf("Reference: %s, %s\n", path.c_str(),
                    std::filesystem::exists(path, failed) ? "which is there" : "which is missing");
    }
    for (const SuitePart& part : one.parts)
        std::printf("Part: %s of %s%s\n", part.name.c_str(), part.file.c_str(),
                    part.is_hashed ? ", of which a hash is kept" : "");
    std::vector<std::string> again{"rendercheck", "run", options.suite, "--filter", name};
    for (const std::string& program : options.programs) again.insert(again.end(), {"--program", program});
    std::printf("Run it: %s\n", shell_line(again).c_str());
    return k_exit_passed;
}

int run_device() {
    Result<std::vector<VulkanDriver>> drivers = list_drivers();
    if (!drivers) return fail_with(k_exit_device, drivers.error().message);
    std::fputs(told_drivers(*drivers).c_str(), stdout);
    // What drivers do when a program ends is not asked.
    if (std::fflush(stdout) != 0) return k_exit_failed;
    std::_Exit(k_exit_passed);
}

}  // namespace flaneur
