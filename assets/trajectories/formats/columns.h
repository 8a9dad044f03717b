// What the columns of a table are, by their names. Private to assets/trajectories.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace flaneur {

enum class Column : uint8_t {
    id,
    frame,
    time,
    x,
    y,
    z,
    facing_x,
    facing_y,
    turned,  // degrees from east, anticlockwise
    kind,
    length,
    width,
    // A step that begins at `time`, `x` and `y`, and ends so
    end_time,
    end_x,
    end_y,
    count
};
inline constexpr auto k_column_count = static_cast<size_t>(Column::count);
inline constexpr size_t k_no_column = ~size_t{0};

struct Columns {
    std::array<size_t, k_column_count> at;  // k_no_column: there is none
    double unit = 0;                        // metres, of x; 0: not told
    double second = 0;                      // seconds, of time; 0: not told
    bool is_in_degrees = false;
    bool is_named = false;  // by names, not by their order alone

    Columns() { at.fill(k_no_column); }
    size_t& operator[](Column column) { return at[static_cast<size_t>(column)]; }
    size_t operator[](Column column) const { return at[static_cast<size_t>(column)]; }
    bool has(Column column) const { return (*this)[column] != k_no_column; }
    // Enough to say who was where.
    bool are_enough() const {
        return has(Column::id) && (has(Column::frame) || has(Column::time)) && has(Column::x) &&
               has(Column::y);
    }
};

// "x [cm]", "pos_x", "startX-PID1", "$PEDESTRIAN:NO".
Columns columns_of(const std::vector<std::string_view>& names);
// Metres of "cm", "[m]", "metres"; 0: it is no length.
double metres_of(std::string_view word);
// Seconds of "ms", "s"; 0: it is no time.
double seconds_of_unit(std::string_view word);

}  // namespace flaneur
