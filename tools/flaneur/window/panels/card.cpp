#include "tools/flaneur/window/panels/card.h"

#include <imgui.h>

#include "tools/flaneur/window/ask/facts.h"
#include "tools/flaneur/window/ask/gait.h"
#include "tools/flaneur/window/change/drive.h"
#include "tools/flaneur/window/widgets.h"

namespace flaneur {
namespace {

void lay_out_who(const WalkerFacts& f) {
    ImGui::TextUnformatted(told_who(f).c_str());
    ImGui::SameLine();
    ImGui::TextDisabled("no. %u", f.number);
    if (f.creature > 0) return ImGui::Text("%.2f m long", wide(f.creature));
    ImGui::Text("%.2f m tall", wide(f.height));
    std::string has;
    auto add = [&](bool it_has, const char* what) {
        if (it_has) has.append(has.empty() ? "with " : ", ").append(what);
    };
    add(f.pram, "a pram"), add(f.cane, "a cane"), add(f.bag != Bag::none, told(f.bag));
    add(f.phone, "a phone"), add(f.glasses, "glasses");
    if (!has.empty()) ImGui::TextUnformatted(has.c_str());
    if (const std::string nature = told_nature(f.personality); !nature.empty())
        ImGui::TextUnformatted(nature.c_str());
}

void lay_out_way(const WalkerFacts& f) {
    ImGui::Text("%.2f m/s, likes %.2f", wide(f.speed), wide(f.preferred));
    ImGui::TextUnformatted(told_doing(f).c_str());
    if (f.doing == Doing::roams) return;
    const bool is_there = f.doing == Doing::stays || f.doing == Doing::arrived;
    if (is_there && f.to) ImGui::Text("at %s", told(*f.to));
    if (is_there) return;
    if (f.from) ImGui::Text("set out by %s", told(*f.from));
    if (f.to)
        ImGui::Text("%.0f m to %s", wide(f.to_go), told(*f.to));
    else
        ImGui::Text("%.0f m to go", wide(f.to_go));
}

void lay_out_walker(Show& show, uint32_t walker, Viewer& v, float scale) {
    const WalkerFacts facts = facts_of(show, walker);
    lay_out_who(facts);
    lay_out_way(facts);
    if (!v.selected) {
        ImGui::TextDisabled("click to keep, F to look at");
        return;
    }
    if (ImGui::Button("Follow")) v.choice.walker = walker, choose(v, CameraChoice::Kind::follow);
    tip("Shift+F");
    go_beside("Eyes", scale);
    if (ImGui::Button("Eyes")) v.choice.walker = walker, choose(v, CameraChoice::Kind::eyes);
    tip("4");
    go_beside("Stop driving", scale);
    if (ImGui::Button(is_driving(show) ? "Stop driving" : "Drive")) drive_asked(show, v);
    tip("X");
    go_beside("Push", scale);
    if (ImGui::Button("Push")) push_asked(show, v, ImGui::GetIO().KeyShift ? k_hard_shove : k_shove);
    tip("P; with Shift so hard that it falls");
    go_beside("Gait", scale);
    if (ImGui::Button("Gait")) v.room = v.room == Room::gait ? Room::none : Room::gait;
    tip("the angles of its legs, and its steps (J)");
    go_beside("Let go", scale);
    if (ImGui::Button("Let go")) v.selected.reset();
    tip("Esc");
    if (ImGui::CollapsingHeader("Speed of late")) lay_out_speed(v.watch, fitted(260, scale), scale);
}

void lay_out_thing(const Thing& thing, bool is_selected, Viewer& v) {
    const ThingFacts facts = facts_of(v.asking.index, thing);
    ImGui::TextUnformatted(facts.title.c_str());
    for (const std::string& line : facts.lines) ImGui::TextDisabled("%s", line.c_str());
    if (is_selected && ImGui::Button("Let go")) v.asking.selected.reset();
}

struct Asked {
    std::optional<uint32_t> who;
    std::optional<Thing> thing;
};
// A walker who is selected or pointed at goes before other things; what is selected before what is pointed
// at. Of the ground one asks by a click.
Asked asked_of(const Viewer& v) {
    Asked asked{v.selected, v.asking.selected};
    if (asked.who || asked.thing) return asked;
    asked = {v.hovered, v.asking.hovered};
    if (asked.thing && asked.thing->kind == ThingKind::ground) asked.thing.reset();
    return asked;
}

}  // namespace

Card card_of(const Show& show, Viewer& v) {
    if (v.selected && !is_there(show.loaded.world->crowd, *v.selected)) v.selected.reset();
    if (v.selected || v.asking.selected) return Card::kept;
    const Asked asked = asked_of(v);
    return asked.who || asked.thing ? Card::glimpse : Card::none;
}

void lay_out_card(Show& show, Viewer& v, float scale) {
    const Asked asked = asked_of(v);
    if ((!asked.who && !asked.thing) || !begin_side(v, SidePanel::card, "who", nullptr, k_plain)) return;
    if (asked.who)
        lay_out_walker(show, *asked.who, v, scale);
    else
        lay_out_thing(*asked.thing, v.asking.selected.has_value(), v);
    end_side(v, SidePanel::card);
}

}  // namespace flaneur
