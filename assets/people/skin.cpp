#include "assets/people/skin.h"

#include <algorithm>

#include "assets/people/parts.h"

namespace flaneur {

namespace {

using Weights = std::array<float, k_joint_count>;

// Hands `share` to the chain's joints: joint i rules from its place `at[i]` on, blending over `reach[i]`
// either side.
template <size_t N>
void along_chain(Weights& w, float share, const std::array<int, N>& joints, const std::array<float, N>& at,
                 const std::array<float, N>& reach, float t) {
    float rest = share;
    for (size_t i = N; i-- > 1;) {
        float mine = rest * smoothstep(at[i] - reach[i], at[i] + reach[i], t);
        w[size_t(joints[i])] += mine;
        rest -= mine;
    }
    w[size_t(joints[0])] += rest;
}

}  // namespace

Weights skin_weights(Vec3 p, Layer layer, const Figure& figure, const std::array<Vec3, k_joint_count>& bind,
                     bool hung) {
    Weights w{};
    bool right = p.x < 0;
    float x = right ? -p.x : p.x;
    Vec3 folded{x, p.y, p.z};
    int arm_side = right ? right_shoulder - left_shoulder : 0,
        leg_side = right ? right_upper_leg - left_upper_leg : 0;

    // Arms: beyond the shoulder along the arm, and near its axis.
    Vec3 from_shoulder = folded - bind[left_upper_arm];
    float along = dot(from_shoulder, bind_arm_direction());
    float away = length(from_shoulder - bind_arm_direction() * along);
    float arm = smoothstep(-.022f, .046f, along) * (1 - smoothstep(.046f, .075f, away));
    if (p.y < .40f || layer == layer_shoes || layer == layer_bottom || layer == layer_collar) arm = 0;
    if (p.y > .85f || layer == layer_hair) arm = 0;
    float elbow = length(bind[left_lower_arm] - bind[left_upper_arm]);
    float wrist = elbow + length(bind[left_hand] - bind[left_lower_arm]);
    along_chain<3>(w, arm, {left_upper_arm + arm_side, left_lower_arm + arm_side, left_hand + arm_side},
                   {0, elbow, wrist}, {0, .024f, .014f}, along);
    float rest = 1 - arm;

    // The shoulder girdle follows the clavicle on top.
    float clavicle = rest * .75f * smoothstep(.035f, .105f, x) * smoothstep(.735f, .800f, p.y) *
                     (1 - smoothstep(.85f, .87f, p.y));
    if (layer == layer_hair) clavicle = 0;
    w[size_t(left_shoulder + arm_side)] += clavicle;
    rest -= clavicle;

    // Legs: below a plane that falls inward from the hip's crease. A robe hangs from the hips and goes over
    // to the thighs on its way down, each side to its own and the middle to both; what comes out below its
    // hem moves with it there.
    bool outer = layer == layer_top || layer == layer_trim;
    bool robe = is_robe(layer, figure) && p.y > .08f;
    float crease = p.y - (.505f + (p.z < 0 ? -.16f : .06f) * p.z + .25f * (x - .052f));
    float leg = smoothstep(.040f, -.042f, crease), robe_leg = smoothstep(.570f, .430f, p.y);
    const bool bound = figure.robe_hem > 0 && !hung;
    float hemmed = robe ? 1 : bound ? smoothstep(-.050f, -.004f, p.y - figure.robe_hem) : 0;
    leg = lerp(leg, robe_leg, hemmed);
    if (layer == layer_inner || layer == layer_hair || layer == layer_collar) leg = 0;
    // Cloth about the hips is held by them, and what comes out below its hem goes along there.
    if (outer && !robe) leg *= .45f;
    if (layer == layer_bottom && figure.robe_hem == 0)
        leg *= lerp(1, .45f, smoothstep(-.055f, -.008f, p.y - top_hem(figure)));
    if (layer == layer_skin && p.y > .43f) leg = 0;
    float other = p.y < .40f ? 0 : smoothstep(.010f, -.010f, x);
    other = lerp(other, smoothstep(.050f, -.050f, x), hemmed);
    float knee = -bind[left_lower_leg].y, ankle = -bind[left_foot].y;
    for (int side : {leg_side, right_upper_leg - left_upper_leg - leg_side}) {
        float share = rest * leg * (side == leg_side ? 1 - other : other);
        std::array<int, 3> joints = {left_upper_leg + side, left_lower_leg + side, left_foot + side};
        if (layer == layer_shoes || (layer == layer_skin && p.y < .06f)) {
            float toes = smoothstep(bind[left_toes].z - .018f, bind[left_toes].z + .018f, p.z);
            float shin = smoothstep(.040f, .065f, p.y) * (p.y > .07f ? 1 : .7f);
            w[size_t(left_toes + side)] += share * toes;
            w[size_t(left_lower_leg + side)] += share * (1 - toes) * shin;
            w[size_t(left_foot + side)] += share * (1 - toes) * (1 - shin);
        } else {
            along_chain<3>(w, share, joints, {0, knee, ankle}, {0, lerp(.040f, .055f, hemmed), .016f}, -p.y);
        }
    }
    rest *= 1 - leg;

    // Spine, neck and head. Long hair lies on the back.
    float y = layer == layer_hair ? std::max(p.y, .83f) : p.y;
    float neck_lean = layer == layer_skin ? .5f * p.z : 0;  // the chin is head, the nape below it is neck
    along_chain<6>(w, rest, {hips, spine, chest, upper_chest, neck, head},
                   {0, .590f, .650f, .725f, .838f, .872f}, {0, .030f, .035f, .040f, .022f, .018f},
                   y + neck_lean);
    return w;
}

bool is_robe(Layer layer, const Figure& figure) {
    const bool outer = layer == layer_top || layer == layer_trim;
    return (layer == layer_bottom && figure.has_skirt()) || (outer && figure.over == Over::coat);
}

HungWeights hung_on(int follower, float share, const Weights& body) {
    HungWeights out{};
    for (size_t j = 0; j < body.size(); ++j) out[j] = body[j] * (1 - share);
    out[size_t(follower)] = share;
    return out;
}

HungWeights robe_weights(Vec3 p, const Weights& body) {
    // Of what legs move, most goes to the panels: their edge is at the sides, where each hangs half-way
    // between front and back. The rest keeps to the leg under it.
    constexpr float k_own = .35f;
    HungWeights out{};
    float legs = 0;
    for (size_t j = 0; j < body.size(); ++j) {
        const bool leg = j >= left_upper_leg;
        out[j] = body[j] * (leg ? k_own : 1);
        legs += leg ? body[j] : 0;
    }
    const float ahead = smoothstep(-.060f, .060f, p.z);
    out[skirt_front] = legs * (1 - k_own) * ahead;
    out[skirt_back] = legs * (1 - k_own) * (1 - ahead);
    return out;
}

HungWeights hair_weights(Vec3 p, const Figure& figure, const Weights& body) {
    const Vec3 face = to_face(p);
    float share = 0;
    if (figure.hair == Hair::ponytail)
        share = smoothstep(-.46f, -.58f, face.z) * smoothstep(.80f, .50f, face.y);
    else if (figure.hair == Hair::long_hair || figure.hair == Hair::shoulder_length)
        share = smoothstep(.10f, -.30f, face.y);
    return hung_on(loose_hair, share, body);
}

void pack_weights(std::span<const float> weights, uint8_t (&joints)[4], uint8_t (&bytes)[4]) {
    std::array<int, k_joint_count + k_follower_count> order;
    for (size_t j = 0; j < weights.size(); ++j) order[j] = int(j);
    std::sort(order.begin(), order.begin() + std::ptrdiff_t(weights.size()), [&](int a, int b) {
        float wa = weights[size_t(a)], wb = weights[size_t(b)];
        return wa != wb ? wa > wb : a < b;
    });
    float sum = 0;
    for (size_t n = 0; n < 4; ++n) sum += weights[size_t(order[n])];
    int left = 255;
    for (size_t n = 0; n < 4; ++n) {
        float share = sum > 0 ? weights[size_t(order[n])] / sum : (n == 0 ? 1.0f : 0.0f);
        int byte = std::min(left, int(share * 255 + 0.5f));
        joints[n] = uint8_t(order[n]);
        bytes[n] = uint8_t(byte);
        left -= byte;
    }
    bytes[0] = uint8_t(bytes[0] + left);
    for (size_t n = 0; n < 4; ++n)
        if (bytes[n] == 0) joints[n] = 0;
}

}  // namespace flaneur
