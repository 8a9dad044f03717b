#include "assets/people/parts.h"
#include "sim/base/rng.h"

namespace flaneur {

namespace {

struct Barber {
    Field& field;
    const Figure& figure;

    void part(FieldBlend blend, float round, Loft loft, float grow = 0) {
        float h = k_head_height;
        field.parts.push_back({layer_hair, blend, round * h, grow * h, std::move(loft)});
    }
    void add(float round, Loft loft, float grow = 0) { part(FieldBlend::add, round, std::move(loft), grow); }
    void carve(float round, Loft loft) { part(FieldBlend::carve, round, std::move(loft)); }
    // What lies beyond the plane goes.
    void crop(Vec3 normal, Vec3 point, float round = .03f) {
        normal = normalize_or(normal, {0, -1, 0});
        field.parts.push_back({layer_hair,
                               FieldBlend::keep,
                               round * k_head_height,
                               0,
                               {},
                               true,
                               normal,
                               dot(normal, from_face(point))});
    }

    void add_cap(float thick) {
        float h = k_head_height;
        add(0, trimmed(skull_loft(figure), .24f * h, .68f * h, .10f * h, .31f * h), thick);
    }
    // The hairline of short hair: across the forehead at `top`, down the temples, over the ears and up from
    // the nape.
    void trim(float top, float square) {
        float low = .20f, middle = .55f, high = top - middle;
        // The axis runs ahead; the rings' front is down.
        BodyRing opening[] = {{.115f, 0, 0, .30f, middle - low, high * .90f, square},
                              {.200f, 0, 0, .31f, middle - low, high * .96f, square},
                              {.330f, 0, 0, .31f, middle - low, high, square},
                              {.600f, 0, 0, .33f, middle - low, high * 1.1f, square}};
        for (BodyRing& r : opening) {
            float h = k_head_height;
            r.t *= h, r.width *= h, r.ahead *= h, r.behind *= h;
        }
        carve(.11f,
              make_loft(from_face({0, middle, 0}), {1, 0, 0}, {0, 0, 1}, opening, .03f * k_head_height, 0));
        carve(.03f, face_ellipsoid({.35f, .27f, .13f}, {.16f, .22f, .19f}));
        carve(.02f, face_ellipsoid({.36f, .40f, -.03f}, {.07f, .13f, .09f}));
        crop({0, -1, .50f}, {0, .19f, -.45f});
    }
    // Hair that falls to `low`, with a parting over the middle or a fringe.
    void add_fall(float low, float wide, bool fringe) {
        bool longer = low < -.1f;
        BodyRing fall[] = {
            {low, 0, longer ? -.21f : -.10f, wide * .84f, longer ? .12f : .20f, longer ? .15f : .27f, .2f},
            {lerp(low, .28f, .35f), 0, longer ? -.18f : -.10f, wide * .94f, longer ? .20f : .27f,
             longer ? .24f : .35f, .2f},
            {.28f, 0, -.08f, wide, .32f, .42f, .15f},
            {.48f, 0, -.05f, .385f, .385f, .455f, .1f},
            {.66f, 0, -.03f, .366f, .420f, .470f, .05f}};
        add(0, head_loft(fall, longer ? .10f : .06f, .365f));
        // The face looks out of an opening.
        if (fringe) {
            carve(.05f, face_ellipsoid({0, .30f, .42f}, {.275f, .355f, .40f}));
        } else {
            carve(.06f, face_ellipsoid({0, .38f, .44f}, {.262f, .47f, .37f}));
            carve(.05f, make_capsule(from_face({0, .95f, .35f}), from_face({0, 1.02f, -.05f}),
                                     .020f * k_head_height, .012f * k_head_height));
        }
        carve(.05f, face_ellipsoid({0, -.02f, .30f}, {.262f, .50f, .36f}));
        if (longer) carve(.08f, face_ellipsoid({0, -.35f, .18f}, {.23f, .40f, .30f}));
    }
    void add_curls(float size) {
        add_cap(.07f * size);
        RandomKey key{figure.seed, 2, 0, Purpose::look};
        // Curls over the crown and the sides by the golden angle.
        constexpr int k_curls = 30;
        float x = 1, z = 0;
        for (int i = 0; i < k_curls; ++i) {
            float nx = x * -.7373688f - z * .6754903f;
            z = x * .6754903f + z * -.7373688f;
            x = nx;
            if (x < 0) continue;  // its mirror image stands there
            float up = 1 - 1.25f * (float(i) + .5f) / k_curls, out = std::sqrt(1 - up * up);
            Vec3 place{x * out * .37f * size, .66f + up * .36f * size, z * out * .44f * size - .04f};
            float r = random_between(key, .105f, .14f, uint32_t(i)) * size;
            add(.045f, face_ellipsoid(place, {r, r * .95f, r}));
        }
    }
};

}  // namespace

void add_hair(Field& field, const Figure& figure) {
    Barber b{field, figure};
    bool man = !figure.woman && figure.grown > .8f;
    float recede = man ? smoothstep(30, 75, figure.age) : 0;
    float line = .815f + .06f * recede, square = man ? .35f : .1f;
    switch (figure.hair) {
        case Hair::cropped:
            b.add_cap(.020f);
            b.trim(line, square);
            break;
        case Hair::parted:
            b.add_cap(.030f);
            b.add(.12f, face_ellipsoid({.09f, .915f, .12f}, {.20f, .085f, .25f}));
            b.add(.10f, face_ellipsoid({.04f, .885f, .285f}, {.17f, .075f, .10f}));
            b.trim(line, square);
            break;
        case Hair::full:
            b.add_cap(.045f);
            b.add(.10f, face_ellipsoid({.10f, .93f, .18f}, {.20f, .110f, .22f}));
            b.add(.10f, face_ellipsoid({.12f, .90f, -.12f}, {.22f, .130f, .26f}));
            b.add(.10f, face_ellipsoid({.27f, .66f, -.04f}, {.10f, .20f, .26f}));
            b.trim(line - .02f, square);
            break;
        case Hair::curly:
            b.add_curls(figure.woman ? 1.12f : .98f);
            b.trim(line - .03f, .1f);
            break;
        case Hair::bald:
            b.add_cap(.018f);
            b.trim(.90f, .2f);
            b.crop({0, 1, .30f}, {0, .70f, -.15f}, .04f);
            break;
        case Hair::bob:
            b.add_fall(.04f, .385f, false);
            break;
        case Hair::bangs:
            b.add_fall(-.06f, .375f, true);
            break;
        case Hair::shoulder_length:
            b.add_fall(-.26f, .375f, false);
            break;
        case Hair::long_hair:
            b.add_fall(-.62f, .365f, false);
            break;
        case Hair::bun:
            b.add_cap(.036f);
            b.add(.05f, face_ellipsoid({0, .80f, -.50f}, {.15f, .14f, .13f}));
            b.trim(line - .01f, .05f);
            break;
        case Hair::ponytail: {
            b.add_cap(.034f);
            b.trim(line - .01f, .05f);
            float h = k_head_height;
            BodyRing tail[] = {{0, 0, 0, .070f * h, .06f * h, .06f * h},
                               {.16f * h, 0, -.085f * h, .095f * h, .085f * h, .085f * h},
                               {.42f * h, 0, -.085f * h, .100f * h, .080f * h, .085f * h},
                               {.70f * h, 0, -.030f * h, .060f * h, .050f * h, .055f * h}};
            b.add(.05f,
                  make_loft(from_face({0, .76f, -.50f}), {-1, 0, 0}, {0, -1, 0}, tail, .06f * h, .12f * h));
            break;
        }
    }
    // A hat presses down what is under it; its rim rises a little ahead.
    if (figure.hat != Hat::none) b.crop({0, 1, -.12f}, {0, .64f, 0}, .05f);
}

void add_beard(Field& field, const Figure& figure) {
    Barber b{field, figure};
    if (figure.beard == Beard::none) return;
    b.add(.03f, face_ellipsoid({.045f, k_mouth_y + .068f, .352f}, {.085f * figure.face.mouth, .028f, .054f}));
    if (figure.beard == Beard::moustache) return;
    float h = k_head_height, jaw = figure.face.jaw;
    BodyRing ring[] = {{-.01f, 0, .25f, .12f * jaw, .14f, .10f, .1f},
                       {.10f, 0, .20f, .208f * jaw, .205f, .20f, .15f},
                       {.20f, 0, .13f, .258f * jaw, .262f, .20f, .15f},
                       {.25f, 0, .10f, .272f * jaw, .290f, .18f, .1f}};
    b.add(.04f, head_loft(ring, .04f, .02f));
    float chin = figure.face.chin;
    b.add(.04f, face_ellipsoid({0, .060f, .330f}, Vec3{.125f, .085f, .085f} * chin));
    b.add(.08f, make_capsule(from_face({.255f * jaw, .22f, .10f}), from_face({.292f, .48f, .06f}), .035f * h,
                             .022f * h));
    b.carve(.03f, face_ellipsoid({.135f * jaw, .33f, .34f}, {.13f, .125f, .16f}));
    b.carve(.02f, face_ellipsoid({0, k_mouth_y - .006f, .42f}, {.095f * figure.face.mouth, .022f, .10f}));
}

}  // namespace flaneur
