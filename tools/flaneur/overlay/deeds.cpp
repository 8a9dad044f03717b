// What those do who do things with their hands, in words, and where hands and feet hold and stand.
#include "sim/deeds/deeds.h"

#include "tools/extract/convert.h"
#include "tools/flaneur/overlay/lettering.h"
#include "tools/flaneur/overlay/overlay.h"

namespace flaneur {

void add_deed_gizmos(const OverlayInput& input, Overlay& overlay) {
    constexpr float k_letters = 9, k_over = 0.3f;  // pixels; metres over the head
    constexpr float k_reach = 24;                  // metres from the eye
    constexpr uint32_t k_hand = ink(0xf2a53c), k_foot = ink(0x62c0e6);
    const Deeds& deeds = input.world.deeds;
    for (size_t i = 0; i < deeds.plans.size(); ++i) {
        const Vec3 at = joint_between(deeds, i, head, input.between).position;
        if (glm::length(to_glm(at) - input.camera.eye) > k_reach) continue;
        const std::string words = what_it_does(deeds, i);
        add_text(overlay.lines, {{at.x, at.y + k_over, at.z}, {-0.5f * text_width(words, k_letters), 0}},
                 words, ink(0xf6f3ec), k_letters);
        const DeedContacts contacts = contacts_of(deeds, i);
        Pen pen{.pixels = 8, .colour = k_hand};
        for (size_t side = 0; side < 2; ++side)
            if (contacts.holds[side]) add_point(overlay.lines, pen, to_glm(contacts.palms[side]));
        pen.colour = k_foot;
        for (const Side side : {k_left, k_right}) {
            if (!contacts.stands[side]) continue;
            const Joint toes = side == k_left ? left_toes : right_toes;
            add_point(overlay.lines, pen, to_glm(joint_between(deeds, i, toes, input.between).position));
        }
    }
}

}  // namespace flaneur
