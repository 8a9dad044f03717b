#include "tools/flaneur/window/time/beside.h"

#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "renderer/renderer.h"
#include "sim/base/tick.h"
#include "tools/flaneur/load/load.h"
#include "tools/flaneur/view/show.h"
#include "tools/flaneur/view/sun.h"
#include "tools/flaneur/window/measure/drawing.h"
#include "tools/flaneur/window/panels.h"
#include "tools/flaneur/window/time/colours.h"
#include "tools/flaneur/window/time/time.h"
#include "tools/flaneur/window/viewer.h"
#include "tools/flaneur/window/widgets.h"

namespace flaneur {
namespace {

constexpr size_t k_beside_bytes = k_history_bytes / 4;
constexpr double k_piece_seconds = 0.1;  // of catching up, between two pictures
constexpr float k_walks = 0.2f;          // m/s, from which one is on one's feet
constexpr uint32_t k_behind = 60;        // ticks that the other run is behind and catches up with
constexpr int k_divider = 2;             // pixels between both pictures

// Of a show the other run takes the place, and gives it back.
void exchange_runs(Show& show, Beside& beside) {
    std::swap(show.loaded.world, beside.world);
    std::swap(show.people, beside.people);
    std::swap(show.overlay, beside.overlay);
    std::swap(show.without, beside.without);
    std::swap(show.sun, beside.sun);
    std::swap(show.is_overcast, beside.is_overcast);
    std::swap(show.lit_windows, beside.lit_windows);
    if (beside.city) std::swap(show.loaded.city, beside.city);
}

Result<void> exchange_drawn_cities(Show& show, const Beside& beside) {
    return beside.city ? exchange_cities(*show.renderer) : Result<void>();
}

void paste(const Image& from, uint32_t left, Image& to) {
    for (uint32_t y = 0; y < std::min(from.height, to.height); ++y)
        std::memcpy(&to.rgba[(size_t{y} * to.width + left) * 4], &from.rgba[size_t{y} * from.width * 4],
                    size_t{from.width} * 4);
}

Result<Image> draw_other_run(Show& show, Viewer& v, Size one, uint32_t width, uint32_t height,
                             float between) {
    Beside& beside = *v.time.beside;
    beside.overlay.letters_legends = show.overlay.letters_legends;
    beside.without.on = show.without.on;
    const bool is_level = beside.world->tick == show.loaded.world->tick;
    if (Result<void> done = exchange_drawn_cities(show, beside); !done) return done.error();
    exchange_runs(show, beside);
    const WorkViews views = show.work_views;
    if (beside.shows_difference && views[WorkView::density])
        show.work_views = toggled(views, WorkView::density);
    show.hides_dots = beside.shows_difference;
    FrameInput frame = extract_frame(show, v.camera, one, is_level ? between : 1);
    show.hides_dots = false;
    show.work_views = views;
    mark_measures_beside(v, beside.counts, show.overlay, frame);
    if (beside.shows_difference) {
        const World &left = *beside.world, &right = *show.loaded.world;
        add_density_difference({left, show.loaded.characters, v.camera}, right, show.overlay);
        frame.fills = show.overlay.fills;
    }
    Result<Image> image = draw_image(*show.renderer, frame, width, height);
    exchange_runs(show, beside);
    if (Result<void> done = exchange_drawn_cities(show, beside); !done) return done.error();
    return image;
}

Result<Image> draw_without(Show& show, Viewer& v, Size one, uint32_t width, uint32_t height, float between) {
    show.draws_whole = false;
    FrameInput frame = extract_frame(show, v.camera, one, between);
    mark_measures_beside(v, v.measure.counts, show.overlay, frame);
    Result<Image> image = draw_image(*show.renderer, frame, width, height);
    show.draws_whole = true;
    return image;
}

}  // namespace

void set_beside(Show& show, Viewer& v, const BesideChoice& choice) {
    make_anew(v, order_people(show.loaded, choice.seed, choice.walkers), choice);
}

// The city of a scene, which has the same bare one, from the start.
static void set_beside_scene(Show& show, Viewer& v, const Scene& scene, const char* told) {
    const Change& c = v.change;
    const World& world = *show.loaded.world;
    PeopleOrder people = order_people(show.loaded, world.seed, static_cast<uint32_t>(scene.walkers));
    people.options.hour = scene.hour;
    set_shares(people.options, shares_of(scene.people, scene.mix, show.loaded.characters, show.loaded.parts));
    std::optional<Order> city;
    const bool is_night = is_dark(scene_sun(scene, show.loaded.city->latitude), scene.is_overcast);
    if (!world.roam && (scene.added != c.carried.added || (is_night && !show.has_lamps))) {
        city = order_of(show, c, scene.added);
        city->with_lamps = is_night;
    }
    make_anew(v, std::move(people),
              BesideChoice{world.seed, static_cast<uint32_t>(scene.walkers), {}, scene, told},
              std::move(city));
}

void set_beside_as_opened(Show& show, Viewer& v) {
    const Change& c = v.change;
    if (is_as_opened(c) && c.carried.is_overcast == c.scene.is_overcast)
        return tell(v, "Nothing has been changed yet, in the room Change: both would be the same.");
    set_beside_scene(show, v, c.scene, "as opened");
}

void set_beside_before(Show& show, Viewer& v) {
    const Change& c = v.change;
    if (c.carried.added == c.scene.added) return set_beside_as_opened(show, v);
    Scene scene = scene_with(c.scene, c.carried);
    scene.added = c.scene.added;
    set_beside_scene(show, v, scene, "streets as opened");
}

// The city that was made for it, on the device.
static Result<void> take_city(Show& show, Made& made, Beside& beside) {
    if (made.city) {
        beside.city = std::move(made.city);
        return hold_city(*show.renderer, *made.drawn, made.lamps.value_or(LampMap{}));
    }
    if (!made.lamps) return {};
    show.has_lamps = true;
    return upload_lamps(*show.renderer, *made.lamps);
}

void put_beside(Show& show, Viewer& v, std::unique_ptr<World> world, Anew& anew) {
    const BesideChoice choice = anew.beside.value_or(BesideChoice{});
    auto beside = std::make_unique<Beside>();
    beside->sun = show.sun, beside->is_overcast = show.is_overcast, beside->lit_windows = show.lit_windows;
    if (choice.scene) {
        beside->city_told = choice.city_told;
        beside->sun = scene_sun(*choice.scene, show.loaded.city->latitude);
        beside->is_overcast = choice.scene->is_overcast;
        beside->lit_windows = lit_windows(choice.scene->hour);
    }
    if (anew.made)
        if (Result<void> done = take_city(show, *anew.made, *beside); !done)
            return tell(v, done.error().message);
    beside->moment = choice.moment;
    beside->world = std::move(world);
    beside->history = make_history(k_beside_bytes);
    follow(*beside->history, *beside->world);
    // What is kept of this run is of the same make.
    if (choice.moment) {
        const uint32_t from = kept_before(*v.time.history, *choice.moment).value_or(0);
        if (Result<void> done = restore(*v.time.history, from, *beside->world); !done)
            return tell(v, "This run cannot be set beside itself: " + done.error().message);
        follow(*beside->history, *beside->world);
        beside->counts = v.measure.counts;  // up to that moment
    }
    if (beside->world->tick + k_behind < show.loaded.world->tick && !beside->moment)
        tell(v, "The right run catches up from its start; Restart, in the room Time, begins both together.");
    v.time.beside = std::move(beside);
    v.techniques.is_split = false;
}

void set_beside_this_moment(Show& show, Viewer& v) {
    const World& world = *show.loaded.world;
    keep_now(*v.time.history, world);
    set_beside(show, v, {world.seed, people_count(world), world.tick});
}

void count_beside(const Counts& here, Beside& beside) {
    const MeasurePlan plan = plan_of(here);
    const World& world = *beside.world;
    if (plan_of(beside.counts) != plan) {
        set_plan(beside.counts, plan, world.tick);
        count_people(beside.counts, world);
    }
    beside.counts.shown = std::min(beside.counts.tick, world.tick);
}

bool waits_for_beside(const Viewer& v, const World& world) {
    const Beside* beside = v.time.beside.get();
    return beside && !beside->moment && beside->world->tick + k_behind < world.tick;
}

void keep_up_beside(Show& show, Viewer& v) {
    if (!v.time.beside) return;
    Beside& beside = *v.time.beside;
    World& world = *beside.world;
    count_beside(v.measure.counts, beside);
    const uint32_t to = beside.moment.value_or(show.loaded.world->tick);
    if (world.tick == to) return;
    const uint32_t from = kept_before(*beside.history, to).value_or(0);
    if (world.tick > to || world.tick < from) {
        beside.overlay.trails = {};
        if (!restore(*beside.history, from, world)) return;
    }
    const auto start = std::chrono::steady_clock::now();
    while (world.tick < to) {
        beside.without.on = v.techniques.on;
        keep_previous(beside.without, world);
        step(world);
        follow(*beside.history, world);
        const Counts& counts = beside.counts;
        if (counts.tick == k_unticked || world.tick > counts.tick) count_people(beside.counts, world);
        beside.counts.shown = std::min(counts.tick, world.tick);
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
        if (spent.count() > k_piece_seconds) return;
    }
}

bool has_two(const Viewer& v) { return v.time.beside || v.techniques.is_split; }

Size size_of_one(const Viewer& v, Size size) {
    return has_two(v) ? Size{std::max((size.width - k_divider) / 2, 1), size.height} : size;
}

Result<Image> draw_side_by_side(Show& show, Viewer& v, const FrameInput& frame, Size size, float between) {
    const Size one = size_of_one(v, size);
    // As coarse as the window's picture is.
    auto coarse = [&](int pixels) {
        return std::max(static_cast<uint32_t>(static_cast<float>(pixels) * frame.resolution), 1u);
    };
    const uint32_t width = coarse(one.width), height = coarse(one.height);
    FrameInput here = frame;
    here.panels = {};
    Result<Image> left = draw_image(*show.renderer, here, width, height);
    if (!left) return left;
    Result<Image> right = v.time.beside ? draw_other_run(show, v, one, width, height, between)
                                        : draw_without(show, v, one, width, height, between);
    if (!right) return right;
    Image both{std::max(coarse(size.width), 2 * width), height, {}, {}};
    both.rgba.assign(size_t{4} * both.width * both.height, 255);
    paste(*left, 0, both);
    paste(*right, both.width - width, both);
    return both;
}

static void lay_out_difference(Beside& beside) {
    ImGui::Checkbox("where they differ", &beside.shows_difference);
    tip("over the right picture: where there are more people on the left, and where fewer");
    if (!beside.shows_difference) return;
    for (const auto& [text, colour] :
         {std::pair{"more on the left", k_more_people}, std::pair{"fewer", k_fewer_people}}) {
        ImGui::SameLine();
        ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(panel_colour(colour)), "%s", text);
    }
}

