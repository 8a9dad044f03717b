// What moves each linkage, how many iterations that took in the last tick, and by how much it misses its
// targets.
#include <algorithm>
#include <cstdio>

#include "tools/extract/convert.h"
#include "tools/flaneur/overlay/lettering.h"
#include "tools/flaneur/overlay/overlay.h"

namespace flaneur {

void add_linkage_gizmos(const OverlayInput& input, Overlay& overlay) {
    constexpr float k_letters = 10, k_over = 0.25f;  // pixels; metres over its highest joint
    constexpr float k_near = 0.0015f;                // metres that one may miss by and has come there
    const Linkages& linkages = input.world.linkages;
    for (size_t i = 0; i < linkages.all.size(); ++i) {
        const Linkage& linkage = linkages.all[i];
        if (linkage.kind == Linkage::Kind::led) continue;
        const auto [joints, targets] = linkages.ranges[i];
        const Solved& solved = linkages.solved[i];
        const glm::vec3 root =
            to_glm(lerp(linkages.previous_places[joints], linkages.places[joints], input.between));
        float top = root.y;
        for (size_t j = 0; j < linkage.rest.size(); ++j) top = std::max(top, root.y + linkage.rest[j].y);
        for (size_t j = 0; j < linkage.rest.size(); ++j) {
            const int e = linkage.shape.effectors[j];
            if (e == k_no_effector) continue;
            const size_t t = targets + static_cast<size_t>(e);
            const glm::vec3 end = to_glm(lerp(linkages.previous_places[joints + j],
                                              linkages.places[joints + j], input.between)),
                            target = to_glm(
                                lerp(linkages.previous_targets[t], linkages.targets[t], input.between));
            if (glm::length(target - end) < k_near) continue;
            add_line(overlay.lines,
                     {.pixels = 2, .colour = k_barred_colour, .place = GizmoPlace::in_world_hidden}, end,
                     target);
        }
        char numbers[64];
        std::snprintf(numbers, sizeof numbers, "%d iteration%s, %.1f mm off", solved.iterations,
                      solved.iterations == 1 ? "" : "s", 1e3 * static_cast<double>(solved.off));
        float down = 0;
        for (const std::string_view words : {std::string_view(linkage.name), std::string_view(numbers)}) {
            add_text(overlay.lines,
                     {{root.x, top + k_over, root.z}, {-0.5f * text_width(words, k_letters), down}}, words,
                     ink(0xf6f3ec), k_letters);
            down += 1.8f * k_letters;
        }
    }
}

}  // namespace flaneur
