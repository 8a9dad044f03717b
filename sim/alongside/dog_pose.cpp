// From a dog's feet and trunk to its bones.
#include <algorithm>
#include <cmath>

#include "sim/alongside/dog.h"
#include "sim/base/math.h"

namespace flaneur {

namespace {

constexpr float k_turn = 2 * k_pi;

// What tells breeds apart, withers high.
struct Build {
    float withers, radius;  // metres
    float leg;              // share of the height below the elbow, 1: as usual
    float long_way;         // half of the way from shoulder to hip
    float neck, muzzle;     // lengths
    float head_up;          // how far the neck rises
    bool ears_hang, tail_up;
};
constexpr Build k_builds[k_breeds] = {{0.33f, 0.13f, 0.86f, 0.44f, 0.30f, 0.30f, 0.80f, false, true},
                                      {0.47f, 0.16f, 0.95f, 0.42f, 0.32f, 0.33f, 0.72f, true, false},
                                      {0.62f, 0.19f, 1.00f, 0.41f, 0.36f, 0.36f, 0.66f, false, false}};

DogShape make_shape(const Build& b) {
    DogShape s;
    s.withers = b.withers;
    s.radius = b.radius;
    const float l = b.long_way, leg = b.leg;
    auto& j = s.joints;
    j[dog_pelvis] = {0, .84f, -l + .02f};
    j[dog_loin] = {0, .86f, -.22f * l};
    j[dog_chest] = {0, .85f, .45f * l};
    j[dog_neck] = {0, .90f, l + .02f};
    const float up = b.head_up, on = std::sqrt(1 - up * up);
    j[dog_head] = j[dog_neck] + Vec3{0, up, on} * b.neck;
    for (const auto& [ear, side] : {std::pair{dog_left_ear, 1.0f}, {dog_right_ear, -1.0f}})
        j[ear] = j[dog_head] + Vec3{side * .085f, b.ears_hang ? .085f : .115f, .03f};
    const Vec3 tail = b.tail_up ? Vec3{0, .75f, -.66f} : Vec3{0, -.52f, -.85f};
    j[dog_tail] = {0, .86f, -l - .15f};
    j[dog_tail_middle] = j[dog_tail] + tail * .17f;
    j[dog_tail_end] = j[dog_tail_middle] + tail * .16f;
    for (const float side : {1.0f, -1.0f}) {
        const int arm = side > 0 ? dog_left_arm : dog_right_arm,
                  thigh = side > 0 ? dog_left_thigh : dog_right_thigh;
        j[static_cast<size_t>(arm)] = {side * .125f, .80f, l - .01f};
        j[static_cast<size_t>(arm) + 1] = {side * .135f, .47f * leg + .02f, l - .12f};
        j[static_cast<size_t>(arm) + 2] = {side * .125f, .16f * leg, l - .055f};
        s.pads[static_cast<size_t>(side > 0 ? k_fore_left : k_fore_right)] = {side * .125f, 0, l - .02f};
        j[static_cast<size_t>(thigh)] = {side * .105f, .79f, -l};
        j[static_cast<size_t>(thigh) + 1] = {side * .125f, .47f * leg + .02f, -l + .13f};
        j[static_cast<size_t>(thigh) + 2] = {side * .115f, .24f * leg, -l - .14f};
        s.pads[static_cast<size_t>(side > 0 ? k_hind_left : k_hind_right)] = {side * .115f, 0, -l - .06f};
    }
    s.collar = lerp(j[dog_neck], j[dog_head], .35f) + Vec3{0, .03f, -.045f};
    s.half_long = (l + .05f) * b.withers;
    return s;
}

// The trunk of one dog, and what its limbs go by.
struct Trunk {
    Quat pelvis, chest;
    Vec3 ahead, left;  // of the heading, on the plane
};

float cycle(float phase) { return sin_cos(k_turn * (phase - std::floor(phase))).sine; }

void pose_trunk(const Dog& dog, DogPose& pose, Trunk& t) {
    const DogShape& s = shape_of(dog.breed);
    const float w = withers_of(dog), m = dog.moves, sits = smoothstep(0, 1, dog.sits),
                nose = smoothstep(0, 1, dog.nose);
    const Vec2 way = heading_direction(dog.heading);
    t.ahead = at_height(way, 0);
    t.left = {way.z, 0, -way.x};
    const float l = 2 * s.joints[dog_neck].z * w;
    const float slope = clamp(arctan2(dog.fore - dog.hind, l), -0.7f, 0.7f);
    // Twice a stride it sinks while a pair of feet carries it, in a trot more.
    const float beat = cycle(2 * (dog.phase - 0.5f * dog.duty) + 0.25f);
    const float bounce = -(lerp(0.008f, 0.022f, dog.trots) * beat + 0.025f) * w * m;
    const float sway = 0.075f * m * (1 - 0.6f * dog.trots) * cycle(dog.phase + 0.2f);
    const float roll = 0.045f * m * cycle(dog.phase);
    const float dips = nose * 0.10f * w;
    Vec3 chest = dog.position + t.ahead * (s.joints[dog_chest].z * w);
    chest.y = lerp(dog.hind, dog.fore, 0.5f + 0.5f * s.joints[dog_chest].z / s.joints[dog_neck].z) +
              s.joints[dog_chest].y * w + bounce - dips;
    Vec3 pelvis = dog.position + t.ahead * (s.joints[dog_pelvis].z * w);
    pelvis.y = dog.hind + s.joints[dog_pelvis].y * w + bounce;
    const float spine = length(s.joints[dog_chest] - s.joints[dog_pelvis]) * w;
    if (sits > 0) {
        // Down behind its hind pads, the trunk held up by the fore legs.
        const Vec3 pads = (dog.feet[k_hind_left].at + dog.feet[k_hind_right].at) * 0.5f;
        const Vec3 seat = pads + Vec3{0, 0.27f * w, 0} - t.ahead * (0.36f * w);
        const float high = dog.fore + 0.77f * w - seat.y;
        const Vec3 up = seat + Vec3{0, high, 0} +
                        t.ahead * std::sqrt(std::max(spine * spine - high * high, 0.02f * w * w));
        pelvis = lerp(pelvis, seat, sits);
        chest = lerp(chest, up, sits);
    }
    const float leans = arctan2(chest.y - pelvis.y, std::max(dot(chest - pelvis, t.ahead), 0.02f * w)) -
                        arctan2(s.joints[dog_chest].y - s.joints[dog_pelvis].y,
                                s.joints[dog_chest].z - s.joints[dog_pelvis].z);
    const Quat yaw = rotation_y(dog.heading);
    t.pelvis = yaw * rotation_y(-0.5f * dog.bend + sway) * rotation_x(-lerp(slope, 1.0f * leans, sits)) *
               rotation_z(roll);
    t.chest = yaw * rotation_y(0.5f * dog.bend - 0.5f * sway) *
              rotation_x(-lerp(leans - 0.10f * nose, 0.72f * leans, sits)) * rotation_z(-0.5f * roll);
    pose[dog_pelvis] = {pelvis, t.pelvis};
    pose[dog_chest] = {chest, t.chest};
    const Vec3 rear = pelvis + rotate(t.pelvis, (s.joints[dog_loin] - s.joints[dog_pelvis]) * w);
    const Vec3 fore = chest + rotate(t.chest, (s.joints[dog_loin] - s.joints[dog_chest]) * w);
    pose[dog_loin] = {lerp(rear, fore, 0.5f), nlerp(t.pelvis, t.chest, 0.45f)};
}

void pose_head(const Dog& dog, DogPose& pose, const Trunk& t) {
    const DogShape& s = shape_of(dog.breed);
    const float w = withers_of(dog), nose = smoothstep(0, 1, dog.nose);
    const float nods = 0.06f * dog.moves * (1 - dog.trots) * cycle(2 * dog.phase + 0.1f);
    const Quat level = nlerp(t.chest, rotation_y(dog.heading + 0.5f * dog.bend), 0.75f);
    const float yaw = dog.gaze + 0.25f * dog.bend;
    const float down = 1.50f * nose + nods + 0.10f * dog.moves - 0.4f * dog.gaze_pitch;
    const Quat neck = level * rotation_y(0.5f * yaw) * rotation_x(down);
    const Quat head =
        level * rotation_y(yaw) * rotation_x(0.5f * down * (1 - nose) + 1.15f * nose - 0.6f * dog.gaze_pitch);
    auto put = [&](int j, int from, Quat turn) {
        const auto a = static_cast<size_t>(from), b = static_cast<size_t>(j);
        pose[b] = {pose[a].position + rotate(pose[a].rotation, (s.joints[b] - s.joints[a]) * w), turn};
    };
    put(dog_neck, dog_chest, neck);
    put(dog_head, dog_neck, head);
    const float flaps = 0.18f * dog.moves * cycle(2 * dog.phase + 0.35f);
    put(dog_left_ear, dog_head, head * rotation_z(flaps));
    put(dog_right_ear, dog_head, head * rotation_z(-flaps));
    const float wag = (0.15f * dog.moves + 0.5f * dog.wags) * cycle(dog.wag),
                lift = 0.5f * dog.wags + 0.25f * dog.moves;
    const float bent = smoothstep(0, 1, dog.sits);
    const Quat tail = t.pelvis * rotation_y(wag) * rotation_x(lift * (1 - bent) + 1.5f * bent);
    put(dog_tail, dog_pelvis, tail);
    put(dog_tail_middle, dog_tail, tail * rotation_y(0.7f * wag) * rotation_x(0.3f * lift));
    put(dog_tail_end, dog_tail_middle,
        pose[dog_tail_middle].rotation * rotation_y(0.7f * cycle(dog.wag - 0.1f) * 0.5f * dog.wags));
}

struct Limb {
    size_t first, carrier;  // joints
    bool hind;
    Vec3 rest[4];  // of the shape: root, middle, wrist, pad
};
Limb limb_of(const Dog& dog, int leg) {
    const DogShape& s = shape_of(dog.breed);
    const bool hind = leg >= k_hind_left, left = leg == k_fore_left || leg == k_hind_left;
    const auto first = static_cast<size_t>(hind ? (left ? dog_left_thigh : dog_right_thigh)
                                                : (left ? dog_left_arm : dog_right_arm));
    return {first,
            static_cast<size_t>(hind ? dog_pelvis : dog_chest),
            hind,
            {s.joints[first], s.joints[first + 1], s.joints[first + 2], s.pads[static_cast<size_t>(leg)]}};
}

// Where a leg begins. Shoulder blades glide along the chest, and the pelvis turns a little with the leg.
Vec3 root_of(const Dog& dog, const DogPose& pose, const Trunk& t, const Limb& limb, Vec3 pad) {
    const DogShape& s = shape_of(dog.breed);
    const float w = withers_of(dog), glides = (limb.hind ? 0.05f : 0.13f) * w;
    const JointPose& carrier = pose[limb.carrier];
    const Vec3 root =
        carrier.position + rotate(carrier.rotation, (limb.rest[0] - s.joints[limb.carrier]) * w);
    return root + t.ahead * clamp(0.32f * dot(pad - root, t.ahead), -glides, glides);
}

// The trunk sinks at the end where a leg would be too short for a foot that stands.
void sink(const Dog& dog, DogPose& pose, const Trunk& t) {
    const float w = withers_of(dog);
    for (const bool hind : {false, true}) {
        float by = 0;
        for (const int leg : {hind ? k_hind_left : k_fore_left, hind ? k_hind_right : k_fore_right}) {
            const Limb limb = limb_of(dog, leg);
            const DogFoot& foot = dog.feet[leg];
            const Vec3 root = root_of(dog, pose, t, limb, foot.at), way = root - foot.at;
            const float reach = 0.985f * w *
                                (length(limb.rest[1] - limb.rest[0]) + length(limb.rest[2] - limb.rest[1]) +
                                 length(limb.rest[3] - limb.rest[2]));
            const float flat = length(Vec2{way.x, way.z});
            const float high = std::sqrt(std::max(reach * reach - flat * flat, 0.09f * w * w));
            const float stands =
                foot.share >= 1 ? 1 : clamp(1 - 5 * foot.share, 0, 1) + clamp(5 * foot.share - 4, 0, 1);
            by = std::max(by, stands * (way.y - high));
        }
        pose[hind ? dog_pelvis : dog_chest].position.y -= by;
        pose[dog_loin].position.y -= 0.5f * by;
    }
}

// Two bones and a paw from `root` to the pad, which stays where it is; the middle joint to the side of
// `front`.
void pose_leg(const Dog& dog, DogPose& pose, const Trunk& t, int leg) {
    const float w = withers_of(dog);
    const Limb limb = limb_of(dog, leg);
    const size_t first = limb.first;
    const bool hind = limb.hind;
    const auto& rest = limb.rest;
    const DogFoot& foot = dog.feet[leg];
    const Vec3 pad = foot.at, root = root_of(dog, pose, t, limb, pad);
    const float a = length(rest[1] - rest[0]) * w, b = length(rest[2] - rest[1]) * w,
                c = length(rest[2] - rest[3]) * w;
    auto lean = [&](Vec3 v) { return arctan2(dot(v, t.ahead), std::max(v.y, 0.01f * w)); };
    const float rest_lean = arctan2(rest[0].z - rest[3].z, rest[0].y);
    const float paw_lean = arctan2(rest[2].z - rest[3].z, rest[2].y);
    const float up = foot.share >= 1 ? 0 : sin_cos(k_pi * foot.share).sine;
    const float lies =
        hind ? lerp(0, -1.0f, smoothstep(0, 1, dog.sits)) : 0;  // of who sits, down on the hocks
    float leans = paw_lean +
                  (hind ? 1.15f : 0.8f) * (lean(root - pad) - rest_lean) * (1 - smoothstep(0, 1, dog.sits)) +
                  (hind ? 0.75f : 1.15f) * up + lies;
    leans = clamp(leans, -1.5f, 1.35f);
    const SinCos tilt = sin_cos(leans);
    const float aside = dot(root - pad, t.left) / std::max(length(root - pad), 0.1f * w);
    const Vec3 stem =
        normalize_or(t.ahead * tilt.sine + Vec3{0, tilt.cosine, 0} + t.left * (0.7f * aside), {0, 1, 0});
    Vec3 wrist = pad + stem * c;
    // A paw that is lifted high tilts: its wrist stays below the shoulder, where the leg would turn over.
    const float high = clamp((root.y - (hind ? 0.26f : 0.16f) * w - pad.y) / c, -1, 1);
    if (foot.share < 1 && stem.y > high) {
        const Vec3 flat = normalize_or(stem - Vec3{0, stem.y, 0}, t.ahead);
        wrist = pad + (Vec3{0, high, 0} + flat * std::sqrt(1 - high * high)) * c;
    }
    const float most = 0.995f * (a + b), least = std::fabs(a - b) + 0.02f * w;
    float far = length(wrist - root);
    if (far > most) {
        // As straight as it goes: the paw turns up about its pad.
        const Vec3 line = normalize_or(root - pad, {0, 1, 0});
        const float whole = length(root - pad);
        wrist = whole > most + c ? pad + line * (whole - most) : wrist;
        for (int i = 0; i < 6 && length(wrist - root) > most; ++i)
            wrist = pad + normalize_or(lerp(wrist - pad, line * c, 0.5f), line) * c;
        far = std::max(std::min(length(wrist - root), most), least);
    }
    const Vec3 along = normalize_or(wrist - root, {0, -1, 0});
    const float reach = clamp(far, least, most);
    const float on = (a * a - b * b + reach * reach) / (2 * reach);
    const Vec3 bend = t.ahead * (hind ? 1.0f : -1.0f);
    const Vec3 aside_of = normalize_or(bend - along * dot(bend, along), t.ahead);
    const Vec3 middle = root + along * on + aside_of * std::sqrt(std::max(a * a - on * on, 0.0f));
    const Quat yaw = rotation_y(dog.heading);
    auto turned = [&](int bone, Vec3 to) {
        const Vec3 was = rotate(yaw, normalize_or(rest[bone + 1] - rest[bone], {0, -1, 0}));
        return normalize(rotation_between(was, normalize_or(to, {0, -1, 0})) * yaw);
    };
    pose[first] = {root, turned(0, middle - root)};
    pose[first + 1] = {middle, turned(1, wrist - middle)};
    pose[first + 2] = {wrist, turned(2, pad - wrist)};
}

}  // namespace

const DogShape& shape_of(Breed breed) {
    static const std::array<DogShape, k_breeds> shapes = {make_shape(k_builds[0]), make_shape(k_builds[1]),
                                                          make_shape(k_builds[2])};
    return shapes[static_cast<size_t>(breed)];
}

DogPose pose_dog(const Dog& dog) {
    DogPose pose;
    Trunk trunk;
    pose_trunk(dog, pose, trunk);
    sink(dog, pose, trunk);
    pose_head(dog, pose, trunk);
    for (int leg = 0; leg < 4; ++leg) pose_leg(dog, pose, trunk, leg);
    return pose;
}

Vec3 collar_of(const Dog& dog, const DogPose& pose) {
    const DogShape& s = shape_of(dog.breed);
    return pose[dog_neck].position +
           rotate(pose[dog_neck].rotation, (s.collar - s.joints[dog_neck]) * withers_of(dog));
}

Vec3 posed_pad(const Dog& dog, const DogPose& pose, DogLeg leg) {
    const DogShape& s = shape_of(dog.breed);
    constexpr int paws[] = {dog_left_paw, dog_right_paw, dog_left_hind_paw, dog_right_hind_paw};
    const auto paw = static_cast<size_t>(paws[leg]);
    return pose[paw].position +
           rotate(pose[paw].rotation, (s.pads[static_cast<size_t>(leg)] - s.joints[paw]) * withers_of(dog));
}

}  // namespace flaneur
