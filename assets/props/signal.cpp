// Traffic lights that work: heads with hooded lenses, and men on foot in them.
#include "assets/props/shapes.h"

namespace flaneur {

namespace {

constexpr float k_lens = 0.095f;  // metres, its radius
constexpr float k_face = 0.06f;   // half the depth of a head

// A man of boxes, upright or striding.
void add_man(PropMesh& mesh, const PropFrame& f, float y, float z, PropPart part) {
    auto box = [&](float x, float up, float half_x, float half_y) {
        add_box(mesh, f.at(x, y + up, z), {half_x, half_y, 0.006f}, f.yaw, part);
    };
    box(0, 0.063f, 0.016f, 0.016f);
    box(0, 0.015f, 0.019f, 0.03f);
    if (part == PropPart::walk_red) {
        for (const float side : {-1.0f, 1.0f}) box(0.03f * side, 0.013f, 0.007f, 0.031f);
        for (const float side : {-1.0f, 1.0f}) box(0.011f * side, -0.048f, 0.008f, 0.032f);
    } else {
        box(0.034f, 0.012f, 0.016f, 0.007f), box(-0.032f, 0.022f, 0.014f, 0.007f);
        box(0.02f, -0.032f, 0.009f, 0.018f), box(0.036f, -0.062f, 0.009f, 0.016f);
        box(-0.02f, -0.032f, 0.009f, 0.018f), box(-0.038f, -0.06f, 0.014f, 0.008f);
    }
}

// Lenses from the top, in a box that is fixed to the post.
void add_head(PropMesh& mesh, const PropFrame& f, float top, std::initializer_list<PropPart> lenses) {
    constexpr float k_pitch = 0.25f, k_ahead = 0.14f;
    const auto count = static_cast<float>(lenses.size());
    const float middle = top - count * k_pitch * 0.5f;
    add_box(mesh, f.at(0, middle, k_ahead), {0.13f, count * k_pitch * 0.5f, k_face}, f.yaw, PropPart::tyre);
    float y = top - k_pitch * 0.5f;
    for (const PropPart lens : lenses) {
        const float front = k_ahead + k_face;
        const bool is_man = lens == PropPart::walk_red || lens == PropPart::walk_green;
        if (is_man && !mesh.is_far) {
            add_post(mesh, f.at(0, y, front - 0.01f), f.at(0, y, front + 0.008f), k_lens, k_lens, 14,
                     PropPart::tyre, true);
            add_man(mesh, f, y - 0.008f, front + 0.012f, lens);
        } else {
            // Of a man far away, as much as it has.
            const float radius = is_man ? 0.7f * k_lens : k_lens;
            add_post(mesh, f.at(0, y, front - 0.01f), f.at(0, y, front + 0.015f), radius, radius,
                     mesh.is_far ? 6 : 14, lens, true);
        }
        if (!mesh.is_far) {
            add_box(mesh, f.at(0, y + 0.108f, front + 0.075f), {0.105f, 0.007f, 0.08f}, f.yaw,
                    PropPart::tyre);
            for (const float side : {-1.0f, 1.0f})
                add_box(mesh, f.at(0.102f * side, y + 0.06f, front + 0.055f), {0.006f, 0.05f, 0.06f}, f.yaw,
                        PropPart::tyre);
        }
        y -= k_pitch;
    }
}

}  // namespace

SignalHeads heads_of(const Prop& signal, const Crossing& c) {
    const Vec2 at = on_ground(signal.position);
    const OnCrossing on = on_crossing(c, at);
    SignalHeads heads;
    heads.walk_yaw = heading_of(on.over > 0 ? -c.across : c.across);
    // Cars keep to the right: of those on whose right it stands, and who come to it before the crossing.
    const Vec2 square{-c.along.z, c.along.x}, from = at - on_ground(c.centre);
    const Vec2 drive = dot(square, from) > 0 ? c.along : -c.along;
    if (dot(from, drive) < 0) heads.drive_yaw = heading_of(-drive);
    return heads;
}

void add_working_signal(PropMesh& mesh, const Prop& signal, const SignalHeads& heads) {
    constexpr float k_walk_top = 2.62f;
    const float top = heads.drive_yaw ? signal.height : k_walk_top + 0.08f;
    add_post(mesh, signal.position, signal.position + Vec3{0, top, 0}, 0.06f, 0.05f, 8, PropPart::metal,
             true);
    Prop turned = signal;
    turned.yaw = heads.walk_yaw;
    add_head(mesh, PropFrame(turned), k_walk_top, {PropPart::walk_red, PropPart::walk_green});
    if (!heads.drive_yaw) return;
    turned.yaw = *heads.drive_yaw;
    add_head(mesh, PropFrame(turned), signal.height,
             {PropPart::drive_red, PropPart::drive_amber, PropPart::drive_green});
}

}  // namespace flaneur
