// What a user likes: kept between runs, in $XDG_CONFIG_HOME/flaneur/settings.json.
#pragma once

#include <string>
#include <string_view>

#include "sim/base/result.h"

namespace flaneur {

inline constexpr float k_least_letters = 1, k_most_letters = 3, k_least_pace = 0.25f, k_most_pace = 4;
inline constexpr int k_least_fps = 10, k_most_fps = 240;

struct Settings {
    float letters = 0;      // of panels, against those of a plain display, 1..3; 0: as the display asks for
    bool is_light = false;  // panels: dark letters on light ground
    int fps = 0;            // pictures a second at most, 10..240; 0: as many as the display shows
    float pace = 1;         // of the flying eye, 0.25..4
    bool inverts_look = false;   // dragging down looks up
    bool inverts_wheel = false;  // turning it away from the hand goes farther away
    bool operator==(const Settings&) const = default;
};

// The next of the usual sizes of letters (1, 1.1, 1.25, 1.5, 1.75, 2, 2.5, 3), larger or smaller, or the one
// that there is where that is the last.
float stepped_letters(float letters, int steps);

// Where they are kept; empty, for nowhere, where neither XDG_CONFIG_HOME nor HOME is an absolute path.
std::string settings_file();

// Of the text of such a file, and it. What a text does not say is as usual, and what it says besides does not
// count. Refuses what is no JSON, and values out of range, in a sentence without a subject.
Result<Settings> parse_settings(std::string_view text);
std::string told(const Settings& settings);

// Those that are usual where there is no file. Refuses, by its name, a file that cannot be used.
Result<Settings> read_settings(const std::string& file);
Result<void> keep_settings(const std::string& file, const Settings& settings);

}  // namespace flaneur
