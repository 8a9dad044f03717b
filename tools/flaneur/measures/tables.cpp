#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "sim/base/math.h"
#include "tools/flaneur/measures/measures.h"
#include "tools/flaneur/measures/put.h"

namespace flaneur {
namespace {

constexpr double k_soon = 1.5;  // seconds to a collision

// Columns filled row by row.
struct Filling {
    MeasuredTable table;
    Filling(std::string name, std::initializer_list<std::pair<const char*, int>> columns) {
        table.name = std::move(name);
        for (const auto& [column, digits] : columns) table.columns.push_back({column, digits});
    }
    void add(std::initializer_list<double> row) {
        size_t k = 0;
        for (const double value : row) table.columns[k++].values.push_back(value);
    }
};

MeasuredTable area_table(const MeasuredFile& m) {
    Filling to("area", {{"frame", 0},
                        {"time_s", 3},
                        {"people", 0},
                        {"density_classic_per_m2", 4},
                        {"density_voronoi_per_m2", 4},
                        {"speed_mean_m_per_s", 4},
                        {"speed_voronoi_m_per_s", 4},
                        {"covered", 4}});
    for (const AreaMoment& a : m.moments)
        to.add({static_cast<double>(a.frame), a.frame / wide(m.tracks.fps), static_cast<double>(a.people),
                a.classic, a.voronoi, a.mean_speed, a.voronoi_speed, a.covered});
    return to.table;
}

MeasuredTable fundamental_table(const MeasuredFile& m, DensityMethod method) {
    Filling to(method == DensityMethod::classic ? "fundamental-classic" : "fundamental-voronoi",
               {{"from_per_m2", 2},
                {"moments", 0},
                {"density_per_m2", 4},
                {"speed_m_per_s", 4},
                {"speed_deviation_m_per_s", 4},
                {"flow_per_m_s", 4}});
    for (const FundamentalBin& b : fundamental_bins(fundamental_points(m.moments, method), k_fundamental_bin))
        to.add({b.from, static_cast<double>(b.moments), b.density, b.speed, b.speed_spread, b.flow});
    return to.table;
}

MeasuredTable service_table(const MeasuredFile& m) {
    Filling to("service", {{"seconds", 2}, {"share", 4}});
    double frames[k_service_levels] = {};
    for (const AreaMoment& a : m.moments)
        ++frames[fruin_level(static_cast<float>(a.voronoi), m.options.service_of)];
    for (int level = 0; level < k_service_levels; ++level) {
        to.table.labels.emplace_back(1, static_cast<char>('A' + level));
        to.add({frames[level] / wide(m.tracks.fps), frames[level] / static_cast<double>(m.moments.size())});
    }
    return to.table;
}

MeasuredTable profile_table(const MeasuredFile& m) {
    Filling to("profile",
               {{"x_m", 3}, {"y_m", 3}, {"density_per_m2", 4}, {"speed_m_per_s", 4}, {"flow_per_m_s", 4}});
    const ProfileGrid& grid = m.profiles->grid;
    for (size_t k = 0; k < count_of(grid); ++k) {
        const auto columns = static_cast<size_t>(grid.columns);
        const double square = wide(grid.square);
        to.add({wide(grid.low.x) + (static_cast<double>(k % columns) + 0.5) * square,
                -(wide(grid.low.z) + (static_cast<double>(k / columns) + 0.5) * square),
                wide(m.profiles->density[k]), wide(m.profiles->speed[k]), wide(m.profiles->flow[k])});
    }
    return to.table;
}

// Each person's least time to collision, if there is any.
MeasuredTable ttc_table(const MeasuredFile& m) {
    Filling to("ttc", {{"id", 0}, {"least_s", 3}, {"time_s", 3}, {"with_id", 0}});
    for (size_t k = 0; k < m.table.ids.size(); ++k) {
        const uint32_t* least = nullptr;
        for (const uint32_t& i : sightings_of(m.table, k))
            if (std::isfinite(m.next_collisions[i].seconds) &&
                (!least || m.next_collisions[i].seconds < m.next_collisions[*least].seconds))
                least = &i;
        if (least)
            to.add({static_cast<double>(m.table.ids[k]), wide(m.next_collisions[*least].seconds),
                    m.tracks.sightings[*least].frame / wide(m.tracks.fps),
                    static_cast<double>(m.next_collisions[*least].with)});
    }
    return to.table;
}

MeasuredTable dwell_table(const MeasuredFile& m) {
    Filling to("dwell", {{"id", 0}, {"first_frame", 0}, {"last_frame", 0}, {"seconds", 3}});
    for (const Sojourn& s : m.sojourns)
        to.add({static_cast<double>(s.id), static_cast<double>(s.first), static_cast<double>(s.last),
                seconds_of(s, m.tracks.fps)});
    return to.table;
}

void add_line_tables(const MeasuredFile& m, const MeasuredLineFlow& flow,
                     std::vector<MeasuredTable>& tables) {
    const std::string name = "line-" + flow.line.name;
    const double fps = wide(m.tracks.fps), metres = wide(length_of(flow.line));
    Filling crossings(name, {{"id", 0},
                             {"frame", 0},
                             {"time_s", 3},
                             {"to_left", 0},
                             {"x_m", 3},
                             {"y_m", 3},
                             {"speed_m_per_s", 4}});
    for (const LineCrossed& c : flow.crossings)
        crossings.add({static_cast<double>(c.id), static_cast<double>(c.frame), c.frames / fps,
                       c.to_left ? 1.0 : 0.0, wide(c.at.x), -wide(c.at.z), wide(m.speeds[c.sighting])});
    tables.push_back(std::move(crossings.table));
    Filling nt(name + "-nt", {{"frame", 0}, {"time_s", 3}, {"cumulative_pedestrians", 0}});
    for (size_t k = 0; k < flow.first.size(); ++k)
        nt.add({static_cast<double>(flow.first[k].frame), flow.first[k].frame / fps,
                static_cast<double>(k + 1)});
    tables.push_back(std::move(nt.table));
    Filling flows(name + "-flow", {{"first_frame", 0},
                                   {"last_frame", 0},
                                   {"people", 0},
                                   {"flow_per_s", 4},
                                   {"flow_per_m_s", 4},
                                   {"mean_speed_m_per_s", 4}});
    for (const FlowInterval& i : flow.flows)
        flows.add({static_cast<double>(i.first), static_cast<double>(i.last), static_cast<double>(i.people),
                   i.flow, i.flow / metres, i.mean_speed});
    tables.push_back(std::move(flows.table));
    if (m.options.passing <= 0) return;
    Filling passing(name + "-passing", {{"id", 0},
                                        {"entering_frame", 0},
                                        {"leaving_frame", 0},
                                        {"speed_m_per_s", 4},
                                        {"density_per_m2", 4}});
    for (const PassedThrough& p : flow.passages)
        passing.add({static_cast<double>(p.id), static_cast<double>(p.entered), static_cast<double>(p.left),
                     p.speed, p.density});
    tables.push_back(std::move(passing.table));
}

// Of what is known.
struct Spread {
    size_t count = 0;
    double mean = 0, least = std::numeric_limits<double>::infinity(), most = 0, median = 0;
};
template <class Values, class Of>
Spread spread_of(const Values& values, const Of& of) {
    Spread spread;
    std::vector<double> known;
    for (const auto& value : values)
        if (const double v = of(value); std::isfinite(v)) known.push_back(v);
    for (const double v : known) {
        spread.mean += v / static_cast<double>(known.size());
        spread.least = std::min(spread.least, v), spread.most = std::max(spread.most, v);
    }
    spread.count = known.size();
    if (known.empty()) return spread;
    const auto middle = known.begin() + static_cast<std::ptrdiff_t>(known.size() / 2);
    std::nth_element(known.begin(), middle, known.end());
    spread.median = *middle;
    return spread;
}

struct Fact {
    std::string what;
    double value;
    std::string unit;
};
struct FactGroup {
    std::string title;
    std::vector<Fact> facts;
};

void add_spread(FactGroup& group, const std::string& what, const Spread& spread, const char* unit) {
    if (spread.count == 0) return;
    group.facts.push_back({what + ", mean", spread.mean, unit});
    group.facts.push_back({what + ", most", spread.most, unit});
}

std::vector<FactGroup> facts_of(const MeasuredFile& m) {
    std::vector<FactGroup> groups;
    const bool all = asks_for_all(m.options);
    if (!m.moments.empty()) {
        FactGroup area{put_values("area of %.2f m2", m.area.square_metres), {}};
        add_spread(area, "people in it", spread_of(m.moments, [](auto& a) { return double(a.people); }), "");
        add_spread(area, "density, counted", spread_of(m.moments, [](auto& a) { return a.classic; }), "1/m2");
        add_spread(area, "density, Voronoi", spread_of(m.moments, [](auto& a) { return a.voronoi; }), "1/m2");
        area.facts.push_back(
            {"speed, mean", spread_of(m.moments, [](auto& a) { return a.mean_speed; }).mean, "m/s"});
        area.facts.push_back({"speed, Voronoi, where covered",
                              spread_of(m.moments, [](auto& a) { return speed_where_covered(a); }).mean,
                              "m/s"});
        groups.push_back(std::move(area));
    }
    if (all || m.options.fundamental) {
        FactGroup group{"fundamental diagram, by Voronoi cells: speed at a density of", {}};
        for (const FundamentalBin& b :
             fundamental_bins(fundamental_points(m.moments, DensityMethod::voronoi), 2 * k_fundamental_bin))
            group.facts.push_back(
                {put_values("%.2f to %.2f 1/m2", b.from, b.from + 2 * k_fundamental_bin), b.speed, "m/s"});
        groups.push_back(std::move(group));
    }
    if (all || m.options.service) {
        const MeasuredTable table = service_table(m);
        const char* const names[] = {"walkways", "stairs", "queues"};
        FactGroup group{
            std::string("level of service of ") + names[static_cast<size_t>(m.options.service_of)], {}};
        for (size_t k = 0; k < table.labels.size(); ++k)
            if (table.columns[0].values[k] > 0)
                group.facts.push_back({table.labels[k], 100 * table.columns[1].values[k], "% of the time"});
        groups.push_back(std::move(group));
    }
    if (m.profiles) {
        const Profiles& p = *m.profiles;
        FactGroup group{put_values("profile of %d x %d squares of %g m", p.grid.columns, p.grid.rows,
                                   wide(p.grid.square)),
                        {}};
        group.facts.push_back({"density, most", spread_of(p.density, wide).most, "1/m2"});
        group.facts.push_back({"flow, most", spread_of(p.flow, wide).most, "1/(m s)"});
        groups.push_back(std::move(group));
    }
    if (!m.next_collisions.empty() && (all || m.options.ttc)) {
        FactGroup group{put_values("time to collision, of discs of %g m", m.options.radius), {}};
        double known = 0, soon = 0, touching = 0;
        for (const NextCollision& e : m.next_collisions) {
            known += !std::isnan(e.seconds);
            touching += e.seconds <= 0;
            soon += e.seconds > 0 && wide(e.seconds) < k_soon;
        }
        group.facts.push_back({"touch already", 100 * touching / std::max(known, 1.0), "% of the time"});
        group.facts.push_back(
            {put_values("else, below %g s", k_soon), 100 * soon / std::max(known, 1.0), "% of the time"});
        groups.push_back(std::move(group));
    }
    if (all || m.options.dwell) {
        FactGroup group{"dwell", {}};
        const Spread spread = spread_of(m.sojourns, [&](auto& s) { return seconds_of(s, m.tracks.fps); });
        group.facts.push_back({"stays", static_cast<double>(spread.count), ""});
        if (spread.count > 0) group.facts.push_back({"median", spread.median, "s"});
        add_spread(group, "time in the area", spread, "s");
        groups.push_back(std::move(group));
    }
    if (!m.spaces.empty()) {
        FactGroup group{"individuals", {}};
        auto in_range = [&](size_t i) {
            const uint32_t frame = m.tracks.sightings[i].frame;
            return frame >= m.range.first && frame <= m.range.last;
        };
        std::vector<uint32_t> seen;
        for (uint32_t i = 0; i < m.spaces.size(); ++i)
            if (in_range(i)) seen.push_back(i);
        const double none = std::numeric_limits<double>::quiet_NaN();
        add_spread(group, "speed", spread_of(seen, [&](uint32_t i) { return wide(m.speeds[i]); }), "m/s");
        add_spread(group, "acceleration",
                   spread_of(seen, [&](uint32_t i) { return wide(length(m.accelerations[i])); }), "m/s2");
        group.facts.push_back({"to whoever is nearest, mean",
                               spread_of(seen, [&](uint32_t i) { return wide(m.spaces[i].nearest); }).mean,
                               "m"});
        group.facts.push_back({"to neighbours, mean",
                               spread_of(seen,
                                         [&](uint32_t i) {
                                             const PersonalSpace& s = m.spaces[i];
                                             return s.neighbours > 0 ? wide(s.mean_distance) : none;
                                         })
                                   .mean,
                               "m"});
        groups.push_back(std::move(group));
    }
    for (const MeasuredLineFlow& flow : m.lines) {
        FactGroup group{put_values("line %s of %.2f m", flow.line.name.c_str(), wide(length_of(flow.line))),
                        {}};
        const auto left =
            std::count_if(flow.crossings.begin(), flow.crossings.end(), [](auto& c) { return c.to_left; });
        group.facts.push_back({"crossings to its left", static_cast<double>(left), ""});
        group.facts.push_back(
            {"to its right", static_cast<double>(flow.crossings.size()) - static_cast<double>(left), ""});
        group.facts.push_back({"people", static_cast<double>(flow.first.size()), ""});
        if (flow.first.size() > 1) {
            const double frames = flow.first.back().frames - flow.first.front().frames;
            const double rate = static_cast<double>(flow.first.size() - 1) * wide(m.tracks.fps) / frames;
            group.facts.push_back({"from the first to the last", rate, "1/s"});
            group.facts.push_back({"the same to a metre", rate / wide(length_of(flow.line)), "1/(m s)"});
        }
        add_spread(group, "passing speed", spread_of(flow.passages, [](auto& p) { return p.speed; }), "m/s");
        add_spread(group, "passing density", spread_of(flow.passages, [](auto& p) { return p.density; }),
                   "1/m2");
        groups.push_back(std::move(group));
    }
    return groups;
}

}  // namespace

std::vector<MeasuredTable> tables_of(const MeasuredFile& m) {
    std::vector<MeasuredTable> tables;
    const bool all = asks_for_all(m.options);
    if (all || m.options.voronoi) tables.push_back(area_table(m));
    if (all || m.options.fundamental)
        for (const DensityMethod method : {DensityMethod::classic, DensityMethod::voronoi})
            tables.push_back(fundamental_table(m, method));
    if (all || m.options.service) tables.push_back(service_table(m));
    if (m.profiles) tables.push_back(profile_table(m));
    if (all || m.options.ttc) tables.push_back(ttc_table(m));
    if (all || m.options.dwell) tables.push_back(dwell_table(m));
    for (const MeasuredLineFlow& flow : m.lines) add_line_tables(m, flow, tables);
    return tables;
}

std::string table_csv(const MeasuredTable& table) {
    std::string text = table.labels.empty() ? "" : "level,";
    for (const MeasuredColumn& column : table.columns)
        text.append(column.name).append(&column == &table.columns.back() ? "\n" : ",");
    const size_t rows = table.columns.empty() ? 0 : table.columns[0].values.size();
    for (size_t row = 0; row < rows; ++row) {
        if (!table.labels.empty()) text.append(table.labels[row]).append(",");
        for (const MeasuredColumn& column : table.columns) {
            if (std::isfinite(column.values[row]))
                text += put_values("%.*f", column.digits, column.values[row]);
            text.push_back(&column == &table.columns.back() ? '\n' : ',');
        }
    }
    return text;
}

std::string individual_csv(const MeasuredFile& m) {
    std::string text =
        "id,frame,time_s,x_m,y_m,speed_m_per_s,v_x_m_per_s,v_y_m_per_s,acceleration_m_per_s2,a_x_m_per_s2,"
        "a_y_m_per_s2,cell_m2,density_per_m2,neighbors,neighbor_distance_m,nearest_m,ttc_s,ttc_with_id\n";
    auto add = [&](double value, int digits) {
        if (std::isfinite(value)) text += put_values("%.*f", digits, value);
        text.push_back(',');
    };
    for (size_t i = 0; i < m.tracks.sightings.size(); ++i) {
        const Sighting& s = m.tracks.sightings[i];
        if (s.frame < m.range.first || s.frame > m.range.last) continue;
        text += put_values("%u,%u,", s.id, s.frame);
        add(s.frame / wide(m.tracks.fps), 3);
        add(wide(s.at.x), 4), add(0 - wide(s.at.z), 4);
        const Vec2 v = m.velocities[i], a = m.accelerations[i];
        add(wide(m.speeds[i]), 4), add(wide(v.x), 4), add(0 - wide(v.z), 4);
        add(wide(length(a)), 4), add(wide(a.x), 4), add(0 - wide(a.z), 4);
        const PersonalSpace& space = m.spaces[i];
        add(wide(space.area), 4), add(1 / wide(space.area), 4);
        text += put_values("%u,", space.neighbours);
        add(space.neighbours > 0 ? wide(space.mean_distance) : std::nan(""), 4), add(wide(space.nearest), 4);
        add(wide(m.next_collisions[i].seconds), 3);
        if (std::isfinite(m.next_collisions[i].seconds)) text += put_values("%u", m.next_collisions[i].with);
        text.push_back('\n');
    }
    return text;
}

std::string told_measures(const MeasuredFile& m, const std::string& name) {
    const auto [first, last] = frames_in(m.table, m.range);
    const double fps = wide(m.tracks.fps);
    std::string text =
        name + put_values(": %zu people, %zu places, frames %u to %u at %g a second, %.2f to %.2f s\n",
                          m.table.ids.size(), m.table.of->sightings.size(), m.table.frames[first],
                          m.table.frames[last - 1], fps, m.table.frames[first] / fps,
                          m.table.frames[last - 1] / fps);
    for (const std::string& note : m.notes) text += "note: " + note + "\n";
    for (const FactGroup& group : facts_of(m)) {
        text += group.title + "\n";
        for (const Fact& fact : group.facts)
            text += put_values("  %-34s %10.*f %s\n", fact.what.c_str(), fact.unit.empty() ? 2 : 3,
                               fact.value, fact.unit.c_str());
    }
    return text;
}

std::string measures_json(const MeasuredFile& m, const std::string& name) {
    nlohmann::ordered_json json;
    json["program"] = "flaneur " FLANEUR_VERSION;
    json["file"] = name;
    json["frame_rate"] = wide(m.tracks.fps);
    json["people"] = m.table.ids.size();
    json["area_m2"] = m.area.square_metres;
    json["frame_step"] = m.options.frame_step;
    json["cutoff_m"] = m.options.cut_off;
    json["notes"] = m.notes;
    for (const FactGroup& group : facts_of(m)) {
        nlohmann::ordered_json told;
        for (const Fact& fact : group.facts) told[fact.what] = {{"value", fact.value}, {"unit", fact.unit}};
        json["summary"][group.title] = std::move(told);
    }
    for (const MeasuredTable& table : tables_of(m)) {
        nlohmann::ordered_json columns;
        if (!table.labels.empty()) columns["level"] = table.labels;
        for (const MeasuredColumn& column : table.columns) {
            nlohmann::ordered_json values = nlohmann::ordered_json::array();
            const double grain = std::pow(10, column.digits);
            for (const double value : column.values) {
                if (!std::isfinite(value))
                    values.push_back(nullptr);
                else if (column.digits == 0)
                    values.push_back(std::llround(value));
                else
                    values.push_back(std::round(value * grain) / grain);
            }
            columns[column.name] = std::move(values);
        }
        json["tables"][table.name] = std::move(columns);
    }
    return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace flaneur
