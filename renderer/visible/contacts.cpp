#include "renderer/visible/contacts.h"

#include <algorithm>

#include "renderer/shared.h"

namespace flaneur {

namespace {

bool is_there(const GroundPlane& ground) { return ground.normal != glm::vec3(0); }

// Metres above it.
float height_above(const GroundPlane& ground, glm::vec3 place) {
    return glm::dot(ground.normal, place - ground.place);
}

// How much of a spot is left of what is so high above the ground and would leave none at `gone`.
float nearness(float height, float gone) { return std::clamp(1 - height / gone, 0.0f, 1.0f); }

// Appends those of one walker.
void find_contacts(const CrowdInput& input, const WalkerDraw& walker, std::span<const JointTransform> palette,
                   std::span<const GroundBelow> grounds, const View& view, std::vector<Contact>& contacts) {
    constexpr float foot_radius = 0.19f, body_radius = 0.55f, pram_radius = 0.6f;
    constexpr float foot_strength = 0.55f, body_strength = 0.28f, pram_strength = 0.45f;
    constexpr float foot_gone = 0.12f, body_gone = 0.7f;  // metres of the soles above the ground
    constexpr float gone = k_least_contact, whole = 48;   // pixels between which spots fade in
    const size_t own = walker.instance.palette / k_palette_joints;
    if (walker.instance.palette == k_no_palette || own >= grounds.size() || !is_drawable(input, walker) ||
        !sees_sphere(view, walker.centre, walker.radius))
        return;
    const float size = pixels_of(view, walker.centre, walker.radius);
    const float shown =
        std::clamp((size - gone) / (whole - gone), 0.0f, 1.0f) * (static_cast<float>(walker.presence) / 255);
    if (!(shown > 0)) return;
    const GroundBelow& ground_below = grounds[own];
    const PersonRanges& person = input.people[walker.mesh];
    const JointTransform* joints = &palette[walker.instance.palette];
    const float scale = walker.instance.scale;
    const glm::vec3 soles[2] = {moved_by(joints[k_left_foot], person.soles[0] * scale),
                                moved_by(joints[k_right_foot], person.soles[1] * scale)};
    const size_t first = contacts.size();
    glm::vec3 low(1e30f), high(-1e30f);
    auto add = [&](const GroundPlane& ground, glm::vec3 above, float radius, float strength) {
        if (!(strength > 0)) return;
        const glm::vec3 place = above - ground.normal * height_above(ground, above);
        contacts.push_back({place, radius, ground.normal, strength * shown});
        const glm::vec3 reach =
            radius * glm::sqrt(glm::max(1.0f - ground.normal * ground.normal, glm::vec3(0))) + 0.02f;
        low = glm::min(low, place - reach);
        high = glm::max(high, place + reach);
    };
    for (int side = 0; side < 2; ++side) {
        const GroundPlane& ground = ground_below.feet[side];
        if (!is_there(ground)) continue;
        const float height = height_above(ground, soles[side]) / scale;
        add(ground, soles[side], foot_radius * scale, foot_strength * nearness(height, foot_gone));
    }
    if (is_there(ground_below.body)) {
        const float height =
            std::min(height_above(ground_below.body, soles[0]), height_above(ground_below.body, soles[1])) /
            scale;
        add(ground_below.body, (soles[0] + soles[1]) * 0.5f, body_radius * scale,
            body_strength * nearness(height, body_gone));
    }
    if (is_there(ground_below.pram))
        add(ground_below.pram, ground_below.pram.place, pram_radius, pram_strength);
    if (input.hidden && contacts.size() > first && is_hidden(*input.hidden, view, low, high))
        contacts.resize(first);
}

}  // namespace

void find_contacts(const CrowdInput& input, std::span<const JointTransform> palette,
                   std::span<const GroundBelow> grounds, const View& view, std::vector<Contact>& contacts) {
    std::vector<std::vector<Contact>> found(chunk_count(input));
    in_chunks(input, [&](size_t chunk, size_t begin, size_t end) {
        for (const WalkerDraw& walker : input.walkers.subspan(begin, end - begin))
            find_contacts(input, walker, palette, grounds, view, found[chunk]);
    });
    contacts.clear();
    for (const std::vector<Contact>& some : found) contacts.insert(contacts.end(), some.begin(), some.end());
}

}  // namespace flaneur
