#include "tools/flaneur/window/panels.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>

#include "sim/base/tick.h"

namespace flaneur {
namespace {

// Without ways by keyboard, for Tab and the arrows are the city's.
constexpr ImGuiWindowFlags k_plain = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                                     ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoNav;

struct KeyRow {
    const char *keys, *what;
};
constexpr std::array k_keys = {
    KeyRow{"Space", "stop and go"},
    KeyRow{".", "one tick, 1/60 s"},
    KeyRow{"-  +", "slower, faster"},
    KeyRow{"W A S D  arrows", "fly; Shift: fast"},
    KeyRow{"Q E", "down, up"},
    KeyRow{"drag", "look about"},
    KeyRow{"wheel", "nearer, farther"},
    KeyRow{"middle, right", "drag along, round"},
    KeyRow{"click", "ask who that is"},
    KeyRow{"F", "follow who was asked"},
    KeyRow{"1  2", "street, overview"},
    KeyRow{"3  Tab", "follow; the next one"},
    KeyRow{"L  F2 - F11", "layers"},
    KeyRow{"F12", "a picture, into out/"},
    KeyRow{"C", "copy the command that draws this"},
    KeyRow{"H", "no panels, and back"},
    KeyRow{"F1", "this list"},
    KeyRow{"Esc", "close"},
};

std::string clock_text(const Show& show) {
    const float seconds = static_cast<float>(show.loaded.world->tick) * k_tick;
    const double hour =
        static_cast<double>(show.loaded.world->crowd.demand.hour) + static_cast<double>(seconds) / 3600;
    const auto second = static_cast<int>(std::fmod(hour, 24.0) * 3600);
    char text[32];
    std::snprintf(text, sizeof text, "%02d:%02d:%02d", second / 3600, second / 60 % 60, second % 60);
    return text;
}

void tip(const char* what) {
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", what);
}

void lay_out_bar(const Show& show, Viewer& v, float scale) {
    ImGui::SetNextWindowPos({10 * scale, 10 * scale});
    if (!ImGui::Begin("time", nullptr, k_plain)) return ImGui::End();
    if (ImGui::Button(v.clock.is_paused ? "  Go  " : " Stop ")) v.clock.is_paused = !v.clock.is_paused;
    tip("Space");
    ImGui::SameLine();
    if (ImGui::Button("Step")) v.clock.is_paused = true, ++v.clock.steps;
    tip("one tick, 1/60 s (.)");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(110 * scale);
    ImGui::SliderFloat("##rate", &v.clock.rate, k_least_rate, k_most_rate, "%.2g x",
                       ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    tip("how fast time goes by (- and +)");
    ImGui::SameLine();
    ImGui::Text("%s", clock_text(show).c_str());
    ImGui::SameLine();
    ImGui::TextDisabled("%u people   %.0f fps%s", v.walkers, v.fps,
                        v.resolution < 1 ? "   coarser while you move" : "");
    ImGui::SameLine();
    if (ImGui::Button("Layers")) v.lists_layers = !v.lists_layers;
    tip("what is drawn over the city (L)");
    ImGui::SameLine();
    if (ImGui::Button("Keys")) v.lists_keys = !v.lists_keys;
    tip("F1");
    ImGui::End();
}

void lay_out_layers(const Show& show, Viewer& v, float scale) {
    if (!v.lists_layers) return;
    ImGui::SetNextWindowPos({10 * scale, 58 * scale});
    if (ImGui::Begin("layers", nullptr, k_plain)) {
        for (int i = 0; i < k_work_views; ++i) {
            bool is_on = show.work_views[static_cast<WorkView>(i)];
            if (ImGui::Checkbox(k_work_view_names[i], &is_on)) v.toggles.push_back(static_cast<WorkView>(i));
            ImGui::SameLine(130 * scale);
            ImGui::TextDisabled("F%d", i + 2);
        }
    }
    ImGui::End();
}

// "so far 43 %" as 0.43.
std::optional<float> share_of(const std::string& line) {
    if (!line.ends_with(" %")) return {};
    const size_t space = line.rfind(' ', line.size() - 3);
    return space == std::string::npos ? std::nullopt
                                      : std::optional(std::strtof(&line[space], nullptr) / 100);
}

const char* doing(const World& world, uint32_t walker) {
    const Journey& journey = world.crowd.journeys[walker];
    if (journey.arrived) return "stands at its goal";
    if (world.tick < journey.pause_until) return "waits a moment";
    if (journey.path_due != PathDue::no) return "looks for a way";
    if (journey.stuck > 0) return "does not get on";
    return "on the way";
}

void lay_out_card(const Show& show, Viewer& v, Size size, float scale) {
    const World& world = *show.loaded.world;
    if (v.selected && !is_there(world.crowd, *v.selected)) v.selected.reset();
    const std::optional<uint32_t> who = v.selected ? v.selected : v.hovered;
    if (!who) return;
    const uint32_t walker = *who, kind = world.crowd.identity.body[walker];
    const Character& character = show.loaded.characters[kind];
    const float height = world.kinds[kind].body.height * world.crowd.identity.scale[walker];
    const Vec2 velocity = world.crowd.motion.velocity[walker];
    ImGui::SetNextWindowPos({static_cast<float>(size.width) - 10 * scale, 10 * scale}, ImGuiCond_Always,
                            {1, 0});
    if (!ImGui::Begin("who", nullptr, k_plain)) return ImGui::End();
    if (character.found.scale == 0)
        ImGui::Text("%s, %.0f", character.person.woman ? "Woman" : "Man",
                    static_cast<double>(character.person.age));
    else
        ImGui::Text("%s", character.name.c_str());
    ImGui::SameLine();
    ImGui::TextDisabled("no. %u", walker);
    ImGui::Text("%.2f m tall", static_cast<double>(height));
    ImGui::Text("%.2f m/s, likes %.2f", static_cast<double>(length(velocity)),
                static_cast<double>(world.crowd.identity.preferred_speed[walker]));
    if (!world.roam) {
        const Vec3 goal = world.crowd.journeys[walker].goal.position,
                   at = world.crowd.motion.position[walker];
        ImGui::Text("%s, %.0f m to go", doing(world, walker), static_cast<double>(length(goal - at)));
    }
    if (!v.selected) {
        ImGui::TextDisabled("click to keep, F to follow");
    } else {
        if (ImGui::Button("Follow")) v.choice.walker = walker, choose(v, CameraChoice::Kind::follow);
        tip("F");
        ImGui::SameLine();
        if (ImGui::Button("Let go")) v.selected.reset();
    }
    ImGui::End();
}

void lay_out_keys(Viewer& v, Size size) {
    if (!v.lists_keys) return;
    ImGui::SetNextWindowPos({static_cast<float>(size.width) / 2, static_cast<float>(size.height) / 2},
                            ImGuiCond_Always, {0.5f, 0.5f});
    if (ImGui::Begin("Keys", &v.lists_keys,
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                         ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoNav) &&
        ImGui::BeginTable("keys", 2)) {
        for (const KeyRow& row : k_keys) {
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(row.keys);
            ImGui::TableNextColumn();
            ImGui::TextDisabled("%s", row.what);
        }
        ImGui::EndTable();
    }
    ImGui::End();
}

void lay_out_note(const Viewer& v, Size size, float scale) {
    if (ImGui::GetTime() >= v.note_until) return;
    ImGui::SetNextWindowPos(
        {static_cast<float>(size.width) / 2, static_cast<float>(size.height) - 12 * scale}, ImGuiCond_Always,
        {0.5f, 1});
    if (ImGui::Begin("note", nullptr, k_plain | ImGuiWindowFlags_NoInputs)) {
        ImGui::PushTextWrapPos(std::max(static_cast<float>(size.width) - 60 * scale, 100.0f));
        ImGui::TextUnformatted(v.note.c_str());
        ImGui::PopTextWrapPos();
    }
    ImGui::End();
}

}  // namespace

void tell(Viewer& viewer, const std::string& what) {
    constexpr double k_seconds = 5;
    viewer.note = what;
    viewer.note_until = ImGui::GetTime() + k_seconds;
}

void lay_out_loading(const std::string& city, const std::string& doing, Size size) {
    ImGui::SetNextWindowPos({static_cast<float>(size.width) / 2, static_cast<float>(size.height) / 2},
                            ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(460.0f, static_cast<float>(size.width)), 0});
    if (ImGui::Begin("loading", nullptr, k_plain)) {
        ImGui::Text("%s", city.c_str());
        // A bar where the line says how many hundredths; else dots that come and go.
        const std::optional<float> share = share_of(doing);
        const auto dots = static_cast<size_t>(ImGui::GetTime() * 3) % 4;
        const std::string line = doing.empty() ? "opening" : doing;
        ImGui::TextDisabled("%s", (share ? line : line + std::string(dots, '.')).c_str());
        ImGui::ProgressBar(share.value_or(0), {-1, 6}, "");
        ImGui::TextDisabled("Esc closes");
    }
    ImGui::End();
}

void lay_out_panels(const Show& show, Viewer& viewer, Size size, float scale) {
    lay_out_keys(viewer, size);
    lay_out_note(viewer, size, scale);
    if (!viewer.has_panels) return;
    lay_out_bar(show, viewer, scale);
    lay_out_layers(show, viewer, scale);
    lay_out_card(show, viewer, size, scale);
}

}  // namespace flaneur