// In a word, beside one that is otherwise.
static std::string city_here(const Change& c) {
    return c.carried.added == c.scene.added ? "streets as opened" : "as changed";
}

void lay_out_beside(const Show& show, Viewer& v) {
    if (!v.time.beside || !begin_side(v, SidePanel::figures, "beside", nullptr, k_plain)) return;
    const Beside& beside = *v.time.beside;
    const World& here = *show.loaded.world;
    const CrowdFigures a = figures_of(here), b = figures_of(*beside.world);
    bool is_behind = false;
    if (ImGui::BeginTable("figures", 4, ImGuiTableFlags_SizingFixedFit)) {
        auto row = [](const char* what, const std::string& left, const std::string& right,
                      const std::string& apart) {
            for (const char* text : {what, left.c_str(), right.c_str(), apart.c_str()}) {
                ImGui::TableNextColumn();
                ImGui::TextUnformatted(text);
            }
        };
        auto figure = [&](const char* what, const char* format, float left, float right) {
            auto written = [&](const char* with, float value) {
                char text[32];
                std::snprintf(text, sizeof text, with, static_cast<double>(value));
                return std::string(text);
            };
            row(what, written(format, left), written(format, right),
                is_behind ? "" : written((std::string("%+") + (format + 1)).c_str(), left - right));
        };
        row("", "left", "right", "left - right");
        if (!beside.city_told.empty()) row("city", city_here(v.change), beside.city_told, "");
        row("seed", std::to_string(here.seed), std::to_string(beside.world->seed), "");
        is_behind = !beside.moment && beside.world->tick + k_behind < here.tick;
        row("time", run_time(here.tick), run_time(beside.world->tick), is_behind ? "catching up" : "");
        figure("people", "%.0f", static_cast<float>(a.people), static_cast<float>(b.people));
        figure("who walk", "%.0f", static_cast<float>(a.walking), static_cast<float>(b.walking));
        figure("at, m/s", "%.2f", a.speed, b.speed);
        if (!here.roam) figure("densest, people/m2", "%.2f", a.density, b.density);
        const Counts &here_counts = v.measure.counts, &there = beside.counts;
        // What has not been counted for a while is not told.
        auto flow = [&](const LineCount& left, const LineCount& right) {
            const Flow l = flow_of(left, here_counts.shown, k_flow_seconds),
                       r = flow_of(right, there.shown, k_flow_seconds);
            const std::string what = left.line.name + ", people/min of 60 s";
            if (is_settled(l) && is_settled(r))
                return figure(what.c_str(), "%.1f", static_cast<float>(l.per_minute),
                              static_cast<float>(r.per_minute));
            row(what.c_str(), "-", "-", "");
        };
        for (size_t i = 0; i < std::min(here_counts.lines.size(), there.lines.size()); ++i)
            flow(here_counts.lines[i], there.lines[i]);
        for (size_t i = 0; i < std::min(here_counts.zones.size(), there.zones.size()); ++i)
            figure((here_counts.zones[i].zone.name + ", people/m2").c_str(), "%.2f",
                   zone_now(here_counts.zones[i], here_counts).density,
                   zone_now(there.zones[i], there).density);
        ImGui::EndTable();
    }
    if (!here.roam) lay_out_difference(*v.time.beside);
    const bool is_over = ImGui::Button("End");
    tip("one run alone again, the left one");
    end_side(v, SidePanel::figures);
    if (is_over) v.time.beside.reset();
}

CrowdFigures figures_of(const World& world) {
    const Crowd& crowd = world.crowd;
    CrowdFigures figures{.people = static_cast<uint32_t>(crowd.slots.living.size())};
    std::vector<uint64_t> cells;
    float speeds = 0;
    for (const WalkerId id : crowd.slots.living) {
        const float speed = length(crowd.motion.velocity[id.index]);
        if (speed > k_walks) ++figures.walking, speeds += speed;
        const Vec3 at = crowd.motion.position[id.index];
        auto cell = [](float metres) {
            return static_cast<uint32_t>(static_cast<int>(std::floor(metres / k_crowd_cell)));
        };
        cells.push_back(uint64_t{cell(at.z)} << 32 | cell(at.x));
    }
    if (figures.walking > 0) figures.speed = speeds / static_cast<float>(figures.walking);
    std::sort(cells.begin(), cells.end());
    size_t most = 0;
    for (size_t i = 0; i < cells.size();) {
        const size_t first = i;
        while (i < cells.size() && cells[i] == cells[first]) ++i;
        most = std::max(most, i - first);
    }
    if (!world.roam) figures.density = static_cast<float>(most) / (k_crowd_cell * k_crowd_cell);
    return figures;
}

}  // namespace flaneur
