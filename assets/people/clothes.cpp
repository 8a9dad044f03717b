#include "assets/people/clothes.h"

#include <algorithm>

namespace flaneur {

namespace {

// Torso, shoulders and, to `sleeve` along the arm, sleeves. `hem` is the lower end.
struct Cut {
    float grow;
    float hem;
    float sleeve = 0, loose = 0;  // loose: how much wider the cuff is than at the shoulder
    float quilt = 0;              // depth of quilting
};

void add_chest(Tailor t, float grow) {
    const Figure& f = t.figure;
    t.add(shoulder_loft(f), grow, .040f);
    float bust = f.feminine * f.grown, size = 1 + .08f * f.build;
    if (bust > .3f) {
        t.add(
            make_ellipsoid({.036f, .718f, .030f}, Vec3{.040f, .036f, .034f} * (size * (.75f + .25f * bust))),
            grow, .032f);
    } else if (f.grown > .5f) {
        t.add(make_ellipsoid({.040f, .742f, .028f}, {.048f, .038f, .022f}), grow, .040f);
    }
}

void add_upper(Tailor t, const Cut& cut) {
    const Figure& f = t.figure;
    Loft torso = trimmed(torso_loft(f), cut.hem + cut.grow, .825f, 0, .016f);
    float long_hem = .004f * smoothstep(.56f, .50f, cut.hem);
    for (BodyRing& ring : torso.table) {
        // Cloth hangs from the chest to the hem; a quilt bulges between its seams.
        float hang = long_hem * smoothstep(.60f, .52f, ring.t);
        float along = (ring.t - cut.hem) / .042f, wave = along - float(int(along)) - .5f;
        float bulge = cut.quilt * (.25f - wave * wave) * 4 * smoothstep(.81f, .77f, ring.t);
        ring.width += bulge + hang, ring.ahead += bulge + hang * .5f, ring.behind += bulge + hang * .5f;
        if (cut.hem < .53f) {
            // Straight down over the seat.
            float seat = smoothstep(.525f, .49f, ring.t) * .004f;
            ring.width += seat, ring.ahead += seat, ring.behind += seat * .6f;
        }
    }
    t.add(std::move(torso), cut.grow);
    // What hangs over a skirt goes round it down to the hem.
    if (t.layer == layer_top && f.has_skirt() && cut.hem < .57f)
        t.add(trimmed(skirt_loft(f), cut.hem + cut.grow, .580f, 0, .030f), cut.grow, .004f);
    add_chest(t, cut.grow);
    if (cut.sleeve <= 0) return;
    Loft arm = arm_loft(f);
    for (BodyRing& ring : arm.table) {
        float free = cut.loose * smoothstep(.02f, cut.sleeve, ring.t);
        // A long sleeve gathers above the cuff.
        if (cut.sleeve > .3f) {
            float end = smoothstep(.27f, .300f, ring.t) * smoothstep(.322f, .312f, ring.t);
            free += .0022f * end;
        }
        ring.width += free, ring.ahead += free, ring.behind += free;
    }
    t.add(trimmed(arm, -.005f, cut.sleeve, .028f, 0), cut.grow, .022f);
}

// Up to `top_y` in front, a little higher behind.
void add_neckband(Tailor t, float grow, float top_y) {
    t.add(trimmed(neck_loft(t.figure), .795f, top_y + .02f, 0, 0), grow, .010f);
    t.crop({0, 1, .35f}, {0, top_y, .020f}, .003f);
}

// A neckline below the throat: wide and round, or to a point.
void add_neckline(Tailor t, float depth, bool pointed) {
    float wide = lerp(.046f, .042f, t.figure.feminine);
    if (pointed) {
        BodyRing wedge[] = {{.835f - depth - .016f, 0, 0, .002f, .14f, .03f},
                            {.822f, 0, 0, wide * .72f, .14f, .03f},
                            {.880f, 0, 0, wide, .14f, .04f}};
        t.carve(make_loft({}, {1, 0, 0}, {0, 1, 0}, wedge, .004f, 0), .003f);
    } else {
        t.carve(make_ellipsoid({0, .842f, .020f}, {wide, depth + .012f, .090f}), .003f);
    }
    t.carve(make_ellipsoid({0, .845f, -.014f}, {wide * .98f, .024f, .044f}), .003f);
}

// A leaf that folds down from the neck, open in front.
void add_shirt_collar(Field& field, const Figure& figure, float grow) {
    Tailor t{field, figure, layer_collar};
    float g = lerp(.95f, .83f, figure.feminine) * lerp(.86f, 1, figure.grown) * (1 + .07f * figure.build);
    BodyRing leaf[] = {{.812f, 0, -.006f, .049f * g + grow, .044f * g + grow, .044f * g + grow},
                       {.826f, 0, -.008f, .043f * g + grow, .040f * g + grow, .040f * g + grow},
                       {.842f, 0, -.010f, .0375f * g + grow, .036f * g + grow, .037f * g + grow},
                       {.848f, 0, -.010f, .0355f * g + grow, .034f * g + grow, .036f * g + grow}};
    t.add(make_loft({}, {1, 0, 0}, {0, 1, 0}, leaf, 0, .003f), 0);
    // The points part below the throat.
    BodyRing notch[] = {{.780f, 0, 0, .030f, .12f, .001f},
                        {.815f, 0, 0, .013f, .12f, .001f},
                        {.838f, 0, 0, .003f, .12f, .001f},
                        {.860f, 0, 0, .008f, .12f, .001f}};
    t.carve(make_loft({0, 0, .004f}, {1, 0, 0}, {0, 1, 0}, notch, 0, 0), .002f);
    BodyRing hollow[] = {{.780f, 0, -.010f, .030f * g, .028f * g, .030f * g},
                         {.830f, 0, -.010f, .0335f * g, .033f * g, .034f * g},
                         {.870f, 0, -.009f, .0350f * g, .036f * g, .035f * g}};
    t.carve(make_loft({}, {1, 0, 0}, {0, 1, 0}, hollow, 0, 0), .002f);
}

void add_hood(Field& field, const Figure& figure) {
    Tailor t{field, figure, figure.over == Over::none ? layer_trim : layer_collar};
    // A roll round the neck that lies thick on the back, and comes to a point there.
    float w = lerp(.061f, .055f, figure.feminine);
    BodyRing roll[] = {{.806f, 0, -.014f, w, .042f, .052f},
                       {.824f, 0, -.016f, w - .003f, .040f, .056f},
                       {.842f, 0, -.018f, w - .010f, .030f, .054f},
                       {.852f, 0, -.020f, w - .016f, .022f, .046f}};
    t.add(make_loft({}, {1, 0, 0}, {0, 1, 0}, roll, .006f, .008f), 0);
    t.add(make_ellipsoid({0, .800f, -.062f}, {.052f, .044f, .024f}), 0, .022f);
    BodyRing hollow[] = {{.800f, 0, 0, .026f, .034f, .030f},
                         {.835f, 0, 0, .038f, .050f, .036f},
                         {.890f, 0, 0, .046f, .090f, .040f}};
    t.carve(make_loft({}, {1, 0, 0}, {0, 1, 0}, hollow, .004f, 0), .006f);
}

// The opening of a jacket: a wedge down the front, from the lapels to `low`.
void open_front(Tailor t, float low, float button, float slit) {
    float throat = .014f;
    BodyRing rings[] = {{low, 0, 0, slit, .14f, .001f},
                        {lerp(low, button, .6f), 0, 0, slit, .14f, .001f},
                        {button, 0, 0, slit + .003f, .14f, .001f},
                        {.785f, 0, 0, throat + .014f, .14f, .001f},
                        {.840f, 0, 0, throat + .020f, .14f, .001f},
                        {.900f, 0, 0, throat + .028f, .14f, .001f}};
    t.carve(make_loft({0, 0, .010f}, {1, 0, 0}, {0, 1, 0}, rings, 0, 0), .003f);
}

// Lapels lie along that opening and end in a collar.
void add_lapels(Field& field, const Figure& figure, float grow, float button, float wide) {
    Tailor t{field, figure, layer_trim};
    t.add(trimmed(torso_loft(figure), button - .02f, .825f, 0, .016f), grow);
    add_chest(t, grow);
    t.add(trimmed(neck_loft(figure), .800f, .846f, 0, 0), grow + .004f, .012f);
    // What is kept: a band beside the opening, broadest at the chest, and the collar behind.
    BodyRing band[] = {{button, 0, 0, .007f, .2f, .001f},       {.700f, 0, 0, .022f + wide * .5f, .2f, .001f},
                       {.758f, 0, 0, .034f + wide, .2f, .012f}, {.772f, 0, 0, .030f + wide * .4f, .2f, .06f},
                       {.800f, 0, 0, .048f, .2f, .09f},         {.850f, 0, 0, .056f, .2f, .09f}};
    t.keep(make_loft({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, band, .004f, 0), .003f);
    open_front(t, button - .05f, button, .002f);
    // Behind, only above the yoke.
    t.crop({0, -1, -1.4f}, {0, .770f, .0f}, .004f);
}

}  // namespace

float top_hem(const Figure& figure) {
    bool skirt = figure.has_skirt(), tucked = figure.top == Top::shirt && figure.seed % 2 == 0;
    switch (figure.over) {
        case Over::none:
            break;
        case Over::jacket:
        case Over::vest:
            return skirt ? .550f : .510f;
        case Over::open_jacket:
            return skirt ? .545f : .500f;
        case Over::coat:
            return figure.robe_hem;
    }
    return skirt || tucked ? .590f : .508f;
}

namespace {

void add_top(Field& field, const Figure& figure) {
    bool under = figure.over != Over::none, sleeves = !under || figure.over == Over::vest;
    Tailor t{field, figure, under ? layer_inner : layer_top};
    float hem = figure.over == Over::coat ? .56f : top_hem(figure) + (under ? .008f : 0);
    float thin = under ? .003f : .006f;
    switch (figure.top) {
        case Top::t_shirt:
            add_upper(t, {thin, hem, sleeves ? .112f : 0, .007f});
            add_neckline(t, figure.feminine > .6f ? .026f : .016f, figure.seed % 3 == 1);
            break;
        case Top::shirt:
            add_upper(t, {thin, hem, sleeves ? .318f : 0, -.001f});
            add_neckline(t, .022f, true);
            add_shirt_collar(field, figure, under ? .003f : .005f);
            break;
        case Top::sweater:
            add_upper(t, {thin + .002f, hem, sleeves ? .320f : 0, 0});
            if (figure.seed % 3 == 0)
                add_neckband(t, .0045f, .848f);
            else
                add_neckline(t, .013f, !under && figure.seed % 3 == 1);
            break;
        case Top::hoodie:
            add_upper(t, {thin + .003f, hem, sleeves ? .320f : 0, .001f});
            add_neckline(t, .013f, false);
            add_hood(field, figure);
            break;
    }
}

void add_coat(Tailor t) {
    const Figure& f = t.figure;
    float stout = 1 + .06f * f.build + (f.has_skirt() ? .09f : f.bottom == Bottom::wide ? .08f : 0);
    add_upper(t, {.012f, .585f, .325f, .001f});
    BodyRing skirt[] = {
        {f.robe_hem, 0, .002f, .113f, .088f, .092f, .15f}, {.400f, 0, .001f, .107f, .079f, .087f, .15f},
        {.480f, 0, 0, .103f, .071f, .083f, .15f},          {.530f, 0, 0, .101f, .068f, .078f, .15f},
        {.580f, 0, 0, .095f, .066f, .066f, .15f},          {.610f, 0, 0, .089f, .062f, .060f, .15f}};
    float g = lerp(1, .96f, f.feminine);
    for (BodyRing& r : skirt) {
        float belly = 1 + .34f * std::max(f.build, 0.0f) * smoothstep(.45f, .58f, r.t);
        r.width *= g * stout, r.ahead *= g * stout * belly, r.behind *= g;
        // A waist for her.
        float waist = f.feminine * smoothstep(.56f, .61f, r.t);
        r.width -= .008f * waist, r.ahead -= .004f * waist, r.behind -= .004f * waist;
    }
    t.add(make_loft({}, {1, 0, 0}, {0, 1, 0}, skirt, 0, .02f), 0, .03f);
    constexpr float k_over = .0115f;
    if (f.has_skirt()) t.add(trimmed(skirt_loft(f), f.robe_hem + k_over, .580f, 0, .03f), k_over);
}

}  // namespace

void add_upper_clothes(Field& field, const Figure& figure) {
    Tailor top{field, figure, layer_top};
    add_top(field, figure);
    switch (figure.over) {
        case Over::none:
            break;
        case Over::jacket:
            add_upper(top, {.011f, top_hem(figure), .325f, .001f});
            add_neckband(top, .012f, .851f);
            {
                BodyRing throat[] = {{.812f, 0, 0, .003f, .14f, .001f}, {.870f, 0, 0, .026f, .14f, .001f}};
                top.carve(make_loft({0, 0, .010f}, {1, 0, 0}, {0, 1, 0}, throat, 0, 0), .003f);
            }
            break;
        case Over::open_jacket:
            add_upper(top, {.010f, top_hem(figure), .323f, 0});
            add_neckband(top, .009f, .846f);
            open_front(top, .470f, .640f, .006f);
            add_lapels(field, figure, .0135f, .640f, .004f);
            break;
        case Over::coat:
            add_coat(top);
            add_neckband(top, .011f, .848f);
            open_front(top, .660f, .680f, .001f);
            add_lapels(field, figure, .0160f, .680f, .012f);
            break;
        case Over::vest:
            add_upper(top, {.013f, top_hem(figure), 0, 0, .007f});
            add_neckband(top, .013f, .850f);
            // The armholes.
            top.crop({1, .25f, 0}, {figure_shoulder(figure).x - .001f, .80f, 0}, .006f);
            break;
    }
}

}  // namespace flaneur
