#include "assets/people/parts.h"

namespace flaneur {

// Half breadths and depths follow ANSUR II and NASA-STD-3000 means, smoothed.
Loft torso_loft(const Figure& figure) {
    static constexpr BodyRing man[] = {
        {.470f, 0, -.004f, .076f, .050f, .056f, .1f}, {.500f, 0, -.003f, .087f, .055f, .066f, .2f},
        {.530f, 0, -.002f, .088f, .056f, .063f, .2f}, {.560f, 0, 0, .084f, .055f, .054f, .2f},
        {.600f, 0, .002f, .079f, .054f, .048f, .2f},  {.640f, 0, .002f, .079f, .054f, .049f, .2f},
        {.690f, 0, 0, .084f, .057f, .054f, .25f},     {.730f, 0, -.002f, .087f, .060f, .059f, .25f},
        {.765f, 0, -.006f, .084f, .054f, .058f, .2f}, {.795f, 0, -.010f, .068f, .040f, .048f, .1f},
        {.825f, 0, -.011f, .040f, .028f, .036f, 0}};
    static constexpr BodyRing woman[] = {
        {.470f, 0, -.004f, .081f, .050f, .060f, .1f}, {.500f, 0, -.003f, .094f, .056f, .072f, .2f},
        {.530f, 0, -.002f, .092f, .056f, .067f, .2f}, {.560f, 0, 0, .085f, .053f, .056f, .2f},
        {.600f, 0, .002f, .072f, .048f, .045f, .15f}, {.635f, 0, .002f, .068f, .046f, .043f, .15f},
        {.690f, 0, 0, .073f, .050f, .049f, .15f},     {.730f, 0, -.003f, .075f, .051f, .053f, .15f},
        {.765f, 0, -.007f, .072f, .045f, .052f, .1f}, {.795f, 0, -.010f, .060f, .035f, .043f, .1f},
        {.825f, 0, -.011f, .036f, .026f, .033f, 0}};
    std::array<BodyRing, 11> rings;
    float child = 1 - figure.grown, build = figure.build, stout = std::max(build, 0.0f);
    for (size_t i = 0; i < rings.size(); ++i) {
        rings[i] = mix_rings(man[i], woman[i], figure.feminine);
        // Weight shows at the belly first; a child's is round, its chest narrow.
        float t = rings[i].t, belly = smoothstep(.49f, .60f, t) * smoothstep(.76f, .66f, t);
        float chest = smoothstep(.66f, .75f, t);
        rings[i].width *= 1 + .06f * build + .09f * stout * belly - .06f * child * chest;
        rings[i].ahead *= 1 + .07f * build + .36f * stout * belly + .12f * child * belly;
        rings[i].behind *= 1 + .06f * build + .08f * stout * belly - .08f * child;
    }
    return make_loft({}, {1, 0, 0}, {0, 1, 0}, rings, .045f, .018f);
}

// From one shoulder to the middle: deltoid, clavicle and trapezius.
Loft shoulder_loft(const Figure& figure) {
    Vec3 joint = figure_shoulder(figure);
    float x = joint.x, g = lerp(.96f, .85f, figure.feminine) * (1 + .05f * figure.build);
    g *= 1 - .06f * (1 - figure.grown);
    BodyRing rings[] = {{0, -.015f, 0, .024f * g, .029f * g, .032f * g},
                        {.025f, -.008f, 0, .024f * g, .030f * g, .037f * g},
                        {x * .60f, .006f, -.002f, .023f, .027f, .039f},
                        {x, .020f, -.002f, .024f, .026f, .040f}};
    // The axis runs inward; side is up.
    return make_loft(joint, {0, 1, 0}, {-1, 0, 0}, rings, .022f * g, .03f);
}

Loft arm_loft(const Figure& figure) {
    float g = lerp(.92f, .79f, figure.feminine) * (1 + .09f * figure.build) * lerp(.90f, 1, figure.grown);
    static constexpr BodyRing base[] = {
        {-.005f, .012f, 0, .0245f, .0310f, .0320f},    {.040f, .006f, 0, .0280f, .0325f, .0320f},
        {.090f, .001f, .001f, .0270f, .0300f, .0285f}, {.140f, 0, .001f, .0250f, .0280f, .0270f},
        {.183f, 0, -.001f, .0225f, .0235f, .0255f},    {.215f, 0, .001f, .0240f, .0265f, .0250f},
        {.250f, 0, .001f, .0215f, .0245f, .0230f},     {.290f, 0, 0, .0165f, .0205f, .0195f},
        {.318f, 0, 0, .0130f, .0175f, .0170f},         {.332f, 0, 0, .0120f, .0175f, .0170f}};
    std::array<BodyRing, 10> rings;
    for (size_t i = 0; i < rings.size(); ++i) {
        rings[i] = base[i];
        rings[i].width *= g, rings[i].ahead *= g, rings[i].behind *= g;
    }
    Vec3 axis = bind_arm_direction();
    return make_loft(figure_shoulder(figure), {axis.y, -axis.x, 0}, axis, rings, .028f, .01f);
}

Loft leg_loft(const Figure& figure) {
    float g = (1 + .08f * figure.build) * lerp(.94f, 1, figure.grown);
    float knee = lerp(1, .95f, figure.feminine), thigh = lerp(1, 1.02f, figure.feminine);
    BodyRing rings[] = {{.030f, 0, -.004f, .0200f * knee, .0220f, .0240f},
                        {.050f, 0, -.004f, .0190f * knee, .0205f, .0230f},
                        {.100f, .001f, -.005f, .0225f * knee, .0215f, .0280f},
                        {.160f, .002f, -.006f, .0290f * knee, .0255f, .0370f},
                        {.205f, .002f, -.006f, .0320f * knee, .0280f, .0410f},
                        {.250f, .001f, -.004f, .0300f * knee, .0290f, .0350f},
                        {.285f, 0, 0, .0310f * knee, .0330f, .0310f},
                        {.320f, .001f, 0, .0345f * knee, .0370f, .0350f},
                        {.380f, .002f, 0, .0420f * thigh, .0440f, .0420f},
                        {.430f, .002f, 0, .0465f * thigh, .0480f, .0480f},
                        {.475f, -.002f, -.002f, .0450f * thigh, .0490f, .0560f},
                        {.520f, -.008f, -.004f, .0410f * thigh, .0480f, .0570f}};
    for (BodyRing& r : rings) r.width *= g, r.ahead *= g, r.behind *= g;
    return make_loft({.052f, 0, 0}, {1, 0, 0}, {0, 1, 0}, rings, .01f, .03f);
}

Loft neck_loft(const Figure& figure) {
    float g = lerp(.95f, .83f, figure.feminine) * lerp(.86f, 1, figure.grown) * (1 + .07f * figure.build);
    BodyRing rings[] = {{.790f, 0, -.014f, .046f * g, .030f * g, .036f * g},
                        {.825f, 0, -.012f, .037f * g, .031f * g, .034f * g},
                        {.850f, 0, -.008f, .0325f * g, .033f * g, .033f * g},
                        {.880f, 0, -.002f, .0320f * g, .035f * g, .033f * g},
                        {.920f, 0, .002f, .0320f * g, .030f * g, .036f * g}};
    return make_loft({}, {1, 0, 0}, {0, 1, 0}, rings, .01f, .03f);
}

namespace {

void add_hand(Field& field, const Figure& figure) {
    Vec3 axis = bind_arm_direction(), palm{axis.y, -axis.x, 0}, ahead{0, 0, 1};
    Vec3 wrist = figure_shoulder(figure) + axis * .327f;
    float g = lerp(1, .92f, figure.feminine) * lerp(.95f, 1, figure.grown);
    auto place = [&](float along, float inward, float z) {
        return wrist + (axis * along + palm * inward + ahead * z) * g;
    };
    static constexpr BodyRing rings[] = {{-.006f, 0, 0, .0115f, .0165f, .0160f},
                                         {.010f, 0, .001f, .0110f, .0185f, .0175f, .2f},
                                         {.030f, .001f, .001f, .0100f, .0225f, .0215f, .3f},
                                         {.051f, .001f, 0, .0072f, .0232f, .0228f, .3f}};
    std::array<BodyRing, 4> scaled;
    for (size_t i = 0; i < scaled.size(); ++i) {
        const BodyRing& r = rings[i];
        scaled[i] = {r.t * g, r.side * g, r.front * g, r.width * g, r.ahead * g, r.behind * g, r.square};
    }
    auto add = [&](float round, Loft loft) {
        field.parts.push_back({layer_skin, FieldBlend::add, round, 0, std::move(loft)});
    };
    add(.008f, make_loft(wrist, palm, axis, scaled, .006f, .012f));
    // Knuckle, middle joint and tip of each finger; they curl inward, more so towards the little one.
    struct Finger {
        float z, knuckle, length, curl, spread;
    };
    static constexpr Finger fingers[] = {{.0190f, .050f, .045f, .18f, .10f},
                                         {.0062f, .053f, .050f, .24f, .02f},
                                         {-.0066f, .051f, .047f, .30f, -.06f},
                                         {-.0185f, .046f, .038f, .34f, -.16f}};
    for (const Finger& f : fingers) {
        Vec3 a = place(f.knuckle - .006f, .0005f, f.z);
        Vec3 b = a + (axis + palm * f.curl + ahead * f.spread) * (f.length * .55f * g);
        Vec3 c = b + (axis + palm * (2.4f * f.curl) + ahead * (f.spread * .5f)) * (f.length * .45f * g);
        add(.003f, make_capsule(a, b, .0058f * g, .0054f * g));
        add(.001f, make_capsule(b, c, .0054f * g, .0046f * g));
    }
    Vec3 a = place(.010f, .004f, .012f), b = place(.030f, .013f, .0275f), c = place(.052f, .017f, .0300f);
    add(.008f, make_capsule(a, b, .0095f * g, .0070f * g));
    add(.003f, make_capsule(b, c, .0068f * g, .0052f * g));
}

}  // namespace

void add_body(Field& field, const Figure& figure) {
    auto add = [&](float round, Loft loft) {
        field.parts.push_back({layer_skin, FieldBlend::add, round, 0, std::move(loft)});
    };
    // Only what clothes leave bare, with some way under their hems.
    add(0, trimmed(arm_loft(figure), figure.bare_arms() ? .075f : .290f, .332f, .01f, .01f));
    add_hand(field, figure);
    float knee = figure.robe_hem > 0 ? figure.robe_hem + .05f : .420f;
    if (figure.bare_legs()) add(0, trimmed(leg_loft(figure), .030f, knee, .01f, .01f));
    if (figure.shoes == Shoes::pumps) {
        add(.006f, trimmed(foot_loft(figure), -.020f, .100f, .008f, .010f));
        field.parts.push_back({layer_skin, FieldBlend::keep, .004f, 0, {}, true, {0, -1, 0}, -.004f});
    }
    add(0, neck_loft(figure));
    // What a neckline leaves bare.
    add(.012f, trimmed(torso_loft(figure), .735f, .825f, 0, .016f));
    add(.040f, shoulder_loft(figure));
}

}  // namespace flaneur
