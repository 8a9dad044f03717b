// Where panels are, so that none covers another, however small the window and however large letters are.
//
// Above lies the bar, below it on the left the room that is open, and on the right the figures of a
// comparison, the card, and what colours mean. Along the lower edge lies the timeline, and over it a row of
// what is told: how fast it goes, notes, the scale of a map. Where not all of it fits, one of the four is
// shown at a time, and the bar has tabs for them. So it is where bodies are compared in two halves: then that
// one is between them, so that the middle of either half is free.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

namespace flaneur {

struct Viewer;

enum class SidePanel : uint8_t { room, figures, card, legend };
inline constexpr size_t k_sides = 4;

// What there is to lay out, pixels. Sizes are those that it has without scrolling, as they were in the last
// picture; 0: there is none, or it has not been laid out yet.
struct PanelWish {
    glm::vec2 window{0};
    float scale = 1;                    // of letters and all else
    float bar_foot = 0, tabs_foot = 0;  // where the bar ends without tabs, and with them
    std::array<bool, k_sides> is_shown{};
    std::array<glm::vec2, k_sides> whole{};
    SidePanel chosen = SidePanel::room;  // of the tabs
    bool is_glimpse = false;             // the card is of what is pointed at: it gives way
    bool is_between = false;             // panels are between two halves
    glm::vec2 film{0}, note{0}, state{0}, map{0};
};

struct PanelPlace {
    bool is_there = false;
    glm::vec2 at{0},
        pivot{0};       // where which of its points is: 0, 0 its upper left corner, 1, 1 its lower right
    glm::vec2 most{0};  // size
};
struct PanelPlan {
    float edge = 10;     // between panels, and to the window's edge
    float bar_rows = 2;  // at most: what does not fit is in a menu
    float timeline_top = 0, row_foot = 0, film_top = 0;
    bool has_tabs = false, has_state = true, has_map = true;
    std::array<PanelPlace, k_sides> sides;
};
PanelPlan plan_panels(const PanelWish& wish);

// With larger letters there would be no room for panels.
float most_scale(glm::vec2 window);

struct PanelLayout {
    PanelWish wish;
    PanelPlan plan;
    uint8_t room = 0;  // which one was open
};

// Plans the next picture's panels; what has come newly is chosen of the tabs.
void plan_picture(Viewer& viewer, glm::vec2 window, float scale, const std::array<bool, k_sides>& is_shown,
                  bool is_glimpse);

// How wide what is in a side panel may be, pixels: so many at scale 1, or fewer where it has no room for
// them.
float width_in(const Viewer& viewer, SidePanel side, float pixels);

// Before and after what is in a side panel, as ImGui::Begin and End, whose flags these are. Where there is no
// room for it nothing is begun, nor is to be ended.
bool begin_side(Viewer& viewer, SidePanel side, const char* name, bool* is_open, int flags);
void end_side(Viewer& viewer, SidePanel side);

}  // namespace flaneur
