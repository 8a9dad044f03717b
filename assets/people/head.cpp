#include <algorithm>
#include <array>
#include <cmath>

#include "assets/people/accessories.h"
#include "assets/people/face.h"
#include "assets/people/parts.h"

namespace flaneur {

Loft face_ellipsoid(Vec3 centre, Vec3 radii) {
    return make_ellipsoid(from_face(centre), radii * k_head_height);
}

Loft head_loft(std::span<const BodyRing> rings, float cap_begin, float cap_end) {
    std::vector<BodyRing> scaled(rings.begin(), rings.end());
    for (BodyRing& r : scaled) {
        float s = k_head_height;
        r.t *= s, r.side *= s, r.front *= s, r.width *= s, r.ahead *= s, r.behind *= s;
    }
    return make_loft(from_face({}), {1, 0, 0}, {0, 1, 0}, scaled, cap_begin * k_head_height,
                     cap_end * k_head_height);
}

Loft skull_loft(const Figure& figure) {
    float jaw = figure.face.jaw;
    BodyRing rings[] = {
        {.03f, 0, .23f, .135f * jaw, .135f, .12f, .1f},  {.10f, 0, .20f, .190f * jaw, .175f, .19f, .15f},
        {.20f, 0, .13f, .242f * jaw, .245f, .24f, .15f}, {.30f, 0, .06f, .276f * jaw, .315f, .32f, .1f},
        {.42f, 0, .01f, .303f, .360f, .41f, .1f},        {.55f, 0, -.01f, .325f, .380f, .44f, .1f},
        {.68f, 0, -.02f, .335f, .395f, .45f, .05f}};
    return head_loft(rings, .04f, .310f);
}

void add_head(Field& field, const Figure& figure) {
    auto part = [&](FieldBlend blend, float round, Loft loft) {
        field.parts.push_back({layer_skin, blend, round * k_head_height, 0, std::move(loft)});
    };
    auto add = [&](float round, Loft loft) { part(FieldBlend::add, round, std::move(loft)); };
    auto carve = [&](float round, Loft loft) { part(FieldBlend::carve, round, std::move(loft)); };
    const FaceShape& f = figure.face;
    Vec3 eye = f.eye;
    float s = f.eye_size, c = f.chin;

    add(.10f, skull_loft(figure));
    add(.10f, face_ellipsoid({0, .065f, .325f - .02f * (1 - c)}, {.100f * c, .062f * c, .062f * c}));  // chin
    add(.12f, face_ellipsoid({.195f * f.jaw, .200f, .080f}, {.060f, .090f, .120f}));
    add(.14f, face_ellipsoid({.150f * f.jaw, .285f, .215f}, Vec3{.095f, .110f, .120f} * f.cheek));
    add(.12f, face_ellipsoid({.195f, .395f, .200f}, Vec3{.085f, .065f, .095f} * f.cheek));
    add(.08f, face_ellipsoid({.10f, eye.y + .087f, .340f}, {.13f, .040f * f.brow, .040f * f.brow}));
    carve(.06f, face_ellipsoid({eye.x - .002f, eye.y, .425f}, {.080f, .050f, .058f}));  // socket
    add(.02f, face_ellipsoid(eye + Vec3{-.004f, 0, -.018f}, Vec3{.070f, .058f, .053f} * s));
    add(.012f, face_ellipsoid(eye + Vec3{0, .041f * s, .002f}, {.082f * s, .013f, .034f}));  // upper lid

    // The nose: bridge to tip, wings, and the underside cut square.
    float n = f.nose_width, tip_y = .520f - .195f * f.nose_length;
    Vec3 bridge = from_face({0, .520f, .345f}), tip = from_face({0, tip_y, .345f + .090f * f.nose_out});
    Vec3 down = normalize_or(tip - bridge, {0, -1, 0});
    float length_of_nose = length(tip - bridge), h = k_head_height;
    BodyRing nose[] = {{0, 0, 0, .024f * h * n, .028f * h, .05f * h},
                       {length_of_nose * .55f, 0, 0, .028f * h * n, .036f * h, .06f * h},
                       {length_of_nose, 0, 0, .034f * h * n, .040f * h, .06f * h}};
    add(.040f, make_loft(bridge, {-1, 0, 0}, down, nose, .04f * h, .034f * h));
    add(.030f, face_ellipsoid({.046f * n, tip_y - .017f, .355f + .038f * f.nose_out}, {.026f, .026f, .040f}));

    // Lips either side of a groove.
    add(.020f, face_ellipsoid({0, k_mouth_y + .020f, .355f}, {.093f * f.mouth, .020f * f.lips, .035f}));
    add(.020f, face_ellipsoid({0, k_mouth_y - .022f, .350f}, {.080f * f.mouth, .024f * f.lips, .036f}));
    carve(.012f, face_ellipsoid({0, k_mouth_y, .420f}, {.100f * f.mouth, .004f, .040f}));

    Vec3 lean = normalize_or({.12f, 1, -.22f}, {0, 1, 0});
    Vec3 outward = normalize_or(cross(lean, Vec3{-.25f, 0, 1}), {1, 0, 0});
    Vec3 ear = from_face({.335f, .430f, -.030f});
    add(.02f, make_ellipsoid(ear, Vec3{.026f, .120f, .066f} * (h * f.ear), outward, lean));
    carve(.02f, make_ellipsoid(ear + outward * (.030f * h) + Vec3{0, .008f, .006f} * h,
                               Vec3{.020f, .075f, .036f} * (h * f.ear), outward, lean));
}

namespace {

// Pointed at both ends, bowed up and down, head heights.
struct Almond {
    float half_width, up, down;
};

// Negative inside.
float outside(const Almond& a, float x, float y) {
    float height = y > 0 ? a.up : a.down;
    float bow = height * (1 - x * x / (a.half_width * a.half_width));
    return (y > 0 ? y : -y) - bow;
}

struct Features {
    Almond lid, eye, lips;
    float iris;                            // radius
    Vec3 brow;                             // its middle
    float thick, half_brow;                // half the brow's height at its inner end, and half its length
    static constexpr float k_tilt = .12f;  // of the eyes, outward and up
    static constexpr float k_arch = 1.1f;  // of the brows

