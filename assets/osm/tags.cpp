#include <algorithm>
#include <cmath>

#include "assets/osm/map.h"
#include "assets/osm/window.h"
#include "sim/base/math.h"

namespace flaneur {

static constexpr double k_farthest = 40'000;  // from the origin, metres

// Reads digits with at most one point or comma from the front of `text`, and drops them from it.
static std::optional<double> take_number(std::string_view& text) {
    double value = 0, scale = 1;
    bool digits = false, fraction = false;
    size_t i = 0;
    for (; i < text.size(); ++i) {
        char c = text[i];
        if (c >= '0' && c <= '9' && value < 1e9) {
            digits = true;
            if (fraction) scale /= 10;
            value = fraction ? value + scale * (c - '0') : value * 10 + (c - '0');
        } else if ((c == '.' || c == ',') && digits && !fraction) {
            fraction = true;
        } else {
            break;
        }
    }
    if (!digits) return std::nullopt;
    text.remove_prefix(i);
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    return value;
}

std::optional<float> parse_number(std::string_view text) {
    bool negative = !text.empty() && text.front() == '-';
    if (negative) text.remove_prefix(1);
    std::optional<double> value = take_number(text);
    if (!value || !text.empty()) return std::nullopt;
    return static_cast<float>(negative ? -*value : *value);
}

std::optional<float> parse_metres(std::string_view text) {
    std::optional<double> value = take_number(text);
    if (!value) return std::nullopt;
    if (text.empty() || text == "m" || text == "meter" || text == "metres" || text == "meters") {
        return static_cast<float>(*value);
    }
    if (text == "ft" || text == "feet") return static_cast<float>(*value * 0.3048);
    if (text.front() != '\'') return std::nullopt;
    text.remove_prefix(1);
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    double feet = *value;
    if (!text.empty()) {
        std::optional<double> inches = take_number(text);
        if (!inches || (text != "\"" && !text.empty())) return std::nullopt;
        feet += *inches / 12;
    }
    return static_cast<float>(feet * 0.3048);
}

bool is_one_of(std::string_view value, std::initializer_list<std::string_view> values) {
    return std::find(values.begin(), values.end(), value) != values.end();
}

int stated_risers(const OsmTags& tags) {
    return static_cast<int>(clamp(parse_number(tags["step_count"]).value_or(0), 0, 1000));
}

bool is_hidden(const OsmTags& tags) {
    if (tags.is("location", "underground") || tags.is("indoor", "yes") || tags.is("tunnel", "yes") ||
        tags.is("tunnel", "culvert")) {
        return true;
    }
    std::optional<float> layer = parse_number(tags["layer"]);
    return layer && *layer < 0 && !tags.is("tunnel", "building_passage");
}

Vec2 Projection::at(double to_longitude, double to_latitude) const {
    double degrees = to_longitude - longitude;
    double east = degrees * metres_per_longitude, north = (to_latitude - latitude) * metres_per_latitude;
    if (pole != 0) {
        // On circles about the pole: r sin(a) and r cos(a), which falls short of r by 2 r sin(a / 2) squared.
        double r = (90 - pole * to_latitude) * metres_per_latitude;
        float turn = static_cast<float>(degrees) * k_radians;
        double half = sin_cos(turn * 0.5f).sine;
        east = r * sin_cos(turn).sine;
        north += pole * 2 * r * half * half;
    }
    // Whole millimetres, so that nothing below them can differ between machines.
    auto rounded = [](double v) {
        return static_cast<float>(std::floor(std::clamp(v, -k_farthest, k_farthest) * 1000 + 0.5) / 1000);
    };
    return {rounded(east), rounded(-north)};
}

Projection projection_about(double longitude, double latitude) {
    // Lengths of a degree on WGS84 as series in the latitude, within a centimetre.
    double c = sin_cos(static_cast<float>(latitude) * k_radians).cosine, c2 = 2 * c * c - 1,
           c4 = 2 * c2 * c2 - 1;
    double c3 = c * (4 * c * c - 3);
    int pole = latitude > k_polar ? 1 : latitude < -k_polar ? -1 : 0;
    return {longitude, latitude, 111412.84 * c - 93.5 * c3, 111132.954 - 559.822 * c2 + 1.175 * c4, pole};
}

}  // namespace flaneur
