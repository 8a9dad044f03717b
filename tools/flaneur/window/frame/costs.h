// What the window's pictures cost, part by part: where one looks for what makes them slow.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace flaneur {

struct FrameStats;

// Of the window's own thread, in order.
enum class CostOf : uint8_t { ticks, people, panels, draw, rest };
inline constexpr size_t k_costs = 5;
inline constexpr const char* k_cost_names[k_costs] = {"ticks", "people and layers", "panels", "drawing",
                                                      "rest"};

struct Costs {
    static constexpr size_t k_kept = 240;
    std::vector<float>
        wholes;  // milliseconds of each of the last pictures, oldest first, from beginning to beginning
    std::array<double, k_costs> parts{};  // milliseconds, of what about the last ten pictures took
    double record = 0;                    // of drawing
    // By the device's own clock, of pictures just before; light that the host computes by its. Those that
    // were not in the last picture stay, so that rows do.
    struct Stage {
        std::string name;
        double ms = 0;
        uint64_t fragments = 0;  // of one picture; 0: not counted
    };
    std::vector<Stage> stages;
    bool is_apart = false;  // crowd, city and sky are timed apart; see FrameInput::times_passes
    // Of the picture in the making, seconds.
    std::array<double, k_costs> now{};
    double began = 0, ended = 0;
    int64_t traced = 0;  // when the last part ended, by the clock of traces
};

// `time`: of the window, seconds. From one end_part to the next all belongs to that part, which is a zone of
// traces too.
void begin_picture(Costs& costs, double time);
void end_part(Costs& costs, CostOf part, double time);
// Takes what the renderer says of it too.
void end_picture(Costs& costs, const FrameStats& stats);

// The median and the longest of those that are kept, milliseconds; zeros where there is none.
struct Spread {
    float median = 0, worst = 0;
};
Spread spread_of(const Costs& costs);

// What a stage of the device does, in a few words; empty where its name says it.
std::string what_is(const std::string& stage);

// In words: which part takes most, and what would lessen it.
std::string costliest(const Costs& costs);

}  // namespace flaneur
