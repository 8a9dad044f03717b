#include "tools/flaneur/window/change/who.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>

#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/actions.h"
#include "tools/flaneur/window/change/room.h"
#include "tools/flaneur/window/time/time.h"
#include "tools/flaneur/window/widgets.h"

namespace flaneur {
namespace {

constexpr float k_slider = 150;  // pixels, at scale 1

struct Group {
    const char *name, *hint;
    float PeopleMix::*times;
};
constexpr Group k_groups[] = {{"children", "below 14 years", &PeopleMix::children},
                              {"old people", "of 65 years and more", &PeopleMix::old},
                              {"with canes", "in the right hand", &PeopleMix::canes},
                              {"with prams", "pushed with both hands", &PeopleMix::prams},
                              {"with phones", "that they look at", &PeopleMix::phones}};

template <float PeopleMix::*Times, bool More>
void change_mix(Show&, Viewer& v) {
    Design next = current(v.change.designs);
    float& times = next.mix.*Times;
    times = More ? std::clamp(2 * times, 1.0f, k_most_mix) : times > 0.2f ? times / 2 : 0;
    want(v, std::move(next));
}

void make_all_anew(Show& show, Viewer& v) { restart(show, v, show.loaded.world->seed); }

constexpr std::array k_actions = {
    Action{"More children", "", 0, 0, change_mix<&PeopleMix::children, true>},
    Action{"Fewer children", "", 0, 0, change_mix<&PeopleMix::children, false>},
    Action{"More old people", "", 0, 0, change_mix<&PeopleMix::old, true>},
    Action{"Fewer old people", "", 0, 0, change_mix<&PeopleMix::old, false>},
    Action{"More people with canes", "", 0, 0, change_mix<&PeopleMix::canes, true>},
    Action{"Fewer people with canes", "", 0, 0, change_mix<&PeopleMix::canes, false>},
    Action{"More people with prams", "", 0, 0, change_mix<&PeopleMix::prams, true>},
    Action{"Fewer people with prams", "", 0, 0, change_mix<&PeopleMix::prams, false>},
    Action{"More people with phones", "", 0, 0, change_mix<&PeopleMix::phones, true>},
    Action{"Fewer people with phones", "", 0, 0, change_mix<&PeopleMix::phones, false>},
    Action{"As many of each as usual", "", 0, 0,
           [](Show&, Viewer& v) {
               Design next = current(v.change.designs);
               next.mix = {};
               want(v, std::move(next));
           }},
    Action{"Make all people anew", "", 0, 0, make_all_anew},
};

bool has_built_in(const Show& show) {
    return std::ranges::any_of(show.loaded.parts, [](const PeopleShare& p) { return p.character.empty(); });
}

void lay_out_mix(Viewer& v, float scale) {
    Design next = current(v.change.designs);
    for (const Group& group : k_groups) {
        float& times = next.mix.*group.times;
        ImGui::SetNextItemWidth(k_slider * scale);
        const bool is_slid = ImGui::SliderFloat(group.name, &times, 0, k_most_mix, "%.1f x usual",
                                                ImGuiSliderFlags_AlwaysClamp);
        const uint64_t gesture = gesture_of_item(v.change);
        tip(group.hint);
        if (!is_slid) continue;
        times = std::round(10 * times) / 10;
        want(v, next, gesture);
    }
}

void lay_out_shares(Viewer& v, float scale) {
    Design next = current(v.change.designs);
    if (next.who.size() < 2) return;
    float all = 0;
    for (const PeopleShare& some : next.who) all += some.share;
    for (size_t i = 0; i < next.who.size(); ++i) {
        PeopleShare& some = next.who[i];
        const std::string name =
            some.character.empty() ? "built-in" : std::filesystem::path(some.character).filename().string();
        char text[32];
        std::snprintf(text, sizeof text, "%%.3g, %.0f %%%%", static_cast<double>(100 * some.share / all));
        ImGui::PushID(static_cast<int>(i));
        ImGui::SetNextItemWidth(k_slider * scale);
        const bool is_slid = ImGui::SliderFloat(name.c_str(), &some.share, static_cast<float>(k_least_share),
                                                static_cast<float>(k_most_share), text,
                                                ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
        const uint64_t gesture = gesture_of_item(v.change);
        tip("their part against the others' parts");
        ImGui::PopID();
        if (is_slid) want(v, next, gesture);
    }
}

}  // namespace

std::span<const Action> who_actions() { return k_actions; }

void lay_out_who(Show& show, Viewer& v, float scale) {
    if (!ImGui::CollapsingHeader("Who comes")) return;
    if (has_built_in(show)) lay_out_mix(v, scale);
    lay_out_shares(v, scale);
    if (ImGui::Button("Make all anew")) make_all_anew(show, v);
    tip("the run begins again, all of it with people like these");
    ImGui::SameLine();
    ImGui::TextDisabled("who is there stays");
}

}  // namespace flaneur
