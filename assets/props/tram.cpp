// A tram of five sections, low of floor, 2.4 m across: the middle ones hang between those on bogies.
#include "assets/props/bodies.h"
#include "assets/props/shapes.h"

namespace flaneur {

namespace {

constexpr float k_half = 1.2f, k_sill = 0.18f, k_roof = 3.1f;       // metres
constexpr float k_end = 2.68f, k_joint = 3;                         // of a body, where sections meet
constexpr float k_band_low = 0.9f, k_band = 2.42f, k_pane = 2.34f;  // of the dark band with the panes

BodySection whole_at(float z) { return {z, k_sill, 1.15f, 2.4f, k_half, k_roof, 1.06f}; }

void add_panes(PropMesh& mesh, float from, float to, int count) {
    constexpr float k_post = 0.07f;
    const float pitch = (to - from) / static_cast<float>(count);
    add_on_side(mesh, k_half + 0.006f, k_half + 0.004f, from, to, k_band_low, k_band, PropPart::tyre);
    for (int k = 0; k < count; ++k) {
        const float z = from + pitch * static_cast<float>(k);
        add_on_side(mesh, k_half + 0.012f, k_half + 0.01f, z + k_post, z + pitch - k_post, k_band_low + 0.1f,
                    k_pane, PropPart::glass);
    }
}

// Two leaves of glass in their frames, on both sides.
void add_doors(PropMesh& mesh, float z) {
    constexpr float k_wide = 1.3f, k_low = 0.34f, k_frame = 0.05f, k_out = 0.016f;
    add_on_side(mesh, k_half + k_out, k_half + k_out, z, z + k_wide, k_low, k_band, PropPart::metal);
    for (const float at : {z, z + k_wide / 2})
        add_on_side(mesh, k_half + k_out + 0.006f, k_half + k_out + 0.006f, at + k_frame,
                    at + k_wide / 2 - k_frame, k_low + 0.12f, k_pane, PropPart::glass);
}

// From the end of a body to that of the one behind: folds, dark and a little smaller.
void add_bellows(PropMesh& mesh) {
    constexpr int k_folds = 6;
    for (int k = 0; k < k_folds; ++k) {
        const float z = -k_end - 2 * (k_joint - k_end) * (static_cast<float>(k) + 0.5f) / k_folds;
        const float in = k % 2 == 0 ? 0.06f : 0.12f;
        add_box(mesh, {0, 1.68f - in / 2, z}, {k_half - in, 1.34f - in, (k_joint - k_end) / k_folds}, 0,
                PropPart::tyre);
    }
}

void add_roof(PropMesh& mesh, float from, float to) {
    add_box(mesh, {0, k_roof + 0.1f, (from + to) / 2}, {0.78f, 0.12f, (to - from) / 2}, 0, PropPart::alloy);
}

// Half raised: two arms and the strip that slides along a wire.
void add_collector(PropMesh& mesh) {
    const Vec3 foot{0, k_roof + 0.25f, -0.7f}, knee{0, 3.95f, 0.45f}, head{0, 4.45f, -0.35f};
    for (const float x : {-0.3f, 0.3f}) {
        const Vec3 off{x, 0, 0}, in{x * 0.4f, 0, 0};
        add_post(mesh, foot + off, knee + in, 0.03f, 0.025f, 6, PropPart::alloy, false);
        add_post(mesh, knee + in, head + off, 0.022f, 0.02f, 6, PropPart::alloy, false);
    }
    for (const float z : {-0.15f, 0.15f})
        add_box(mesh, head + Vec3{0, 0.03f, z}, {0.62f, 0.02f, 0.03f}, 0, PropPart::metal);
    for (const float side : {-1.0f, 1.0f})
        add_post(mesh, head + Vec3{side * 0.6f, 0.03f, 0}, head + Vec3{side * 0.85f, -0.14f, 0}, 0.02f,
                 0.012f, 6, PropPart::metal, false);
}

// A driver's end; lamps are added by who knows which end it is.
void add_cab(PropMesh& mesh) {
    const BodySection sections[] = {whole_at(-k_end),
                                    whole_at(1.9f),
                                    {2.45f, k_sill, 1.1f, 2.3f, 1.14f, 3.02f, 1},
                                    {2.88f, 0.2f, 1, 0.9f, 1.02f, 1.2f, 0.94f},
                                    {3, 0.32f, 0.88f, 0.72f, 0.92f, 0.96f, 0.84f}};
    add_skin(mesh, sections, PropPart::paint);
    add_panes(mesh, -k_end + 0.12f, -0.1f, 2);
    add_doors(mesh, -0.05f);
    // The driver's panes, and the one in front.
    add_on_side(mesh, k_half + 0.008f, k_half + 0.004f, 1.4f, 1.9f, 1.05f, k_pane, PropPart::glass);
    add_across(mesh, 0.9f, 1.24f, 2.9f, 2.86f, 2.515f, true, PropPart::glass);
    add_across(mesh, 0.55f, 2.84f, 2.525f, 2.99f, 2.485f, true, PropPart::tyre);
    add_box(mesh, {0, 0.5f, 2.97f}, {0.8f, 0.09f, 0.06f}, 0, PropPart::metal);
    add_roof(mesh, -2.3f, 1.4f);
}

// Turned about the upright by half.
PropMesh turned(PropMesh mesh) {
    for (PropMesh::Vertex& v : mesh.vertices) {
        v.position.x = -v.position.x, v.position.z = -v.position.z;
        v.normal.x = -v.normal.x, v.normal.z = -v.normal.z;
    }
    return mesh;
}

void append(PropMesh& mesh, const PropMesh& more) {
    const auto first = static_cast<uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), more.vertices.begin(), more.vertices.end());
    for (const uint32_t index : more.indices) mesh.indices.push_back(first + index);
}

}  // namespace

void add_tram(PropMesh& mesh, VehicleModel model) {
    const bool is_head = model == VehicleModel::tram_head, is_tail = model == VehicleModel::tram_tail;
    if (is_head || is_tail) {
        PropMesh cab;
        add_cab(cab);
        append(mesh, is_head ? cab : turned(std::move(cab)));
        for (const float x : {-0.72f, 0.72f}) {
            const float ahead = is_head ? 1.0f : -1.0f;
            add_box(mesh, {x, 0.76f, ahead * 2.97f}, {0.13f, 0.07f, 0.05f}, 0,
                    is_head ? PropPart::light : PropPart::red);
        }
    } else {
        const BodySection sections[] = {whole_at(-k_end), whole_at(k_end)};
        add_skin(mesh, sections, PropPart::paint);
        if (model == VehicleModel::tram_middle) {
            add_panes(mesh, -k_end + 0.12f, -0.75f, 1), add_panes(mesh, 0.75f, k_end - 0.12f, 1);
            add_doors(mesh, -0.65f);
            add_roof(mesh, -1.6f, 1.6f);
        } else {
            add_panes(mesh, -k_end + 0.12f, k_end - 0.12f, 4);
            add_roof(mesh, -1.2f, 1);
            add_collector(mesh);
        }
    }
    if (!is_tail) add_bellows(mesh);
}

}  // namespace flaneur
