#include <algorithm>

#include "assets/people/clothes.h"

namespace flaneur {

Loft foot_loft(const Figure& figure) {
    float g = lerp(1, .86f, figure.feminine);
    // The axis runs ahead; the rings' front is up.
    BodyRing rings[] = {{-.030f, 0, .012f, .0205f * g, .034f, .020f, .2f},
                        {-.005f, 0, .012f, .0225f * g, .040f, .020f, .2f},
                        {.020f, 0, .012f, .0225f * g, .034f, .020f, .2f},
                        {.045f, -.001f, .012f, .0255f * g, .024f, .020f, .2f},
                        {.075f, -.002f, .012f, .0300f * g, .017f, .020f, .2f},
                        {.100f, -.001f, .011f, .0275f * g, .013f, .018f, .2f},
                        {.113f, .001f, .010f, .0210f * g, .010f, .016f, .1f}};
    return make_loft({.052f, 0, 0}, {-1, 0, 0}, {0, 0, 1}, rings, .009f, .011f);
}

Loft skirt_loft(const Figure& f) {
    float hem = f.bottom == Bottom::long_skirt ? .105f : f.bottom == Bottom::dress ? .275f : .292f;
    float flare = f.bottom == Bottom::long_skirt ? 1.10f : f.bottom == Bottom::dress ? 1.14f : 1;
    float g = lerp(.96f, 1, f.feminine), stout = 1 + .10f * std::max(f.build, 0.0f);
    BodyRing rings[] = {{hem, 0, .002f, .112f * flare, .085f * flare, .092f * flare, .1f},
                        {lerp(hem, .5f, .5f), 0, 0, .103f * lerp(1, flare, .6f), .075f, .086f, .1f},
                        {.480f, 0, 0, .098f, .062f, .078f, .15f},
                        {.530f, 0, 0, .096f, .060f, .072f, .15f},
                        {.570f, 0, 0, .088f, .056f, .058f, .15f},
                        {.605f, 0, .002f, .076f, .051f, .047f, .15f}};
    for (BodyRing& r : rings) {
        float hips = r.t < .55f ? 1 : stout;
        r.width *= g * hips, r.ahead *= g * (r.t < .5f ? 1 : stout), r.behind *= g;
    }
    return make_loft({}, {1, 0, 0}, {0, 1, 0}, rings, 0, 0);
}

namespace {

// Where trousers end under what is worn above.
float waist(const Figure& figure) { return std::min(top_hem(figure) + .010f, .600f); }

void add_trousers(Tailor t) {
    const Figure& f = t.figure;
    if (f.robe_hem == 0) t.add(trimmed(torso_loft(f), .470f, waist(f), .03f, 0), .003f);
    bool slim = f.bottom == Bottom::slim, wide = f.bottom == Bottom::wide;
    float ease = slim ? .15f : lerp(1, .8f, f.feminine);
    Loft leg = leg_loft(f);
    for (BodyRing& ring : leg.table) {
        float shin = smoothstep(.33f, .10f, ring.t) * ease, cuff = smoothstep(.12f, .03f, ring.t) * ease;
        float flare = wide ? smoothstep(.46f, .10f, ring.t) : 0;
        ring.width += .006f * shin + .002f * cuff + .010f * flare;
        ring.ahead += .006f * shin + .006f * cuff + .013f * flare;
        ring.behind += .001f * shin + .004f * cuff + .008f * flare;
        if (wide) ring.side += .004f * flare;
        // The heel of a shoe stays inside.
        ring.behind = std::max(ring.behind, .0345f * smoothstep(.090f, .060f, ring.t));
        // Folds above the shoe and behind the knee.
        float low = ring.t < .075f ? (ring.t - .026f) / .0165f : 0, phase = low - float(int(low)) - .5f;
        float fold = slim ? 0 : .0022f * (.25f - phase * phase) * 4 * (low > 0 ? 1.0f : 0.0f);
        ring.ahead += fold, ring.width += fold * .6f, ring.behind += fold * .4f;
    }
    float hem = slim ? .040f : wide ? .018f : .026f;
    // Under a coat there is nothing to show.
    float top = f.robe_hem > 0 ? f.robe_hem + .05f : .508f;
    t.add(trimmed(leg, hem, top, 0, .02f), slim ? .0035f : .005f, .018f);
}

void add_shorts(Tailor t) {
    const Figure& f = t.figure;
    t.add(trimmed(torso_loft(f), .470f, waist(f), .03f, 0), .003f);
    float hem = lerp(.345f, .385f, f.feminine * f.grown);
    Loft leg = leg_loft(f);
    for (BodyRing& ring : leg.table) {
        float free = .007f * smoothstep(.47f, hem, ring.t);
        ring.width += free, ring.ahead += free + .002f, ring.behind += free;
    }
    t.add(trimmed(leg, hem, .505f, 0, .02f), .006f, .018f);
}

void add_skirt(Tailor t) {
    const Figure& f = t.figure;
    float top = f.over == Over::coat ? .580f : std::min(top_hem(f) + .012f, .605f);
    Loft skirt = skirt_loft(f);
    constexpr float k_grow = .006f;
    t.add(trimmed(skirt, skirt.begin + k_grow, top, 0, 0), k_grow);
}

void add_shoes(Tailor t) {
    const Figure& f = t.figure;
    Loft foot = foot_loft(f);
    auto ground = [&] { t.crop({0, -1, 0}, {}, .004f); };
    switch (f.shoes) {
        case Shoes::sneakers:
            for (BodyRing& r : foot.table) r.ahead += .0035f;
            t.add(std::move(foot), .0015f);
            // A padded collar and a thick sole.
            t.add(make_ellipsoid({.052f, .046f, -.006f}, {.0255f, .010f, .027f}), 0, .012f);
            {
                float g = lerp(1, .88f, f.feminine);
                BodyRing sole[] = {{-.030f, 0, 0, .0215f * g, .0115f, .02f, .4f},
                                   {.010f, 0, 0, .0240f * g, .0115f, .02f, .4f},
                                   {.045f, -.001f, 0, .0275f * g, .0110f, .02f, .4f},
                                   {.078f, -.002f, 0, .0318f * g, .0115f, .02f, .4f},
                                   {.112f, .000f, 0, .0235f * g, .0130f, .02f, .2f}};
                t.add(make_loft({.052f, 0, 0}, {-1, 0, 0}, {0, 0, 1}, sole, .008f, .012f), 0, .002f);
            }
            break;
        case Shoes::leather:
            for (BodyRing& r : foot.table) r.width *= .96f;
            t.add(std::move(foot), 0);
            break;
        case Shoes::boots: {
            t.add(std::move(foot), .002f);
            Loft shaft = leg_loft(f);
            for (BodyRing& r : shaft.table) {
                float ankle = smoothstep(.09f, .045f, r.t);
                r.width += .003f + .002f * ankle, r.ahead += .003f, r.behind += .003f + .002f * ankle;
            }
            float high = f.bare_legs() || f.bottom == Bottom::slim ? .165f : .110f;
            t.add(trimmed(shaft, .030f, high, .01f, 0), .003f, .018f);
            break;
        }
        case Shoes::pumps:
            for (BodyRing& r : foot.table) r.width *= .97f;
            t.add(std::move(foot), .0012f);
            // The instep is bare.
            t.carve(make_ellipsoid({.052f, .052f, .026f}, {.030f, .036f, .046f}), .003f);
            break;
    }
    ground();
}

}  // namespace

void add_lower_clothes(Field& field, const Figure& figure) {
    Tailor bottom{field, figure, layer_bottom};
    if (figure.has_skirt())
        add_skirt(bottom);
    else if (figure.bottom == Bottom::shorts)
        add_shorts(bottom);
    else
        add_trousers(bottom);
    add_shoes({field, figure, layer_shoes});
}

}  // namespace flaneur
