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

}  // namespace flaneur
