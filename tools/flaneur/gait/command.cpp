#include <cstdio>

#include "tools/flaneur/commands.h"
#include "tools/flaneur/gait/bars.h"
#include "tools/flaneur/gait/walk.h"

namespace flaneur {

namespace {

// One line a bar; how many do not pass.
int print_table(const std::string& title, const std::vector<Verdict>& verdicts) {
    int failed = 0;
    std::printf("%s\n  %-26s %9s   %-19s %s\n", title.c_str(), "quantity", "measured", "bar", "");
    for (const Verdict& v : verdicts) {
        char bar[64];
        if (v.bar.low <= -k_open) {
            std::snprintf(bar, sizeof bar, "<= %.4g", v.bar.high);
        } else if (v.bar.high >= k_open) {
            std::snprintf(bar, sizeof bar, ">= %.4g", v.bar.low);
        } else {
            std::snprintf(bar, sizeof bar, "%.4g .. %.4g", v.bar.low, v.bar.high);
        }
        std::printf("  %-26s %9.4g   %-19s %s", v.bar.quantity, v.value, bar, v.pass ? "pass" : "FAIL");
        if (v.bar.stretch > 0) std::printf("   stretch %.4g: %+.2f", v.bar.stretch, v.value - v.bar.stretch);
        std::printf("\n");
        failed += !v.pass;
    }
    return failed;
}

}  // namespace

Result<void> run_gait(const Options& options) {
    const GaitOptions& gait = options.gait;
    Body body = standard_body(gait.height);
    City flat = strip([](float) { return 0.0f; }, {-50, 200}, false);
    int failed = 0, bars = 0;
    std::vector<float> speeds{gait.speed};
    if (gait.check && gait.speed > 1.2f && gait.speed < 1.4f) speeds.insert(speeds.end(), {0.95f, 1.5f});
    for (float speed : speeds) {
        double seconds = gait.seconds;
        Walk w = walk(flat, body, gait.style, seconds, [&](double t) {
            return Wish{t > 1 && t < seconds - 3 ? speed : 0, 0};
        });
        auto tick = [&](double t) { return static_cast<size_t>(t * w.rate); };
        Level level = measure_level(w, tick(5), tick(seconds - 3));
        char title[64];
        std::snprintf(title, sizeof title, "Level, %.2f m/s", static_cast<double>(speed));
        std::vector<Verdict> verdicts = judge(level.quantities, level_bars(static_cast<double>(speed)));
        failed += print_table(title, verdicts);
        bars += static_cast<int>(verdicts.size());
        if (gait.curves) {
            std::printf(
                "pct  thigh  norm   knee  norm  ankle  norm  pitch  norm   list  norm    rot  norm  height   "
                "side   toe_h  arm  elbow\n");
            const Curves& c = level.curves;
            for (size_t p = 0; p < 100; p += 2) {
                std::printf(
                    "%3zu %6.1f%6.1f %6.1f%6.1f %6.1f%6.1f %6.1f%6.1f %6.1f%6.1f %6.1f%6.1f  %6.1f %6.1f "
                    "%7.1f %5.1f %5.1f\n",
                    p, c.thigh[p], k_reference.thigh[p], c.knee[p], k_reference.knee[p], c.ankle[p],
                    k_reference.ankle[p], c.foot_pitch[p], k_reference.foot_pitch[p], c.pelvis_list[p],
                    k_reference.pelvis_list[p], c.pelvis_rotation[p], k_reference.pelvis_rotation[p],
                    c.pelvis_height[p], c.pelvis_side[p], c.toe_height[p], c.upper_arm[p], c.elbow[p]);
            }
        }
    }
    std::printf("%d of %d bars passed.\n", bars - failed, bars);
    if (gait.check && failed > 0)
        return Error{std::to_string(failed) + " of " + std::to_string(bars) + " bars are not met."};
    return {};
}

}  // namespace flaneur
