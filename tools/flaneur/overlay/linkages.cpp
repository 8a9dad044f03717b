// What moves each linkage, how many iterations that took in the last tick, and by how much it misses its
// targets.
#include <algorithm>
#include <cstdio>

#include "tools/extract/convert.h"
#include "tools/flaneur/overlay/lettering.h"
#include "tools/flaneur/overlay/overlay.h"

namespace flaneur {

void add_linkage_gizmos(const OverlayInput& input, Overlay& overlay) {
    constexpr float k_letters = 10;                  // pixels
    constexpr float k_below = 0.2f, k_front = 0.5f;  // metres: from its lowest joint, on what it stands on
    constexpr float k_near = 0.0015f;                // metres that one may miss by and has come there
    constexpr size_t k_most_pleased = 8;             // targets that a tree can come to all at once
    const Linkages& linkages = input.world.linkages;
    for (size_t i = 0; i < linkages.all.size(); ++i) {
        const Linkage& linkage = linkages.all[i];
        if (linkage.kind == Linkage::Kind::led) continue;
        const auto [joints, targets] = linkages.ranges[i];
        const Solved& solved = linkages.solved[i];
        const glm::vec3 root =
            to_glm(lerp(linkages.previous_places[joints], linkages.places[joints], input.between));
        float low = root.y;
        for (const Vec3 rest : linkage.rest) low = std::min(low, linkage.root.middle.y + rest.y);
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
        const Method& method = linkages.methods[i];
        const bool is_dense = linkage.leads.size() > k_most_pleased;
        char numbers[96];
        std::snprintf(numbers, sizeof numbers, "%d iteration%s%s, %.1f mm off", solved.iterations,
                      solved.iterations == 1 ? "" : "s",
                      solved.iterations >= method.patience.iterations ? ", all that it may" : "",
                      1e3 * static_cast<double>(solved.off));
        std::string name = linkage.kind == Linkage::Kind::chain
                               ? std::string(k_solver_names[static_cast<size_t>(method.solver)])
                               : linkage.name;
        const std::string dense =
            is_dense ? std::to_string(linkage.leads.size()) + " tips, more than it can please" : "";
        float down = 0;
        for (const std::string_view words :
             {std::string_view(name), std::string_view(numbers), std::string_view(dense)}) {
            add_text(overlay.lines,
                     {{linkage.root.middle.x, low - k_below, linkage.root.middle.z + k_front},
                      {-0.5f * text_width(words, k_letters), down}},
                     words, ink(0xf6f3ec), k_letters);
            down += 1.8f * k_letters;
        }
    }
}

void add_figure_gizmos(const OverlayInput& input, Overlay& overlay) {
    constexpr float k_letters = 9, k_over = 0.3f;  // pixels; metres over the head
    constexpr float k_reach = 16;                  // metres from the eye
    const Troupe& figures = input.world.figures;
    for (size_t i = 0; i < figures.plans.size(); ++i) {
        const FigurePlan& plan = figures.plans[i];
        const Vec3 at = joint_between(figures, i, head, input.between).position;
        if (glm::length(to_glm(at) - input.camera.eye) > k_reach) continue;
        std::string now_at;
        if (plan.by == FigurePlan::By::keys) {
            const KeyInputs now =
                key_inputs(figures.gait.blocks[i / k_block], i % k_block, figures.moves[i].crouch);
            char numbers[80];
            std::snprintf(numbers, sizeof numbers, "speed %.2f, crouch %.2f, lean %+.2f, leap %.2f",
                          static_cast<double>(now.rows[key_speed]), static_cast<double>(now.rows[key_crouch]),
                          2 * static_cast<double>(now.rows[key_lean]) - 1,
                          static_cast<double>(now.rows[key_leap]));
            now_at = numbers;
        }
        float down = now_at.empty() ? 0 : -1.8f * k_letters;
        for (const std::string_view words : {std::string_view(plan.name), std::string_view(now_at)}) {
            add_text(overlay.lines,
                     {{at.x, at.y + k_over, at.z}, {-0.5f * text_width(words, k_letters), down}}, words,
                     ink(0xf6f3ec), k_letters);
            down += 1.8f * k_letters;
        }
    }
}

}  // namespace flaneur
