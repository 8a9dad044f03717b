// Text in rows and columns: PeTrack, jpscore, the archive of Juelich, Pathfinder, crowd:it, Vadere, Vissim,
// inD, ETH and UCY, ours, and whatever else names its columns. What separates them, what they are and what
// they count in is found from the first lines.
#include <algorithm>
#include <cmath>

#include "assets/files/file.h"
#include "assets/files/words.h"
#include "assets/trajectories/formats.h"
#include "assets/trajectories/formats/columns.h"
#include "sim/base/math.h"

namespace flaneur {
namespace {

constexpr size_t k_most_table_columns = 256, k_most_head_lines = 1000;
constexpr size_t k_told_by = 20'000;  // rows that tell which of two columns is which

std::string_view table_line(std::string_view& rest) {
    const size_t end = rest.find('\n');
    std::string_view line = rest.substr(0, end);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

std::string_view trimmed_word(std::string_view word) {
    while (!word.empty() && (word.front() == ' ' || word.front() == '\t')) word.remove_prefix(1);
    while (!word.empty() && (word.back() == ' ' || word.back() == '\t')) word.remove_suffix(1);
    return word;
}

// The words of a row, at most k_most_table_columns. ' ': blanks and tabs, as many as there are.
void split_row(std::string_view row, char separator, std::vector<std::string_view>& words) {
    words.clear();
    if (separator == ' ') {
        for (size_t at = 0; words.size() < k_most_table_columns;) {
            at = row.find_first_not_of(" \t", at);
            if (at == std::string_view::npos) return;
            const size_t end = std::min(row.find_first_of(" \t", at), row.size());
            words.push_back(row.substr(at, end - at));
            at = end;
        }
        return;
    }
    for (size_t at = 0; words.size() < k_most_table_columns;) {
        size_t from = at;
        const bool is_quoted = at < row.size() && row[at] == '"';
        if (is_quoted) from = std::min(row.find('"', at + 1), row.size());
        const size_t end = std::min(row.find(separator, from), row.size());
        std::string_view word = trimmed_word(row.substr(at, end - at));
        if (word.size() > 1 && word.front() == '"' && word.back() == '"')
            word = word.substr(1, word.size() - 2);
        words.push_back(word);
        if (end == row.size()) return;
        at = end + 1;
    }
}

// "1,5" too, where commas do not separate.
bool number_in_word(std::string_view word, char separator, double& number) {
    if (word.starts_with('+')) word.remove_prefix(1);
    if (parse_number(word, number)) return true;
    const size_t comma = separator == ',' ? std::string_view::npos : word.find(',');
    char text[64];
    if (comma == std::string_view::npos || word.size() > sizeof text) return false;
    std::copy(word.begin(), word.end(), text);
    text[comma] = '.';
    return parse_number(std::string_view(text, word.size()), number);
}

bool is_number_word(std::string_view word, char separator) {
    double number = 0;
    return number_in_word(word, separator, number);
}

bool is_nothing(std::string_view word) {
    for (const std::string_view nothing :
         {"", "-", "nan", "NaN", "NAN", "NA", "N/A", "null", "None", "inf", "-inf"})
        if (word == nothing) return true;
    return false;
}

Error at_table_line(size_t number, const std::string& what) {
    return Error{"has in line " + std::to_string(number) + " " + what};
}

char separator_of(std::string_view line) {
    for (const char c : {';', '\t', ','})
        if (line.find(c) != std::string_view::npos) return c;
    return ' ';
}

// What stands before the rows.
struct TableHead {
    FoundTracks found;
    Columns columns;
    char separator = ' ';
    size_t lines = 0;  // read of the text
    std::string_view rest;
};

bool is_comment(std::string_view line) {
    return line.empty() || line[0] == '#' || line[0] == '%' || line[0] == '*' || line.starts_with("//");
}

void read_comment(TableHead& head, std::string_view line) {
    auto says = [&](std::string_view what) { return line.find(what) != std::string_view::npos; };
    std::vector<std::string_view> words;
    // "framerate: 25", "25 fps"
    size_t rate = line.find("framerate");
    if (rate == std::string_view::npos) rate = line.find("frame rate");
    const size_t fps = line.find("fps");
    if (rate != std::string_view::npos || fps != std::string_view::npos) {
        std::string numbers(rate != std::string_view::npos ? line.substr(rate + 9) : line.substr(0, fps));
        std::replace_if(
            numbers.begin(), numbers.end(), [](char c) { return c == ':' || c == '='; }, ' ');
        split_row(numbers, ' ', words);
        bool is_told = false;
        for (const std::string_view word : words) {
            double number = 0;
            if (!parse_number(word, number) || !(number > 0) || is_told) continue;
            head.found.fps = number;
            is_told = rate != std::string_view::npos;  // the first after the word, or the last before "fps"
        }
    }
    if (says("x/cm") || says("in cm")) head.found.unit = 0.01;
    if (says("x/m ") || line.ends_with("x/m") || says("in m")) head.found.unit = 1;
    if (says("in mm") || says("x/mm")) head.found.unit = 0.001;
    if (says("height of the ground")) head.found.heights = HeightsOf::ground;
    if (says("height of the head")) head.found.heights = HeightsOf::heads;
    if (says("PeTrack")) head.found.format = "PeTrack's text";
    if (says("jpscore")) head.found.format = "jpscore's text";
    if (says("#IDXCOL")) head.found.format = "steps of Vadere", head.found.geometry_ending = ".scenario";
    if (const size_t at = line.find("geometry:"); at != std::string_view::npos) {
        head.found.geometry = std::string(trimmed_word(line.substr(at + 9)));
        head.found.geometry_ending = ".xml";
    }
    // "#ID FR X Y Z"
    std::string_view names = line;
    while (!names.empty() && (names[0] == '#' || names[0] == '%' || names[0] == '*' || names[0] == ' '))
        names.remove_prefix(1);
    split_row(names, separator_of(names), words);
    if (words.size() < 4) return;
    if (const Columns columns = columns_of(words); columns.are_enough()) {
        head.columns = columns;
        if (columns.unit > 0) head.found.unit = columns.unit;
    }
}

// Which of two kinds of columns without names has the shorter ways from row to row of one person.
double usual_way(const std::vector<std::array<double, 4>>& rows, size_t id, size_t frame) {
    std::vector<const std::array<double, 4>*> order;
    order.reserve(rows.size());
    for (const auto& row : rows) order.push_back(&row);
    std::stable_sort(order.begin(), order.end(), [&](const auto* a, const auto* b) {
        return (*a)[id] != (*b)[id] ? (*a)[id] < (*b)[id] : (*a)[frame] < (*b)[frame];
    });
    std::vector<double> ways;
    for (size_t i = 1; i < order.size(); ++i)
        if ((*order[i])[id] == (*order[i - 1])[id])
            ways.push_back(
                std::hypot((*order[i])[2] - (*order[i - 1])[2], (*order[i])[3] - (*order[i - 1])[3]));
    if (ways.empty()) return 1e300;
    const auto middle = ways.begin() + static_cast<std::ptrdiff_t>(ways.size() / 2);
    std::nth_element(ways.begin(), middle, ways.end());
    return *middle;
}

// Rows of numbers alone: "id frame x y z", or "frame id x y", or ETH's "frame id x z y vx vz vy".
void guess_columns(TableHead& head) {
    std::vector<std::array<double, 4>> rows;
    std::vector<std::string_view> words;
    size_t width = ~size_t{0};
    std::string_view rest = head.rest;
    double heights = 0, second = 0;
    while (!rest.empty() && rows.size() < k_told_by) {
        const std::string_view line = table_line(rest);
        if (is_comment(line)) continue;
        split_row(line, head.separator, words);
        std::array<double, 8> numbers{};
        width = std::min(width, words.size());
        for (size_t i = 0; i < std::min(words.size(), numbers.size()); ++i)
            if (!number_in_word(words[i], head.separator, numbers[i]) || !std::isfinite(numbers[i]))
                numbers[i] = 0;
        rows.push_back({numbers[0], numbers[1], numbers[2], numbers[3]});
        heights += std::fabs(numbers[3]) + std::fabs(numbers[6]);
        second += std::fabs(numbers[4]);
    }
    Columns& columns = head.columns;
    columns[Column::x] = 2, columns[Column::y] = 3;
    const bool is_eth = width == 8 && heights == 0 && second > 0;
    if (is_eth) {
        columns[Column::y] = 4;
        for (auto& row : rows) row[3] = 0;
        head.found.format = "obsmat of ETH";
    } else if (width > 4) {
        columns[Column::z] = 4;
    }
    const bool is_frame_first = usual_way(rows, 1, 0) < usual_way(rows, 0, 1);
    columns[Column::id] = is_frame_first ? 1 : 0;
    columns[Column::frame] = is_frame_first ? 0 : 1;
    head.found.assumed.push_back(std::string("Columns are ") + (is_frame_first ? "frame, id" : "id, frame") +
                                 (is_eth                   ? ", x, height, y"
                                  : columns.has(Column::z) ? ", x, y, height"
                                                           : ", x, y") +
                                 ", as people would jump about else.");
}

// A second row of units, as Pathfinder has it.
void read_units(TableHead& head, const std::vector<std::string_view>& words) {
    auto at = [&](Column column) {
        return head.columns.has(column) && head.columns[column] < words.size() ? words[head.columns[column]]
                                                                               : std::string_view();
    };
    if (is_number_word(at(Column::x), head.separator) || metres_of(at(Column::x)) <= 0) return;
    head.columns.unit = metres_of(at(Column::x));
    if (seconds_of_unit(at(Column::time)) > 0) head.columns.second = seconds_of_unit(at(Column::time));
    head.found.format = "CSV of Pathfinder";
}

void name_format(TableHead& head, std::string_view names) {
    auto has = [&](std::string_view name) { return names.find(name) != std::string_view::npos; };
    if (!head.found.format.empty()) return;
    if (has("frame,time_s,id,x_m"))
        head.found.format = "flaneur's CSV";
    else if (has("recordingId"))
        head.found.format = "tracks of inD's kind";
    else if (has("$PEDESTRIAN"))
        head.found.format = "pedestrian record of Vissim";
    else if (has("pedID") && has("posX"))
        head.found.format = "CSV of crowd:it", head.found.geometry_ending = ".floor";
    else if (has("timeStep") && has("pedestrianId"))
        head.found.format = "positions of Vadere", head.found.geometry_ending = ".scenario";
}

Result<TableHead> read_table_head(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
        return Error{"is UTF-16: save it as UTF-8"};
    if (text.substr(0, 4096).find('\0') != std::string_view::npos)
        return Error{"is of no format that is known"};
    TableHead head;
    std::string_view line;
    while (!text.empty()) {
        std::string_view rest = text;
        line = table_line(rest);
        if (!is_comment(line) || head.lines > k_most_head_lines) break;
        read_comment(head, line);
        text = rest;
        ++head.lines;
    }
    if (text.empty()) return Error{"has nobody in it"};
    head.separator = separator_of(line);
    std::vector<std::string_view> words;
    split_row(line, head.separator, words);
    const bool has_names = std::none_of(words.begin(), words.end(), [&](std::string_view word) {
        return is_number_word(word, head.separator);
    });
    if (has_names) {
        const Columns columns = columns_of(words);
        if (!columns.are_enough())
            return at_table_line(head.lines + 1,
                                 "no columns that are known as id, frame or time, x and y: " + excerpt(line));
        head.columns = columns;
        (void)table_line(text);
        ++head.lines;
        name_format(head, line);
        std::string_view rest = text;
        split_row(table_line(rest), head.separator, words);
        read_units(head, words);
        if (head.columns.unit > 0 && head.found.format == "CSV of Pathfinder") text = rest, ++head.lines;
    } else if (head.separator != ',' && head.separator != ';') {
        head.separator = ' ';
    }
    head.rest = text;
    if (!head.columns.are_enough()) {
        if (words.size() < 4) return at_table_line(head.lines + 1, "no \"id frame x y z\": " + excerpt(line));
        guess_columns(head);
    }
    if (head.columns.unit > 0) head.found.unit = head.columns.unit;
    head.found.is_in_degrees = head.columns.is_in_degrees;
    if (head.found.format.empty())
        head.found.format = head.found.fps > 0      ? "text as PeTrack writes it"
                            : head.columns.is_named ? "a table"
                                                    : "a table without names";
    return head;
}

struct RowReader {
    FoundTracks& found;
    const Columns& columns;
    char separator;
    std::vector<std::string_view> words{};
    // Of the first and last frame, where rows have both
    double low_frame = 1e300, low_time = 0, high_frame = -1, high_time = 0;

    std::string_view word(Column column) const {
        return columns.has(column) && columns[column] < words.size() ? words[columns[column]]
                                                                     : std::string_view();
    }
    bool number(Column column, double& to) const { return number_in_word(word(column), separator, to); }
};

bool read_time(RowReader& r, FoundRow& row) {
    double seconds = 0;
    bool is_told = r.columns.has(Column::time) && r.number(Column::time, seconds);
    if (r.columns.has(Column::time) && !is_told)
        if (const std::optional<double> moment = seconds_of_moment(r.word(Column::time)))
            seconds = *moment, is_told = true, r.found.may_be_frames = false;
    if (is_told && r.columns.second > 0) seconds *= r.columns.second;
    if (!r.columns.has(Column::frame)) return row.time = seconds, is_told;
    if (!r.number(Column::frame, row.time)) return false;
    if (is_told && row.time < r.low_frame) r.low_frame = row.time, r.low_time = seconds;
    if (is_told && row.time > r.high_frame) r.high_frame = row.time, r.high_time = seconds;
    return true;
}

void read_extras(RowReader& r, FoundRow& row) {
    double a = 0, b = 0;
    if (r.columns.has(Column::facing_x) && r.number(Column::facing_x, a) && r.number(Column::facing_y, b) &&
        std::fabs(a) <= 2 && std::fabs(b) <= 2)
        row.facing = normalize_or(Vec2{static_cast<float>(a), 0 - static_cast<float>(b)}, {0, 0});
    if (r.columns.has(Column::turned) && r.number(Column::turned, a) && std::fabs(a) <= 1e4) {
        const SinCos turn = sin_cos(wrap_angle(static_cast<float>(a) * k_radians));
        row.facing = {turn.cosine, 0 - turn.sine};
    }
    if (!r.columns.has(Column::kind) && !r.columns.has(Column::length)) return;
    if (row.who < r.found.tracked.size()) return;
    Tracked& tracked = r.found.tracked.emplace_back();  // new ones come one by one
    tracked.id = row.who;
    tracked.kind = kind_of_word(r.word(Column::kind));
    if (r.number(Column::length, a) && a > 0 && a < 100) tracked.length = static_cast<float>(a);
    if (r.number(Column::width, b) && b > 0 && b < 100) tracked.width = static_cast<float>(b);
}

// An empty sentence, or what is wrong.
std::string read_table_row(RowReader& r, std::string_view line) {
    const auto broken = [&] {
        return (r.columns.is_named ? "no such row as the names of columns say: "
                                   : "no \"id frame x y z\": ") +
               excerpt(line);
    };
    split_row(line, r.separator, r.words);
    FoundRow row;
    double z = 0;
    const std::string_view id = r.word(Column::id);
    if (id.empty() || r.columns[Column::y] >= r.words.size()) return broken();
    if (!read_time(r, row)) return broken();
    const bool has_place = r.number(Column::x, row.x) && r.number(Column::y, row.y);
    if (!has_place && !is_nothing(r.word(Column::x)) && !is_nothing(r.word(Column::y))) return broken();
    if (!has_place) row.x = std::nan("");
    if (r.columns.has(Column::z) && !r.number(Column::z, z) && !is_nothing(r.word(Column::z)))
        return broken();
    row.z = std::isfinite(z) ? static_cast<float>(z) : 0;
    if (!r.columns.is_named) {
        double number = 0;
        if (!number_in_word(id, r.separator, number) || number != std::floor(number) ||
            row.time != std::floor(row.time))
            return broken();
    }
    row.who = who_is(r.found, id);
    read_extras(r, row);
    if (Result<void> added = add_row(r.found, row); !added) return added.error().message;
    if (r.columns.has(Column::end_x)) {
        if (!r.number(Column::end_time, row.time) || !r.number(Column::end_x, row.x) ||
            !r.number(Column::end_y, row.y))
            return broken();
        if (Result<void> added = add_row(r.found, row); !added) return added.error().message;
    }
    return {};
}

}  // namespace

Result<FoundTracks> parse_table(const TrajectorySource& source) {
    Result<TableHead> head = read_table_head(source.text);
    if (!head) return head.error();
    FoundTracks& found = head->found;
    // Elsewhere nobody knows from where, and which way round, angles count.
    if (found.format != "jpscore's text" && found.format != "tracks of inD's kind")
        head->columns[Column::turned] = k_no_column;
    found.is_in_frames = head->columns.has(Column::frame);
    found.may_be_frames = head->columns.second <= 0;
    found.has_heights = head->columns.has(Column::z);
    if (found.format == "steps of Vadere" && !head->columns.has(Column::end_x))
        found.format = "positions of Vadere";
    if (head->columns.has(Column::end_x)) {
        found.unit = 1;
        found.is_in_steps = true;
        found.may_be_frames = false;
    }
    RowReader reader{found, head->columns, head->separator};
    size_t number = head->lines;
    for (std::string_view rest = head->rest; !rest.empty();) {
        const std::string_view line = table_line(rest);
        ++number;
        if (is_comment(line)) continue;
        if (const std::string wrong = read_table_row(reader, line); !wrong.empty())
            return at_table_line(number, wrong);
    }
    if (found.fps <= 0 && reader.high_frame > reader.low_frame && reader.high_time > reader.low_time)
        found.fps =
            std::round((reader.high_frame - reader.low_frame) / (reader.high_time - reader.low_time) * 1000) /
            1000;
    if (found.format == "tracks of inD's kind") {
        found.unit = 1;
        if (Result<void> added = add_recording_meta(found, source.path); !added) return added.error();
    }
    return std::move(found);
}

}  // namespace flaneur
