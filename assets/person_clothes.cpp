#include "assets/person_parts.h"

namespace flaneur {

namespace {

struct Tailor {
    Field& field;
    const Figure& figure;
    Layer layer;

    void add(Loft loft, float grow, float round = 0) {
        field.parts.push_back({layer, Blend::add, round, grow, std::move(loft)});
    }
    void carve(Loft loft, float round = 0) {
        field.parts.push_back({layer, Blend::carve, round, 0, std::move(loft)});
    }
};

// Torso, shoulders and, to `sleeve` along the arm, sleeves. `hem` is the lower end.
void add_upper(Tailor t, float grow, float hem, float sleeve, float loose) {
    t.add(trimmed(torso_loft(t.figure), hem, .825f, 0, .016f), grow);
    if (hem < .51f) t.add(trimmed(leg_loft(t.figure), hem, .520f, 0, .03f), grow, .018f);  // the seat
    t.add(shoulder_loft(t.figure), grow, .040f);
    if (t.figure.woman) {
        Vec3 radii = Vec3{.040f, .036f, .034f} * (1 + .08f * t.figure.build);
        t.add(make_ellipsoid({.036f, .718f, .032f}, radii), grow, .030f);
    } else {
        t.add(make_ellipsoid({.040f, .742f, .030f}, {.048f, .038f, .022f}), grow, .040f);
    }
    if (sleeve <= 0) return;
    Loft arm = arm_loft(t.figure);
    for (Ring& ring : arm.table) {  // wider or tighter towards the cuff
        float free = loose * smoothstep(.02f, sleeve, ring.t);
        ring.width += free, ring.ahead += free, ring.behind += free;
    }
    t.add(trimmed(arm, -.005f, sleeve, .028f, 0), grow, .022f);
}

void add_trousers(Tailor t) {
    const Figure& f = t.figure;
    t.add(trimmed(torso_loft(f), .470f, .600f, .03f, 0), .003f);
    float ease = f.woman ? .6f : 1;
    Loft leg = leg_loft(f);
    for (Ring& ring : leg.table) {
        float shin = smoothstep(.33f, .10f, ring.t) * ease, cuff = smoothstep(.12f, .03f, ring.t) * ease;
        ring.width += .006f * shin + .002f * cuff;
        ring.ahead += .006f * shin + .006f * cuff;
        ring.behind += .001f * shin + .004f * cuff;
    }
    t.add(trimmed(leg, .026f, .520f, 0, .03f), .005f, .018f);
}

void add_skirt(Tailor t, float hem, float waist) {
    float g = t.figure.woman ? 1 : .96f;
    Ring rings[] = {{hem, 0, .002f, .118f * g, .085f, .092f, .1f},
                    {lerp(hem, .5f, .5f), 0, 0, .110f * g, .075f, .086f, .1f},
                    {.480f, 0, 0, .103f * g, .062f, .078f, .15f},
                    {.530f, 0, 0, .100f * g, .060f, .072f, .15f},
                    {.570f, 0, 0, .088f * g, .056f, .058f, .15f},
                    {waist, 0, .002f, .076f * g, .051f, .047f, .15f}};
    t.add(make_loft({}, {1, 0, 0}, {0, 1, 0}, rings, 0, 0), .008f);
}

void add_shoes(Tailor t) {
    float g = t.figure.woman ? .88f : 1;
    // The axis runs ahead; the rings' front is up.
    Ring rings[] = {{-.030f, 0, .012f, .0205f * g, .034f, .020f, .2f},
                    {-.005f, 0, .012f, .0225f * g, .040f, .020f, .2f},
                    {.020f, 0, .012f, .0225f * g, .034f, .020f, .2f},
                    {.045f, -.001f, .012f, .0255f * g, .024f, .020f, .2f},
                    {.075f, -.002f, .012f, .0300f * g, .017f, .020f, .2f},
                    {.100f, -.001f, .011f, .0275f * g, .013f, .018f, .2f},
                    {.113f, .001f, .010f, .0210f * g, .010f, .016f, .1f}};
    t.add(make_loft({.052f, 0, 0}, {-1, 0, 0}, {0, 0, 1}, rings, .009f, .011f), 0);
    t.field.parts.push_back({layer_shoes, Blend::keep, .004f, 0, {}, true, {0, -1, 0}, 0});
}

// The opening of a jacket: a wedge down the front, from the lapels to `low`.
void open_front(Tailor t, float low, float slit) {
    Ring rings[] = {{low, 0, 0, slit, .12f, .001f},
                    {.600f, 0, 0, slit, .12f, .001f},
                    {.660f, 0, 0, slit + .004f, .12f, .001f},
                    {.780f, 0, 0, .026f, .12f, .001f},
                    {.900f, 0, 0, .046f, .12f, .001f}};
    t.carve(make_loft({0, 0, .012f}, {1, 0, 0}, {0, 1, 0}, rings, 0, 0), .003f);
}

void add_collar(Tailor t, float grow, float top_y) {
    t.add(trimmed(neck_loft(t.figure), .800f, top_y, 0, 0), grow, .012f);
}

}  // namespace

void add_clothes(Field& field, const Figure& figure) {
    Tailor inner_{field, figure, layer_inner}, top_{field, figure, layer_top},
        bottom_{field, figure, layer_bottom};
    float hem = figure.skirt ? .590f : .500f;
    switch (figure.over) {
        case Over::none:
        case Over::vest:
            if (figure.top == Top::t_shirt) {
                add_upper(top_, .007f, hem, .115f, .006f);
            } else {
                add_upper(top_, .008f, hem - .005f, .322f, -.003f);
                add_collar(top_, .006f, .838f);
            }
            break;
        case Over::jacket:
        case Over::open_jacket:
            add_upper(inner_, .003f, .57f, 0, 0);
            add_collar(inner_, .004f, .843f);
            add_upper(top_, .010f, figure.skirt ? .550f : .495f, .325f, -.003f);
            add_collar(top_, .010f, .848f);
            open_front(top_, figure.skirt ? .545f : .490f, .003f);
            break;
        case Over::coat:
            add_upper(inner_, .003f, .57f, 0, 0);
            add_collar(inner_, .005f, .852f);
            add_upper(top_, .012f, .560f, .325f, -.003f);
            add_collar(top_, .013f, .850f);
            {
                Ring skirt[] = {{.310f, 0, .002f, .122f, .088f, .092f, .15f},
                                {.400f, 0, .001f, .116f, .078f, .088f, .15f},
                                {.480f, 0, 0, .112f, .071f, .084f, .15f},
                                {.530f, 0, 0, .108f, .068f, .078f, .15f},
                                {.580f, 0, 0, .098f, .066f, .066f, .15f},
                                {.610f, 0, 0, .090f, .062f, .060f, .15f}};
                float g = figure.woman ? .96f : 1;
                for (Ring& r : skirt) r.width *= g, r.ahead *= g, r.behind *= g;
                top_.add(make_loft({}, {1, 0, 0}, {0, 1, 0}, skirt, 0, .02f), 0, .02f);
            }
            open_front(top_, .640f, .001f);
            break;
    }
    if (figure.skirt)
        add_skirt(bottom_, .300f, .605f);
    else if (!bare_legs(figure))
        add_trousers(bottom_);
    add_shoes({field, figure, layer_shoes});
}

}  // namespace flaneur
