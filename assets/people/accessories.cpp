#include "assets/people/accessories.h"

#include <algorithm>
#include <cmath>

#include "assets/people/parts.h"

namespace flaneur {

namespace {

constexpr float h = k_head_height;
constexpr uint32_t k_dark = 0xff2b2826, k_pale = 0xffd2d4d6, k_wood = 0xff33435a;

// Down, in the canonical pose, for what hangs from a hand: who walks bends the elbow by some 0.4 rad.
constexpr Vec3 k_hanging{0, -.921f, -.389f};

// Places on the path, laid on whatever the figure wears, `gap` above it.
std::vector<Vec3> draped(const Field& field, std::vector<Vec3> path, float gap) {
    std::vector<uint16_t> near;
    for (Vec3& p : path)
        for (int round = 0; round < 5; ++round) {
            parts_near(field, p, .05f, near);
            float away = distance(layer_distances(field, near, p)) - gap;
            p -= normalize_or(gradient(field, near, p), {0, 0, 0}) * clamp(away, -.02f, .02f);
        }
    return path;
}

float least_distance(const Field& field, const std::vector<Vec3>& path) {
    std::vector<uint16_t> near;
    float least = 1;
    for (Vec3 p : path) {
        parts_near(field, p, .05f, near);
        least = std::min(least, distance(layer_distances(field, near, p)));
    }
    return least;
}

// Twice as many places, rounded (Chaikin 1974, closed or with its ends kept).
std::vector<Vec3> rounded(const std::vector<Vec3>& path, bool closed) {
    std::vector<Vec3> out;
    size_t n = path.size();
    if (!closed) out.push_back(path.front());
    for (size_t i = 0; i + (closed ? 0 : 1) < n; ++i) {
        Vec3 a = path[i], b = path[(i + 1) % n];
        out.push_back(lerp(a, b, .25f));
        out.push_back(lerp(a, b, .75f));
    }
    if (!closed) out.push_back(path.back());
    return out;
}

std::vector<Vec3> mirrored(std::vector<Vec3> path) {
    for (Vec3& p : path) p.x = -p.x;
    return path;
}

std::vector<Vec3> on_face(std::vector<Vec3> path) {
    for (Vec3& p : path) p = from_face(p);
    return path;
}

// From a wrist in the canonical pose, the arms down, to the one of the bind pose; `side` 1 left, -1 right.
struct HandTurn {
    Vec3 hand, bound;
    Quat turn;
    Vec3 raised(Vec3 p) const { return bound + rotate(turn, p - hand); }
};
HandTurn raised_hand(const Figure& figure, float side) {
    Vec3 arm = bind_arm_direction(), shoulder = figure_shoulder(figure);
    arm.x *= side, shoulder.x *= side;
    constexpr float k_wrist = .327f;
    return {shoulder + Vec3{0, -k_wrist, 0}, shoulder + arm * k_wrist, rotation_between({0, -1, 0}, arm)};
}

// Where a hand that hangs down holds things, x by side.
Vec3 palm_of(const Figure& figure) { return figure_shoulder(figure) + Vec3{-.004f, -.392f, .002f}; }

// Where the right hand holds a stick, and how long that is from there.
Vec3 stick_grip(const Figure& figure) {
    Vec3 palm = palm_of(figure);
    return {-palm.x + .002f, palm.y + .016f, palm.z + .012f};
}
constexpr float k_stick = .445f;

struct Rack {
    const Figure& figure;
    const Field& field;
    std::vector<Accessory> worn;

    void add(SolidMesh solid, Tint tint, uint32_t colour, int joint) {
        worn.push_back({std::move(solid), tint, colour, joint});
    }
    // Lies on the coat or whatever is worn.
    void add_on_cloth(SolidMesh solid, Tint tint, uint32_t colour) {
        worn.push_back({std::move(solid), tint, colour});
    }
    // What was put on last swings.
    void hang(int follower, Vec3 pivot, float from = 0, float to = 0) {
        Accessory& last = worn.back();
        last.follower = follower, last.pivot = pivot, last.from = from, last.to = to;
    }
    // In the canonical pose, the arms down, into the bind pose; `side` 1 left, -1 right.
    void add_to_hand(SolidMesh solid, Tint tint, uint32_t colour, float side) {
        HandTurn raised = raised_hand(figure, side);
        for (Vec3& p : solid.positions) p = raised.raised(p);
        for (Vec3& n : solid.normals) n = rotate(raised.turn, n);
        add(std::move(solid), tint, colour, side > 0 ? left_hand : right_hand);
    }
    Vec3 palm() const { return palm_of(figure); }

