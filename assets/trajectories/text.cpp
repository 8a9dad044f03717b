#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "assets/files/file.h"
#include "assets/files/words.h"
#include "assets/trajectories/formats.h"

namespace flaneur {
namespace {

constexpr double k_centimetre = 0.01;
constexpr double k_faster_than_anybody = 20;  // m/s

std::string_view line_of(std::string_view& rest) {
    const size_t end = rest.find('\n');
    std::string_view line = rest.substr(0, end);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

// The next word of a row; empty where there is none left.
std::string_view word_of(std::string_view& row) {
    const size_t first = row.find_first_not_of(" \t");
    if (first == std::string_view::npos) return row = {};
    const size_t end = std::min(row.find_first_of(" \t", first), row.size());
    const std::string_view word = row.substr(first, end - first);
    row.remove_prefix(end);
    return word;
}

Error at_line(size_t number, const std::string& what) {
    return Error{"has in line " + std::to_string(number) + " " + what};
}

// What the comments at the beginning say.
struct TextHead {
    double fps = 0, unit = 0;  // 0: they do not say
};

void read_comment(TextHead& head, std::string_view line) {
    auto says = [&](std::string_view what) { return line.find(what) != std::string_view::npos; };
    if (says("framerate"))
        for (std::string_view rest = line, word = word_of(rest); !word.empty(); word = word_of(rest)) {
            double number = 0;
            if (const size_t colon = word.find(':');
                colon != std::string_view::npos && colon + 1 < word.size())
                word.remove_prefix(colon + 1);
            if (parse_number(word, number) && number > 0) head.fps = number;
        }
    if (says("x/cm") || says("in cm")) head.unit = k_centimetre;
    if (says("x/m") || says("in m")) head.unit = 1;
}

// The middle one of the speeds of those who move from one frame to the next, in what the file counts by.
double usual_speed_in(const Trajectories& t) {
    struct Last {
        uint32_t frame;
        Vec2 at;
    };
    std::unordered_map<uint32_t, Last> last;
    std::vector<double> speeds;
    for (const Sighting& s : t.sightings) {
        const auto before = last.find(s.id);
        if (before != last.end() && s.frame > before->second.frame) {
            const double way = static_cast<double>(length(s.at - before->second.at));
            if (way > 0)
                speeds.push_back(way * static_cast<double>(t.fps) / (s.frame - before->second.frame));
        }
        last[s.id] = {s.frame, s.at};
    }
    if (speeds.empty()) return 0;
    const auto middle = speeds.begin() + static_cast<std::ptrdiff_t>(speeds.size() / 2);
    std::nth_element(speeds.begin(), middle, speeds.end());
    return *middle;
}

}  // namespace

Result<Trajectories> parse_petrack(std::string_view text) {
    Trajectories t;
    TextHead head;
    size_t number = 0;
    std::string_view rest = text;
    for (std::string_view peek = text; !peek.empty();) {
        const std::string_view line = line_of(peek);
        if (!line.empty() && line[0] != '#') break;
        read_comment(head, line);
        rest = peek;
        ++number;
    }
    if (head.fps <= 0)
        return Error{
            "has no \"#framerate: 25\" among the comments at its beginning: add how many frames a second it "
            "has"};
    t.fps = static_cast<float>(head.fps);
    const double unit = head.unit > 0 ? head.unit : 1;
    while (!rest.empty()) {
        std::string_view line = line_of(rest);
        ++number;
        if (line.empty() || line[0] == '#') continue;
        const std::string_view whole = line;
        int64_t id = 0, frame = 0;
        double x = 0, y = 0, z = 0;
        if (!parse_number(word_of(line), id) || !parse_number(word_of(line), frame) ||
            !parse_number(word_of(line), x) || !parse_number(word_of(line), y))
            return at_line(number, "no \"id frame x y z\": " + excerpt(whole));
        if (const std::string_view word = word_of(line); !word.empty() && !parse_number(word, z))
            return at_line(number, "no \"id frame x y z\": " + excerpt(whole));
        if (Result<void> added = add_sighting(t, frame, id, x * unit, y * unit, z * unit); !added)
            return at_line(number, added.error().message);
    }
    if (head.unit <= 0 && usual_speed_in(t) > k_faster_than_anybody)
        for (Sighting& s : t.sightings) {
            s.at = s.at * static_cast<float>(k_centimetre);
            s.height *= static_cast<float>(k_centimetre);
        }
    return t;
}

Result<Trajectories> parse_trajectory_csv(std::string_view text) {
    constexpr std::string_view k_head = "frame,time_s,id,x_m,y_m,z_m,facing_x,facing_y";
    Trajectories t;
    if (line_of(text) != k_head) return Error{"does not begin with " + std::string(k_head)};
    double last_time = 0;
    int64_t last_frame = 0;
    for (size_t number = 2; !text.empty(); ++number) {
        const std::string_view line = line_of(text);
        if (line.empty()) continue;
        const std::vector<std::string_view> words = split(line, ',');
        int64_t frame = 0, id = 0;
        double v[6] = {};
        if (words.size() != 8 || !parse_number(words[0], frame) || !parse_number(words[1], v[0]) ||
            !parse_number(words[2], id) || !parse_number(words[3], v[1]) || !parse_number(words[4], v[2]) ||
            !parse_number(words[5], v[3]) || !parse_number(words[6], v[4]) || !parse_number(words[7], v[5]) ||
            !std::isfinite(v[0]) || !(std::fabs(v[4]) <= 1) || !(std::fabs(v[5]) <= 1))
            return at_line(number, "no " + std::string(k_head) + ": " + excerpt(line));
        if (Result<void> added = add_sighting(t, frame, id, v[1], v[2], v[3]); !added)
            return at_line(number, added.error().message);
        t.sightings.back().facing = {static_cast<float>(v[4]), 0 - static_cast<float>(v[5])};
        if (frame > last_frame) last_frame = frame, last_time = v[0];
    }
    if (last_frame == 0 || last_time <= 0)
        return Error{"has one frame alone, which does not say how many there are a second"};
    t.fps = static_cast<float>(std::round(static_cast<double>(last_frame) / last_time * 1000) / 1000);
    return t;
}

}  // namespace flaneur
