#include "tools/flaneur/window/ask/curves.h"

#include <imgui.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/change/drive.h"
#include "tools/flaneur/window/viewer.h"
#include "tools/flaneur/window/widgets.h"

namespace flaneur {

namespace {

struct Slider {
    const char* name;
    float LimbCurves::*value;
    float low, high;
    const char* format;
    const char* what;
};
constexpr Slider k_sliders[] = {
    {"period", &LimbCurves::period, 0.5f, 4, "%.2f s", "of both steps"},
    {"leg forward", &LimbCurves::leg_forward, 0.1f, 0.45f, "x %.2f m", "half of a step and a third more"},
    {"leg up", &LimbCurves::leg_up, 0, 0.4f, "x %.2f m", "how high feet are lifted"},
    {"arm forward", &LimbCurves::arm_forward, 0, 0.6f, "x %.2f m", "how far hands swing"},
    {"arm up", &LimbCurves::arm_up, 0, 0.3f, "x %.2f m", "how far hands rise"},
    {"turning", &LimbCurves::turn_rate, 5, 120, "%.0f deg/s", "of turns that take longer than the shortest"},
    {"shortest turn", &LimbCurves::shortest_turn, 0.2f, 6, "%.1f s", "that any turn takes"},
    {"ray ahead", &LimbCurves::ray_ahead, 1, 10, "%.1f m",
     "at which one who goes by rays looks for another way"},
    {"rays aside", &LimbCurves::ray_aside, 1, 10, "%.1f m", "that must be free there"},
};

// One of them over both of its units, forth and back: metres, from its lowest to its highest.
void lay_out_curve(const char* name, float width, const LimbCurves& how,
                   float (*value)(const LimbCurves& how, float time)) {
    struct Asked {
        const LimbCurves& how;
        float (*value)(const LimbCurves& how, float time);
    } asked{how, value};
    constexpr int k_points = 64;
    auto at = [](void* data, int point) {
        const auto& of = *static_cast<const Asked*>(data);
        return of.value(of.how, 2 * static_cast<float>(point) / (k_points - 1));
    };
    float low = at(&asked, 0), high = low;
    for (int k = 1; k < k_points; ++k)
        low = std::min(low, at(&asked, k)), high = std::max(high, at(&asked, k));
    char span[48];
    std::snprintf(span, sizeof span, "%s, %.2f to %.2f m", name, static_cast<double>(low),
                  static_cast<double>(high));
    ImGui::PlotLines((std::string("##") + name).c_str(), at, &asked, k_points, 0, span, low, high,
                     {width, 2.6f * ImGui::GetTextLineHeight()});
}

void lay_out_all(const LimbCurves& how, float width) {
    lay_out_curve("leg, forward", width, how,
                  [](const LimbCurves& c, float time) { return targets_at(c, time).feet[0].ahead; });
    lay_out_curve("leg, up", width, how,
                  [](const LimbCurves& c, float time) { return targets_at(c, time).feet[0].up; });
    lay_out_curve("arm, forward", width, how,
                  [](const LimbCurves& c, float time) { return targets_at(c, time).hands[1].ahead; });
    lay_out_curve("arm, up", width, how,
                  [](const LimbCurves& c, float time) { return targets_at(c, time).hands[1].up; });
}

}  // namespace

void lead_limbs(Show& show, Viewer& v, LimbLead limbs, const LimbCurves& how) {
    World& world = *show.loaded.world;
    const LimbCurves was = world.crowd.march.how;
    const bool is_march = limbs == LimbLead::curves, was_march = is_on(world.crowd.march);
    if (is_march == was_march && how == was) return;
    go_by_curves(world, limbs, how);
    const bool changes_rays = how.ray_ahead != was.ray_ahead || how.ray_aside != was.ray_aside;
    if (!is_march && !was_march && !changes_rays) return;
    changed_by_hand(v.time, world);
    v.change.late = std::max(v.change.late, std::max(world.tick, 1u));
}

void lay_out_curves(Show& show, Viewer& v, float width) {
    if (!ImGui::CollapsingHeader("Limbs by curves")) return;
    const March& march = show.loaded.world->crowd.march;
    bool is_drawn = !v.techniques.on.gait, is_gone_by = is_on(march),
         is_by_turns = v.change.driving.is_by_turns;
    if (ImGui::Checkbox("limbs follow curves", &is_drawn)) v.techniques.on.gait = !is_drawn;
    tip("bodies are drawn as in The Walker Report; it is the technique gait, off");
    LimbCurves how = march.how;
    ImGui::Checkbox("people go at their pace", &is_gone_by);
    tip("those who go by rays do so as fast as the curves take them, and turn as slowly as said below");
    if (ImGui::Checkbox("drive by turns of 45 degrees", &is_by_turns)) drive_by_turns(show, v, is_by_turns);
    tip("Left and Right turn once, Up goes on, Down stops (Shift+X)");
    ImGui::PushItemWidth(width * 0.6f);
    for (const Slider& s : k_sliders) {
        ImGui::SliderFloat(s.name, &(how.*s.value), s.low, s.high, s.format, ImGuiSliderFlags_AlwaysClamp);
        tip(s.what);
    }
    ImGui::PopItemWidth();
    lay_out_all(how, width);
    if (ImGui::Button("As in the report")) how = {};
    lead_limbs(show, v, is_gone_by ? LimbLead::curves : LimbLead::gait, how);
}

}  // namespace flaneur
