#include "renderer/visible/contacts.h"

#include <algorithm>

namespace flaneur {

void find_contacts(const CrowdInput& input, std::span<const JointTransform> palette, const View& view,
                   std::vector<Contact>& contacts) {
    constexpr float foot_radius = 0.19f, body_radius = 0.55f;
    constexpr float foot_strength = 0.55f, body_strength = 0.28f;
    constexpr float lifted = 0.12f;  // a foot this high above the other leaves no spot, metres
    constexpr float gone = k_least_contact, whole = 48;  // pixels between which spots fade in
    contacts.clear();
    for (const WalkerDraw& walker : input.walkers) {
        if (!walker.is_upright || walker.instance.palette == k_no_palette || !is_drawable(input, walker) ||
            !sees_sphere(view, walker.centre, walker.radius))
            continue;
        const float size = pixels_of(view, walker.centre, walker.radius);
        const float shown = std::clamp((size - gone) / (whole - gone), 0.0f, 1.0f);
        if (!(shown > 0)) continue;
        const PersonRanges& person = input.people[walker.mesh];
        const JointTransform* joints = &palette[walker.instance.palette];
        const float scale = walker.instance.scale;
        const glm::vec3 left = moved_by(joints[k_left_foot], person.soles[0] * scale);
        const glm::vec3 right = moved_by(joints[k_right_foot], person.soles[1] * scale);
        const float ground = std::min(left.y, right.y);
        const glm::vec3 middle = (left + right) * 0.5f,
                        reach(body_radius * scale, 0.02f, body_radius * scale);
        const glm::vec3 under(middle.x, ground, middle.z);
        const glm::vec3 aside = glm::abs(left - right) * glm::vec3(0.5f, 0, 0.5f);
        if (input.hidden && is_hidden(*input.hidden, view, under - aside - reach, under + aside + reach))
            continue;
        for (const glm::vec3& sole : {left, right}) {
            const float near = 1 - (sole.y - ground) / (lifted * scale);
            if (near > 0)
                contacts.push_back(
                    {{sole.x, ground, sole.z}, foot_radius * scale, foot_strength * near * shown});
        }
        contacts.push_back({under, body_radius * scale, body_strength * shown});
    }
}

}  // namespace flaneur
