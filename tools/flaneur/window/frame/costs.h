// What the window's pictures cost, part by part: where one looks for what makes them slow.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace flaneur {

struct FrameStats;

// Of the window's own thread, in order: what keys and panels asked for, which may be a whole city; and so on.
enum class CostOf : uint8_t { asked, ticks, people, panels, draw, rest };
inline constexpr size_t k_costs = 6;
inline constexpr const char* k_cost_names[k_costs] = {
    "what was asked for", "ticks", "people and layers", "panels", "drawing", "rest"};

// Milliseconds, and how many ticks it went on by.
struct PictureCost {
    std::array<float, k_costs> parts{};
    float whole = 0;  // from its beginning to that of the next
    float ticks = 0;
};

struct Costs {
    static constexpr size_t k_kept = 240, k_meant = 10;
    std::vector<PictureCost> pictures;  // the last ones, oldest first
    double record = 0;                  // of drawing, milliseconds
    // By the device's own clock, of pictures just before; light that the host computes by its. Those that
    // were not in the last picture stay, so that rows do.
    struct Stage {
        std::string name;
        double ms = 0;
        uint64_t fragments = 0;  // of one picture; 0: not counted
    };
    std::vector<Stage> stages;
    bool is_apart = false;  // crowd, city and sky are timed apart; see FrameInput::times_passes
    bool were_apart = false;
    PictureCost now;              // in the making
    double began = 0, ended = 0;  // seconds
    int64_t traced = 0;           // when the last part ended, by the clock of traces
};

// `time`: of the window, seconds. From one end_part to the next all belongs to that part, which is a zone of
// traces too.
void begin_picture(Costs& costs, double time);
void end_part(Costs& costs, CostOf part, double time);
// Takes what the renderer says of it too; whether it timed crowd, city and sky apart.
void end_picture(Costs& costs, const FrameStats& stats, bool is_apart = false);

// The mean of the last k_meant pictures.
PictureCost mean_of(const Costs& costs);
// Of those that are kept: the median of the whole, milliseconds, and the longest one. Zeros where there is
// none.
struct Spread {
    float median = 0;
    PictureCost worst;
};
Spread spread_of(const Costs& costs);
// What a picture took, in words: "195 ms, of it drawing 120".
std::string told(const PictureCost& picture);

// What a stage of the device does, in a few words; empty where its name says it.
std::string what_is(const std::string& stage);
std::string what_is(CostOf part);

// In words: which part takes most, and what would lessen it; `is_plainest`: no quality is lower.
std::string costliest(const Costs& costs, bool is_plainest = false);

}  // namespace flaneur