    float thickness(float along) const { return thick * (1 - smoothstep(0, .09f, along) * .6f); }
    float arch(float along) const { return .012f - k_arch * along * along; }
};

Features features_of(const Figure& figure) {
    const FaceShape& f = figure.face;
    float s = f.eye_size;
    Features out;
    out.lid = {.084f * s, .046f * s, .012f};
    out.eye = {.069f * s, .031f * s, .021f * s};
    out.lips = {.098f * f.mouth, .027f * f.lips, .034f * f.lips};
    out.iris = .029f * s;
    out.brow = {f.eye.x + .012f, f.eye.y + lerp(.083f, .097f, figure.feminine), 0};
    out.thick = lerp(.0165f, .010f, figure.feminine);
    out.half_brow = .080f;
    return out;
}

// A corner of what is left of a triangle: its shares of the triangle's corners, and where that is.
struct Corner {
    Vec3 shares;
    Vec3 place;
};

// What is left of it to the left of the line from a to b, as seen from ahead.
std::vector<Corner> left_of(const std::vector<Corner>& piece, Vec3 a, Vec3 b) {
    auto side = [&](const Corner& c) {
        return (b.x - a.x) * (c.place.y - a.y) - (b.y - a.y) * (c.place.x - a.x);
    };
    std::vector<Corner> out;
    for (size_t i = 0; i < piece.size(); ++i) {
        const Corner &from = piece[i], &to = piece[(i + 1) % piece.size()];
        float at_from = side(from), at_to = side(to);
        if (at_from >= 0) out.push_back(from);
        if ((at_from >= 0) == (at_to >= 0)) continue;
        float t = at_from / (at_from - at_to);
        out.push_back({lerp(from.shares, to.shares, t), lerp(from.place, to.place, t)});
    }
    return out;
}

}  // namespace

void paint_face(const Figure& figure, Vec3 face, std::span<float> out) {
    float shown = out[material_skin];
    // Over whatever is shown so far, where `inside` is negative.
    auto paint = [&](Material m, float inside) {
        out[m] = shown + inside * k_head_height;
        shown = std::min(shown, out[m]);
    };
    const Features f = features_of(figure);
    float x = face.x < 0 ? -face.x : face.x;
    float ex = x - figure.face.eye.x, ey = face.y - figure.face.eye.y - Features::k_tilt * ex;
    float eye = outside(f.eye, ex, ey);
    paint(material_lash, std::max(outside(f.lid, ex, ey), -ey));
    paint(material_eye_white, eye);
    paint(material_iris, std::max(eye, std::sqrt(ex * ex + ey * ey) - f.iris));
    float at = x - f.brow.x, by = face.y - f.brow.y - f.arch(at);
    paint(material_brow, std::max((by > 0 ? by : -by) - f.thickness(at), (at > 0 ? at : -at) - f.half_brow));
    paint(material_lips, outside(f.lips, x, face.y - k_mouth_y));
}

bool is_painted(uint8_t material) { return material >= material_lips && material <= material_brow; }

std::vector<FacePatch> face_patches(const Figure& figure, bool with_glasses) {
    const Features f = features_of(figure);
    const Vec3 eye = figure.face.eye;
    const int above = with_glasses ? 2 : 0;  // coats that rims take
    const auto looks = material_looks(figure);
    std::vector<FacePatch> patches;
    auto add_patch = [&](Tint tint, uint32_t colour, int coat, const std::vector<Vec3>& outline,
                         bool mirrored) {
        FacePatch patch{tint, colour, coat, {}};
        for (Vec3 p : outline)
            patch.outline.push_back(warped(figure, from_face({mirrored ? -p.x : p.x, p.y, .4f})) *
                                    figure.height);
        if (mirrored) std::reverse(patch.outline.begin(), patch.outline.end());
        patches.push_back(std::move(patch));
    };
    auto add = [&](Material m, int coat, const std::vector<Vec3>& outline, bool mirrored) {
        add_patch(looks[m].tint, looks[m].colour, above + coat, outline, mirrored);
    };
    for (bool mirrored : {false, true}) {
        auto add_eye = [&](Material m, int coat, const std::vector<Vec3>& outline) {
            std::vector<Vec3> placed;
            placed.reserve(outline.size());
            for (Vec3 p : outline) placed.push_back({eye.x + p.x, eye.y + p.y + Features::k_tilt * p.x, 0});
            add(m, coat, placed, mirrored);
        };
        float w = f.lid.half_width, up = f.lid.up;
        add_eye(material_lash, 0, {{-w, 0, 0}, {w, 0, 0}, {.5f * w, .75f * up, 0}, {-.5f * w, .75f * up, 0}});
        w = f.eye.half_width, up = f.eye.up;
        float down = f.eye.down;
        add_eye(material_eye_white, 1,
                {{-w, 0, 0},
                 {-.5f * w, -.75f * down, 0},
                 {.5f * w, -.75f * down, 0},
                 {w, 0, 0},
                 {.5f * w, .75f * up, 0},
                 {-.5f * w, .75f * up, 0}});
        float r = f.iris;
        up = std::min(r, .9f * up), down = std::min(r, .9f * down);
        add_eye(material_iris, 2,
                {{-r, 0, 0},
                 {-.5f * r, -down, 0},
                 {.5f * r, -down, 0},
                 {r, 0, 0},
                 {.5f * r, up, 0},
                 {-.5f * r, up, 0}});
        for (float from : {-f.half_brow, 0.0f}) {
            float to = from + f.half_brow;
            auto at = [&](float along, float side) {
                return f.brow + Vec3{along, f.arch(along) + side * f.thickness(along), 0};
            };
            add(material_brow, 0, {at(from, -1), at(to, -1), at(to, 1), at(from, 1)}, mirrored);
        }
    }
    if (with_glasses) {
        const float thick = k_glasses_thick;
        for (bool mirrored : {false, true}) {
            add_patch(Tint::none, glasses_colour(figure), 0, glasses_rim(figure, 8, thick), mirrored);
            add_patch(Tint::skin, 0xffffffff, 1, glasses_rim(figure, 8, -thick), mirrored);
        }
        add_patch(Tint::none, glasses_colour(figure), 0,
                  {{-.06f, .507f - thick, 0},
                   {.06f, .507f - thick, 0},
                   {.06f, .507f + thick, 0},
                   {-.06f, .507f + thick, 0}},
                  false);
    }
    const Almond& l = f.lips;
    add(material_lips, 0,
        {{-l.half_width, k_mouth_y, 0},
         {-.5f * l.half_width, k_mouth_y - .75f * l.down, 0},
         {.5f * l.half_width, k_mouth_y - .75f * l.down, 0},
         {l.half_width, k_mouth_y, 0},
         {.5f * l.half_width, k_mouth_y + .75f * l.up, 0},
         {-.5f * l.half_width, k_mouth_y + .75f * l.up, 0}},
        false);
    return patches;
}

void lay_on(std::span<const FacePatch> patches, std::vector<uint32_t>& level, Character& person) {
    constexpr float k_coat = .0007f;  // metres: less is not told apart in the distance
    constexpr float k_least = 1e-6f;  // square metres: what is smaller is left out
    const size_t bare = level.size();
    for (const FacePatch& patch : patches)
        for (size_t t = 0; t + 2 < bare; t += 3) {
            std::array<CharacterVertex, 3> v;
            bool is_face = true;
            for (size_t i = 0; i < 3; ++i) {
                v[i] = person.vertices[level[t + i]];
                is_face = is_face && v[i].tint == Tint::skin && v[i].joints[0] == head;
            }
            if (!is_face || cross(v[1].position - v[0].position, v[2].position - v[0].position).z <= 0)
                continue;
            std::vector<Corner> piece = {
                {{1, 0, 0}, v[0].position}, {{0, 1, 0}, v[1].position}, {{0, 0, 1}, v[2].position}};
            for (size_t i = 0; i < patch.outline.size() && !piece.empty(); ++i)
                piece = left_of(piece, patch.outline[i], patch.outline[(i + 1) % patch.outline.size()]);
            const auto first = static_cast<uint32_t>(person.vertices.size());
            for (const Corner& c : piece) {
                CharacterVertex laid = v[0];
                laid.normal = normalize_or(
                    v[0].normal * c.shares.x + v[1].normal * c.shares.y + v[2].normal * c.shares.z,
                    v[0].normal);
                laid.position = c.place + Vec3{0, 0, k_coat * float(patch.coat + 1)};
                // Skin is white before it is tinted: what there is of it is light.
                float light = 0;
                const float shares[3] = {c.shares.x, c.shares.y, c.shares.z};
                for (size_t i = 0; i < 3; ++i) light += shares[i] * float(v[i].colour & 0xffu) / 255;
                laid.tint = patch.tint;
                laid.colour = scaled_colour(patch.colour, light);
                person.vertices.push_back(laid);
            }
            for (size_t i = 2; i < piece.size(); ++i) {
                Vec3 a = piece[0].place;
                if (length(cross(piece[i - 1].place - a, piece[i].place - a)) < k_least) continue;
                level.insert(level.end(),
                             {first, first + static_cast<uint32_t>(i) - 1, first + static_cast<uint32_t>(i)});
            }
        }
}

}  // namespace flaneur
