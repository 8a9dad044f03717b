#include "tools/flaneur/window/change/design.h"

#include <algorithm>
#include <utility>

namespace flaneur {

void change(Designs& d, Design next, uint64_t gesture) {
    if (next == current(d)) return;
    d.all.resize(d.at + 1);
    if (gesture != 0 && gesture == d.gesture && d.at > 0) {
        d.all[d.at] = std::move(next);
        return;
    }
    d.gesture = gesture;
    d.all.push_back(std::move(next));
    ++d.at;
}

bool undo(Designs& d) {
    d.gesture = 0;
    if (d.at == 0) return false;
    --d.at;
    return true;
}

bool redo(Designs& d) {
    d.gesture = 0;
    if (d.at + 1 >= d.all.size()) return false;
    ++d.at;
    return true;
}

void give_up(Designs& d) {
    d.gesture = 0;
    if (d.at == 0) return;
    d.all.resize(d.at);
    --d.at;
}

Scene scene_with(Scene s, const Design& d) {
    s.added = d.added;
    s.people = d.who;
    s.mix = d.mix;
    if (!d.platform.empty() && d.platform != platform_of(s)) s.platform = d.platform;
    if (s.hour != d.hour) s.sun_height = s.sun_heading = std::nullopt;
    s.hour = d.hour;
    s.is_overcast = d.is_overcast;
    s.walkers = static_cast<int>(d.people);
    return s;
}

Rectangle area_about(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
    constexpr float k_more = 1;  // metres
    Rectangle area{a[0], a[0]};
    for (const std::vector<Vec2>* outline : {&a, &b})
        for (const Vec2 p : *outline) {
            area.low = {std::min(area.low.x, p.x), std::min(area.low.z, p.z)};
            area.high = {std::max(area.high.x, p.x), std::max(area.high.z, p.z)};
        }
    return {area.low - Vec2{k_more, k_more}, area.high + Vec2{k_more, k_more}};
}

std::vector<Rectangle> changed_areas(const std::vector<Addition>& a, const std::vector<Addition>& b) {
    std::vector<Rectangle> areas;
    auto add_those_only_of = [&](const std::vector<Addition>& some, std::vector<Addition> others) {
        for (const Addition& one : some) {
            const auto same = std::find(others.begin(), others.end(), one);
            if (same == others.end())
                areas.push_back(area_of(one));
            else
                others.erase(same);
        }
    };
    add_those_only_of(a, b);
    add_those_only_of(b, a);
    return areas;
}

}  // namespace flaneur
