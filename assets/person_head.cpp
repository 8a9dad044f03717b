#include "assets/person_parts.h"

namespace flaneur {

namespace {

Loft face_ellipsoid(Vec3 centre, Vec3 radii) {
    return make_ellipsoid(from_face(centre), radii * k_head_height);
}

// A loft whose rings are given in head heights, t along y above the chin.
Loft head_loft(std::span<const Ring> rings, float cap_begin, float cap_end) {
    std::vector<Ring> scaled(rings.begin(), rings.end());
    for (Ring& r : scaled) {
        float s = k_head_height;
        r.t *= s, r.side *= s, r.front *= s, r.width *= s, r.ahead *= s, r.behind *= s;
    }
    return make_loft(from_face({}), {1, 0, 0}, {0, 1, 0}, scaled, cap_begin * k_head_height,
                     cap_end * k_head_height);
}

}  // namespace

Loft skull_loft(const Figure& figure) {
    float jaw = figure.woman ? .88f : 1;
    Ring rings[] = {
        {.03f, 0, .23f, .135f * jaw, .135f, .12f, .1f},  {.10f, 0, .20f, .190f * jaw, .175f, .19f, .15f},
        {.20f, 0, .13f, .242f * jaw, .245f, .24f, .15f}, {.30f, 0, .06f, .276f * jaw, .315f, .32f, .1f},
        {.42f, 0, .01f, .303f, .360f, .41f, .1f},        {.55f, 0, -.01f, .325f, .380f, .44f, .1f},
        {.68f, 0, -.02f, .335f, .395f, .45f, .05f}};
    return head_loft(rings, .04f, .310f);
}

void add_head(Field& field, const Figure& figure) {
    auto part = [&](Blend blend, float round, Loft loft) {
        field.parts.push_back({layer_skin, blend, round * k_head_height, 0, std::move(loft)});
    };
    auto add = [&](float round, Loft loft) { part(Blend::add, round, std::move(loft)); };
    auto carve = [&](float round, Loft loft) { part(Blend::carve, round, std::move(loft)); };
    bool w = figure.woman;

    float soft = w ? .86f : 1;
    add(.10f, skull_loft(figure));
    add(.10f, face_ellipsoid({0, .065f, .325f},
                             w ? Vec3{.075f, .052f, .052f} : Vec3{.100f, .062f, .062f}));  // chin
    add(.12f, face_ellipsoid({.195f * soft, .200f, .080f}, {.060f, .090f, .120f}));        // jaw
    add(.14f, face_ellipsoid({.150f * soft, .285f, .215f}, {.095f, .110f, .120f}));        // cheek
    add(.12f, face_ellipsoid({.195f, .395f, .200f}, {.085f, .065f, .095f}));               // cheekbone
    add(.08f, face_ellipsoid({.10f, .572f, .340f},
                             w ? Vec3{.11f, .030f, .026f} : Vec3{.13f, .040f, .040f}));  // brow
    carve(.06f, face_ellipsoid({.138f, .485f, .425f}, {.080f, .050f, .058f}));           // socket
    add(.02f, face_ellipsoid(k_eye + Vec3{-.004f, 0, -.018f}, {.070f, .058f, .053f}));   // eye and lids
    add(.012f, face_ellipsoid(k_eye + Vec3{0, .041f, .002f}, {.082f, .013f, .034f}));    // upper lid

    // The nose: bridge to tip, wings, and the underside cut square.
    float n = w ? .84f : 1;
    Vec3 bridge = from_face({0, .520f, .345f}), tip = from_face({0, .325f, w ? .425f : .435f});
    Vec3 down = normalize_or(tip - bridge, {0, -1, 0});
    float length_of_nose = length(tip - bridge), h = k_head_height;
    Ring nose[] = {{0, 0, 0, .024f * h * n, .028f * h, .05f * h},
                   {length_of_nose * .55f, 0, 0, .028f * h * n, .036f * h, .06f * h},
                   {length_of_nose, 0, 0, .034f * h * n, .040f * h, .06f * h}};
    add(.040f, make_loft(bridge, {-1, 0, 0}, down, nose, .04f * h, .034f * h));
    add(.030f, face_ellipsoid({.046f * n, .308f, .392f}, {.026f, .026f, .040f}));

    // Lips either side of a groove.
    add(.020f, face_ellipsoid({0, k_mouth_y + .020f, .355f}, {.095f, w ? .022f : .018f, .035f}));
    add(.020f, face_ellipsoid({0, k_mouth_y - .022f, .350f}, {.080f, w ? .026f : .022f, .036f}));
    carve(.012f, face_ellipsoid({0, k_mouth_y, .420f}, {.100f, .004f, .040f}));

    Vec3 lean = normalize_or({.12f, 1, -.22f}, {0, 1, 0});
    Vec3 outward = normalize_or(cross(lean, Vec3{-.25f, 0, 1}), {1, 0, 0});
    Vec3 ear = from_face({.335f, .430f, -.030f});
    add(.02f, make_ellipsoid(ear, Vec3{.026f, .120f, .066f} * h, outward, lean));
    carve(.02f, make_ellipsoid(ear + outward * (.030f * h) + Vec3{0, .008f, .006f} * h,
                               Vec3{.020f, .075f, .036f} * h, outward, lean));
}

void add_hair(Field& field, const Figure& figure) {
    float h = k_head_height;
    auto part = [&](Blend blend, float round, Loft loft, float grow = 0) {
        field.parts.push_back({layer_hair, blend, round * h, grow * h, std::move(loft)});
    };
    auto below = [&](Vec3 normal, Vec3 point) {  // what lies beyond the plane goes
        normal = normalize_or(normal, {0, -1, 0});
        field.parts.push_back(
            {layer_hair, Blend::keep, .03f * h, 0, {}, true, normal, dot(normal, from_face(point))});
    };

    if (figure.hair == Hair::bob || figure.hair == Hair::long_hair) {
        bool bob = figure.hair == Hair::bob;
        float low = bob ? .02f : -.42f;
        Ring fall[] = {
            {low, 0, bob ? -.10f : -.20f, bob ? .28f : .24f, bob ? .18f : .13f, bob ? .26f : .17f, .2f},
            {low + .14f, 0, bob ? -.10f : -.17f, bob ? .36f : .31f, bob ? .26f : .20f, .34f, .2f},
            {.28f, 0, -.08f, .385f, .32f, .42f, .15f},
            {.48f, 0, -.05f, .385f, .39f, .45f, .1f},
            {.66f, 0, -.03f, .372f, .425f, .47f, .05f}};
        part(Blend::add, 0, head_loft(fall, .06f, .380f));
        // The face looks out of an opening: under a fringe, or from either side of a parting.
        if (bob)
            part(Blend::carve, .05f, face_ellipsoid({0, .30f, .42f}, {.275f, .37f, .40f}));
        else
            part(Blend::carve, .05f, face_ellipsoid({0, .36f, .42f}, {.265f, .47f, .36f}));
        part(Blend::carve, .05f, face_ellipsoid({0, -.02f, .30f}, {.270f, .50f, .36f}));
        return;
    }

    float thick = figure.hair == Hair::cropped ? .018f : .032f;
    part(Blend::add, 0, trimmed(skull_loft(figure), .28f * h, .68f * h, .10f * h, .31f * h), thick);
    if (figure.hair == Hair::parted)
        part(Blend::add, .10f, face_ellipsoid({.10f, .90f, .12f}, {.19f, .10f, .26f}));
    if (figure.hair == Hair::full) {
        part(Blend::add, .10f, face_ellipsoid({.09f, .93f, .16f}, {.22f, .115f, .26f}));
        part(Blend::add, .10f, face_ellipsoid({.12f, .86f, -.16f}, {.22f, .14f, .26f}));
    }
    if (figure.hair == Hair::bun)
        part(Blend::add, .05f, face_ellipsoid({0, .74f, -.53f}, {.15f, .14f, .12f}));
    // The hairline: round the face, over the ears, and rising from the nape.
    bool quiff = figure.hair == Hair::parted || figure.hair == Hair::full;
    part(Blend::carve, .04f, face_ellipsoid({0, .36f, .44f}, {.340f, quiff ? .43f : .46f, .36f}));
    part(Blend::carve, .03f, face_ellipsoid({.34f, .26f, .12f}, {.18f, .24f, .20f}));
    below({0, -1, .55f}, {0, .17f, -.45f});
}

}  // namespace flaneur