    // A third colour where there is one to spare.
    Tint spare() const { return figure.over == Over::none ? Tint::accent : Tint::bottom; }
};

void add_hat(Rack& r) {
    bool thick = r.figure.hair != Hair::cropped && r.figure.hair != Hair::bald;
    float g = thick ? 1.05f : 1.0f;
    Frame frame = make_frame(from_face({0, .635f, -.030f}), {0, 1, -.12f}, {0, 0, 1});
    auto turned = [&](std::vector<Turn> profile) {
        for (Turn& t : profile) t.radius *= g, t.height *= g;
        return make_turned(frame, profile, 1.20f, 24);
    };
    switch (r.figure.hat) {
        case Hat::none:
            break;
        case Hat::cap: {
            r.add(turned({{.046f, -.002f},
                          {.0488f, -.001f},
                          {.0495f, .004f},
                          {.0492f, .016f},
                          {.0462f, .031f},
                          {.0375f, .0445f},
                          {.022f, .0525f},
                          {.006f, .055f}}),
                  r.spare(), 0xffffffff, head);
            Frame peak = make_frame(frame.at({0, .0005f, .068f}), {0, 1, .26f}, {0, -.26f, 1});
            r.add(make_pillow(peak, {.041f, .0026f, .034f}, .75f, 18, 6), r.spare(), 0xffd8d8d8, head);
            break;
        }
        case Hat::beanie:
            r.add(turned({{.047f, -.005f},
                          {.0508f, -.0055f},
                          {.0528f, -.002f},
                          {.0532f, .006f},
                          {.0526f, .0125f},
                          {.0500f, .0145f},
                          {.0498f, .026f},
                          {.0462f, .041f},
                          {.0365f, .0555f},
                          {.020f, .0635f},
                          {.006f, .0655f}}),
                  r.spare(), 0xffffffff, head);
            break;
        case Hat::brimmed:
            r.add(turned({{.047f, .0005f},
                          {.066f, -.0030f},
                          {.081f, -.0035f},
                          {.0845f, -.0010f},
                          {.081f, .0010f},
                          {.064f, .0010f},
                          {.0525f, .0045f},
                          {.0512f, .0120f},
                          {.0490f, .033f},
                          {.0455f, .0485f},
                          {.0370f, .0565f},
                          {.024f, .0565f},
                          {.010f, .0540f}}),
                  r.spare(), 0xffffffff, head);
            r.add(turned({{.0500f, .0040f}, {.0535f, .0050f}, {.0528f, .0150f}, {.0490f, .0160f}}),
                  Tint::shoes, 0xffc0c0c0, head);
            break;
    }
}

void add_glasses(Rack& r) {
    const std::vector<Vec3> rim = glasses_rim(r.figure, 14, 0);
    std::vector<Vec3> temple = {{.228f, .517f, .400f},
                                {.285f, .512f, .26f},
                                {.335f, .503f, .10f},
                                {.353f, .485f, -.03f},
                                {.350f, .43f, -.085f}};
    std::vector<Vec3> bridge = {
        {.062f, .500f, .434f}, {.02f, .514f, .450f}, {-.02f, .514f, .450f}, {-.062f, .500f, .434f}};
    const float thick = k_glasses_thick * h;
    const uint32_t colour = glasses_colour(r.figure);
    for (bool left : {true, false}) {
        auto side = [&](const std::vector<Vec3>& path) { return on_face(left ? path : mirrored(path)); };
        r.add(make_ring(side(rim), {0, 0, 1}, thick, thick, 4), Tint::none, colour, head);
        r.add(make_band(side(temple), {0, 1, 0}, thick * 1.2f, thick * .8f, 4), Tint::none, colour, head);
    }
    r.add(make_band(on_face(bridge), {0, 0, 1}, thick, thick, 4), Tint::none, colour, head);
}

void add_headphones(Rack& r) {
    uint32_t colour = r.figure.seed % 2 == 0 ? k_dark : k_pale;
    std::vector<Vec3> band;
    for (int i = 0; i <= 10; ++i) {
        float a = 3.1415927f * float(i) / 10;
        band.push_back(from_face({.395f * std::cos(a), .44f + .612f * std::sin(a), -.02f}));
    }
    r.add(make_band(band, {0, 0, 1}, .040f * h, .022f * h), Tint::none, colour, head);
    for (float side : {1.0f, -1.0f}) {
        Frame cup = make_frame(from_face({side * .375f, .435f, -.02f}), {0, 1, 0}, {side, 0, .1f});
        r.add(make_pillow(cup, Vec3{.085f, .110f, .050f} * h, .7f, 12, 6), Tint::none, colour, head);
    }
}

void add_scarf(Rack& r) {
    // As tight as the collar under it allows.
    constexpr int k_points = 18;
    constexpr float k_clear = .000f;  // of the cloth; it is .0125 thick
    const float g = lerp(1, .92f, r.figure.feminine);
    std::vector<Vec3> loop;
    for (int tries = 0; tries < 12 && (loop.empty() || least_distance(r.field, loop) < k_clear); ++tries) {
        loop.clear();
        const float out = g * (1 + .02f * float(tries)), up = .0020f * float(tries);
        for (int i = 0; i < k_points; ++i) {
            float a = 6.2831853f * float(i) / k_points, s = std::sin(a), c = std::cos(a);
            loop.push_back({.0500f * out * s, up + .838f - .010f * c + .003f * std::sin(3 * a),
                            -.010f + .048f * out * c});
        }
    }
    r.add_on_cloth(make_ring(loop, {0, 1, 0}, .0185f, .0125f, 8), Tint::accent, 0xffffffff);
    std::vector<Vec3> end = {{.014f, .805f, .060f}, {.019f, .795f, .065f}, {.023f, .765f, .075f},
                             {.025f, .735f, .078f}, {.026f, .700f, .075f}, {.027f, .665f, .070f}};
    end = draped(r.field, rounded(end, false), .006f);
    end.insert(end.begin(), loop.front() + Vec3{.008f, -.004f, 0});  // it comes out of the loop
    r.add_on_cloth(make_band(end, {1, 0, 0}, .0190f, .0052f, 8), Tint::accent, 0xfff0f0f0);
    r.hang(scarf_end, end[2], .015f, .090f);
}

void add_backpack(Rack& r) {
    float back = draped(r.field, {{0, .700f, -.09f}}, 0)[0].z, g = lerp(1, .93f, r.figure.feminine);
    Tint tint = r.spare();
    Frame sack = make_frame({0, .690f, back - .030f}, {0, 1, .06f}, {0, 0, -1});
    r.add(make_pillow(sack, {.076f * g, .088f, .036f}, .55f, 20, 10), tint, 0xffe6e6e6, upper_chest);
    const Vec3 top = sack.at({0, .080f, -.030f});
    r.hang(carried_bag, top);
    Frame pocket = make_frame({0, .657f, back - .061f}, {0, 1, .06f}, {0, 0, -1});
    r.add(make_pillow(pocket, {.055f * g, .040f, .016f}, .55f, 16, 8), tint, 0xffcccccc, upper_chest);
    r.hang(carried_bag, top);
    std::vector<Vec3> strap = {{.042f, .775f, back - .004f}, {.044f, .812f, -.050f}, {.046f, .834f, -.008f},
                               {.049f, .815f, .036f},        {.054f, .770f, .068f},  {.060f, .725f, .075f},
                               {.072f, .680f, .060f},        {.088f, .648f, .022f},  {.084f, .635f, -.030f},
                               {.062f, .630f, back - .006f}};
    strap = draped(r.field, rounded(strap, false), .0022f);
    r.add_on_cloth(make_band(strap, {1, 0, 0}, .0098f, .0034f), tint, 0xffb8b8b8);
    r.add_on_cloth(make_band(mirrored(strap), {1, 0, 0}, .0098f, .0034f), tint, 0xffb8b8b8);
}

void add_shoulder_bag(Rack& r) {
    // It lies on the hip, and the strap runs from one of its upper corners to the other.
    Vec3 at = draped(r.field, {{-.080f, .508f, -.09f}}, .011f)[0];
    Frame bag = make_frame(at, {0, 1, 0}, {-.55f, 0, -.85f});
    std::vector<Vec3> strap = {{-.104f, .575f, .010f}, {-.075f, .605f, .060f}, {-.030f, .665f, .080f},
                               {.018f, .735f, .085f},  {.048f, .800f, .040f},  {.062f, .830f, -.010f},
                               {.054f, .805f, -.050f}, {.030f, .755f, -.075f}, {-.010f, .680f, -.075f},
                               {-.040f, .620f, -.080f}};
    strap = draped(r.field, rounded(strap, false), .0020f);
    strap.insert(strap.begin(), bag.at({.056f, .034f, 0}));
    strap.push_back(bag.at({-.056f, .034f, 0}));
    const Vec3 top = bag.at({0, .040f, -.010f});
    r.add_on_cloth(make_band(strap, {.6f, .8f, 0}, .0075f, .0026f), Tint::shoes, 0xffe0e0e0);
    r.hang(carried_bag, top, .095f, .062f);
    r.add(make_pillow(bag, {.062f, .046f, .021f}, .5f, 18, 8), Tint::shoes, 0xffe0e0e0, hips);
    r.hang(carried_bag, top);
    Frame flap = make_frame(bag.at({0, .018f, .004f}), bag.up, bag.front);
    r.add(make_pillow(flap, {.0635f, .031f, .0205f}, .5f, 18, 8), Tint::shoes, 0xffffffff, hips);
    r.hang(carried_bag, top);
}

void add_handbag(Rack& r) {
    Vec3 palm = r.palm(), down = k_hanging, ahead{0, down.z, -down.y}, out{1, 0, 0};
    Vec3 at = palm + down * .108f + out * .012f, top = palm + down * .072f + out * .010f;
    r.add_to_hand(make_pillow(make_frame(at, -down, out), {.064f, .046f, .022f}, .55f, 18, 8), Tint::shoes,
                  0xffe8e8e8, 1);
    const Vec3 held = raised_hand(r.figure, 1).raised(palm);
    r.hang(carried_bag, held);
    std::vector<Vec3> handle = {
        top - ahead * .036f,  lerp(top, palm, .7f) - ahead * .030f, palm - ahead * .012f,
        palm + ahead * .012f, lerp(top, palm, .7f) + ahead * .030f, top + ahead * .036f};
    r.add_to_hand(make_band(rounded(handle, false), out, .0035f, .0028f), Tint::shoes, 0xffb0b0b0, 1);
    r.hang(carried_bag, held);
}

void add_phone(Rack& r) {
    Vec3 palm = r.palm();
    Frame f = make_frame({-palm.x + .013f, palm.y + .002f, palm.z + .004f}, {.12f, 1, .1f}, {1, 0, 0});
    r.add_to_hand(make_pillow(f, {.0205f, .0415f, .0026f}, .3f, 16, 6), Tint::none, k_dark, -1);
}

void add_stick(Rack& r) {
    Vec3 at = stick_grip(r.figure), down = k_hanging, ahead{0, down.z, -down.y};
    std::vector<Vec3> shaft = {at, at + down * .2f, at + down * (k_stick - .02f), at + down * k_stick};
    r.add_to_hand(make_band(shaft, {1, 0, 0}, .0052f, .0052f, 8), Tint::none, k_wood, -1);
    const Vec3 held = raised_hand(r.figure, -1).raised(at);
    r.hang(walking_stick, held);
    std::vector<Vec3> grip = {at + ahead * -.050f + down * .014f, at + ahead * -.036f + down * .002f,
                              at + ahead * -.012f, at + ahead * .012f - down * .001f,
                              at + ahead * .024f + down * .004f};
    r.add_to_hand(make_band(grip, {1, 0, 0}, .0072f, .0068f, 8), Tint::none, k_wood, -1);
    r.hang(walking_stick, held);
}

}  // namespace

bool has_stick(const Figure& figure) { return figure.stick && !figure.phone; }

Vec3 stick_tip(const Figure& figure) {
    HandTurn raised = raised_hand(figure, -1);
    return raised.raised(stick_grip(figure) + k_hanging * k_stick);
}

uint32_t glasses_colour(const Figure& figure) { return figure.seed % 2 == 0 ? k_dark : 0xff26364a; }

std::vector<Vec3> glasses_rim(const Figure& figure, int corners, float wider) {
    const Vec3 eye = figure.face.eye;
    const bool round = figure.seed % 3 == 0;
    auto boxy = [&](float v) { return v < 0 ? -std::pow(-v, .62f) : std::pow(v, .62f); };
    std::vector<Vec3> rim;
    for (int i = 0; i < corners; ++i) {
        float a = 6.2831853f * (float(i) + .5f) / float(corners), c = std::cos(a), s = std::sin(a);
        Vec3 p = round ? Vec3{(.083f + wider) * c, (.078f + wider) * s, 0}
                       : Vec3{(.088f + wider) * boxy(c), (.062f + wider) * boxy(s), 0};
        p += {eye.x + .006f, eye.y - .004f, .432f};
        p.z -= .20f * (p.x - .06f) + .02f * (eye.y - p.y);
        rim.push_back(p);
    }
    return rim;
}

std::vector<Accessory> make_accessories(const Figure& figure, const Field& field) {
    Rack r{figure, field, {}};
    add_hat(r);
    if (figure.headphones && figure.hat == Hat::none) add_headphones(r);
    if (figure.scarf) add_scarf(r);
    if (figure.bag == Bag::backpack) add_backpack(r);
    if (figure.bag == Bag::shoulder_bag) add_shoulder_bag(r);
    if (figure.bag == Bag::handbag) add_handbag(r);
    if (figure.phone) add_phone(r);
    if (has_stick(figure)) add_stick(r);
    const size_t others = r.worn.size();
    if (figure.glasses) add_glasses(r);
    for (size_t i = others; i < r.worn.size(); ++i) r.worn[i].painted_afar = true;
    return r.worn;
}

}  // namespace flaneur
