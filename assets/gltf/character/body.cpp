#include "assets/gltf/character/body.h"

#include <algorithm>
#include <cmath>

#include "assets/girth.h"
#include "assets/people/skin.h"
#include "sim/base/math.h"

namespace flaneur {

namespace {

// Where arms are bound level and hang down, so much of the way is the clavicles'.
constexpr float k_clavicle_share = 0.1f;

// Where the fingers point: the ends of the hand, less what is held, tell more than the wrist's own folds.
Vec3 fingers_of(const Character& c, const std::vector<uint8_t>& held, size_t hand, Vec3 otherwise) {
    Vec3 sum;
    for (size_t i = 0; i < c.vertices.size(); ++i) {
        Vec3 way = c.vertices[i].position - c.bind_joints[hand];
        if (c.vertices[i].joints[0] == hand && !held[i]) sum += way * dot(way, way);
    }
    return normalize_or(sum * 1e3f, otherwise);
}

// Where a vertex is in the canonical pose.
Vec3 standing(const Character& c, const CharacterVertex& v) {
    Vec3 sum;
    for (size_t n = 0; n < 4; ++n) {
        size_t j = v.joints[n];
        Vec3 p = c.body.joints[j] + rotate(c.bind_to_canonical[j], v.position - c.bind_joints[j]);
        sum += p * (float(v.weights[n]) / 255);
    }
    return sum;
}

// Turns about +y only, so that `v` heads for +z.
Quat turn_ahead(Vec3 v) {
    Vec3 level = normalize_or(Vec3{v.x, 0, v.z}, {0, 0, 1});
    return rotation_between(level, {0, 0, 1});
}

// `turn`, followed by the shortest rotation that brings `v` to `wanted`.
Quat then_towards(Quat turn, Vec3 v, Vec3 wanted) {
    return normalize(rotation_between(normalize_or(rotate(turn, v), wanted), wanted) * turn);
}

// Arms and legs straight down, feet ahead; the trunk stays as it was bound.
void set_rotations(Character& c, const std::vector<uint8_t>& held, bool has_clavicles) {
    constexpr Vec3 k_down{0, -1, 0};
    const auto& b = c.bind_joints;
    c.bind_to_canonical.fill({});
    if (has_clavicles)
        for (size_t s : {0, right_upper_arm - left_upper_arm}) {
            Vec3 arm = normalize_or(b[left_lower_arm + s] - b[left_upper_arm + s], k_down);
            float drop = k_clavicle_share * arccos(-arm.y);
            c.bind_to_canonical[left_shoulder + s] = rotation_z(s == 0 ? -drop : drop);
        }
    for (size_t s : {0, right_upper_arm - left_upper_arm}) {
        size_t upper = left_upper_arm + s, lower = left_lower_arm + s, hand = left_hand + s;
        Quat q = then_towards({}, b[lower] - b[upper], k_down);
        c.bind_to_canonical[upper] = q;
        q = then_towards(q, b[hand] - b[lower], k_down);
        c.bind_to_canonical[lower] = q;
        Vec3 fingers = fingers_of(c, held, hand, b[hand] - b[lower]);
        c.bind_to_canonical[hand] = then_towards(q, fingers, k_down);
    }
    for (size_t s : {0, right_upper_leg - left_upper_leg}) {
        size_t upper = left_upper_leg + s, lower = left_lower_leg + s, foot = left_foot + s,
               toes = left_toes + s;
        Quat q = then_towards({}, b[lower] - b[upper], k_down);
        c.bind_to_canonical[upper] = q;
        c.bind_to_canonical[lower] = then_towards(q, b[foot] - b[lower], k_down);
        c.bind_to_canonical[foot] = c.bind_to_canonical[toes] = turn_ahead(b[toes] - b[foot]);
    }
}

void set_joints(Character& c) {
    const auto& b = c.bind_joints;
    auto& j = c.body.joints;
    // The trunk on the middle plane; left and right by their mean.
    for (Joint n : {hips, spine, chest, upper_chest, neck, head}) j[n] = {0, b[n].y, b[n].z};
    auto mean = [&](int left, int right) {
        Vec3 l = b[size_t(left)], r = b[size_t(right)];
        return Vec3{std::max((l.x - r.x) * 0.5f, 0.0f), (l.y + r.y) * 0.5f, (l.z + r.z) * 0.5f};
    };
    auto mean_length = [&](int from, int to, int mirror) {
        return (length(b[size_t(to)] - b[size_t(from)]) +
                length(b[size_t(to + mirror)] - b[size_t(from + mirror)])) *
               0.5f;
    };
    constexpr int k_arm = right_shoulder - left_shoulder, k_leg = right_upper_leg - left_upper_leg;
    j[left_shoulder] = mean(left_shoulder, right_shoulder);
    Vec3 left_collar = rotate(c.bind_to_canonical[left_shoulder], b[left_upper_arm] - b[left_shoulder]);
    Vec3 right_collar = rotate(c.bind_to_canonical[right_shoulder], b[right_upper_arm] - b[right_shoulder]);
    j[left_upper_arm] = j[left_shoulder] + Vec3{(left_collar.x - right_collar.x) * 0.5f,
                                                (left_collar.y + right_collar.y) * 0.5f,
                                                (left_collar.z + right_collar.z) * 0.5f};
    j[left_lower_arm] = j[left_upper_arm] - Vec3{0, mean_length(left_upper_arm, left_lower_arm, k_arm), 0};
    j[left_hand] = j[left_lower_arm] - Vec3{0, mean_length(left_lower_arm, left_hand, k_arm), 0};

    FootShape left = foot_shape(c, left_foot, c.bind_to_canonical[left_foot]);
    FootShape right = foot_shape(c, right_foot, c.bind_to_canonical[right_foot]);
    float sole = std::max(left.sole, right.sole), tip = std::max(left.tip, right.tip);
    float thigh = mean_length(left_upper_leg, left_lower_leg, k_leg),
          shank = mean_length(left_lower_leg, left_foot, k_leg);
    Vec3 hip = mean(left_upper_leg, right_upper_leg);
    float rise = sole + shank + thigh - hip.y, shift = -hip.z;
    for (int n = hips; n <= left_hand; ++n) j[size_t(n)] += Vec3{0, rise, shift};
    j[left_upper_leg] = {hip.x, hip.y + rise, 0};
    j[left_lower_leg] = j[left_upper_leg] - Vec3{0, thigh, 0};
    j[left_foot] = j[left_lower_leg] - Vec3{0, shank, 0};
    Vec3 ball = rotate(c.bind_to_canonical[left_foot], b[left_toes] - b[left_foot]);
    Vec3 other = rotate(c.bind_to_canonical[right_foot], b[right_toes] - b[right_foot]);
    j[left_toes] = j[left_foot] + Vec3{0, (ball.y + other.y) * 0.5f, (ball.z + other.z) * 0.5f};
    for (auto [from, to] :
         {std::pair{int(left_shoulder), int(right_shoulder)}, {left_upper_leg, right_upper_leg}})
        for (int n = 0; n < 4; ++n) {
            Vec3 p = j[size_t(from + n)];
            j[size_t(to + n)] = {-p.x, p.y, p.z};
        }
    c.body.heel = std::max({left.heel, right.heel, 0.01f});
    c.body.toe = std::max(tip - (j[left_toes].z - j[left_foot].z), 0.01f);
}

bool is_arm(int joint) { return joint >= left_shoulder && joint <= right_hand; }

// How far trunk and legs reach to a side at each height, beside the arms.
struct Outline {
    static constexpr int k_rows = 64;
    float height;
    std::array<float, k_rows> side{};

    int row(float y) const { return int(clamp(y / height, 0, 0.999f) * k_rows); }
};

Outline outline_of(const Character& c, float height, const std::vector<Vec3>& places, float mirror) {
    Outline outline{height, {}};
    float depth = c.body.joints[left_upper_arm].z, band = 0.1f * height;
    for (size_t i = 0; i < c.lods[0].size(); ++i) {
        uint32_t from = c.lods[0][i], to = c.lods[0][i % 3 == 2 ? i - 2 : i + 1];
        if (is_arm(c.vertices[from].joints[0]) || is_arm(c.vertices[to].joints[0])) continue;
        constexpr int k_steps = 16;
        for (int n = 0; n <= k_steps; ++n) {
            Vec3 p = lerp(places[from], places[to], float(n) / k_steps);
            if (p.z < depth - band || p.z > depth + band) continue;
            float& side = outline.side[size_t(outline.row(p.y))];
            side = std::max(side, p.x * mirror);
        }
    }
    return outline;
}

// The least angle away from the body at which forearms and hands are clear of hips, skirt and ground; if they
// never are, the one at which they are nearest to it.
float clear_carriage(const Character& c, const std::vector<uint8_t>& held) {
    constexpr float k_step = 0.02f, k_most = 0.7f;
    constexpr float k_inward = 0.1f;  // what a bent forearm goes inward, of its length
    float height = canonical_extent(c).second;
    std::vector<Vec3> places;
    for (const CharacterVertex& v : c.vertices) places.push_back(standing(c, v));
    std::array<Outline, 2> outlines = {outline_of(c, height, places, 1), outline_of(c, height, places, -1)};
    Vec3 shoulder = c.body.joints[left_upper_arm];
    float elbow = c.body.joints[left_lower_arm].y, best = 0, least = 1e9f;
    for (float angle = 0; angle <= k_most; angle += k_step) {
        SinCos turn = sin_cos(angle);
        float worst = -1e9f;
        for (uint32_t i : c.lods[0]) {
            int joint = c.vertices[i].joints[0];
            bool left = joint == left_lower_arm || joint == left_hand;
            if (held[i] || (!left && joint != right_lower_arm && joint != right_hand)) continue;
            Vec3 p = places[i];
            float x = (left ? p.x : -p.x) - shoulder.x, y = p.y - shoulder.y;
            float out = shoulder.x + x * turn.cosine - y * turn.sine - k_inward * std::max(elbow - p.y, 0.0f);
            float level = shoulder.y + y * turn.cosine + x * turn.sine;
            const Outline& outline = outlines[left ? 0 : 1];
            worst = std::max({worst, outline.side[size_t(outline.row(level))] - out, 0.05f * height - level});
        }
        if (worst < least) least = worst, best = angle;
        if (worst <= 0) break;
    }
    return best;
}

}  // namespace

FootShape foot_shape(const Character& c, int ankle, Quat turn) {
    FootShape shape;
    bool found = false;
    auto measure = [&](auto&& belongs) {
        for (const CharacterVertex& v : c.vertices) {
            Vec3 p = rotate(turn, v.position - c.bind_joints[size_t(ankle)]);
            if (v.weights[0] < 128 || !belongs(v.joints[0], p)) continue;
            found = true;
            shape.sole = std::max(shape.sole, -p.y);
            shape.heel = std::max(shape.heel, -p.z);
            shape.tip = std::max(shape.tip, p.z);
        }
    };
    measure([&](int joint, Vec3) { return joint == ankle || joint == ankle + 1; });
    // A foot without a joint of its own is the lowest part of the shin.
    if (!found) measure([&](int joint, Vec3 p) { return joint == ankle - 1 && p.y < 0; });
    return shape;
}

void bend_feet(Character& c, const std::array<bool, 2>& sides) {
    float blend = 0.01f * c.bind_joints[head].y;
    for (CharacterVertex& v : c.vertices) {
        int side = v.joints[0] == left_foot ? 0 : v.joints[0] == right_foot ? 1 : -1;
        if (side < 0 || !sides[size_t(side)]) continue;
        size_t toes = side == 0 ? left_toes : right_toes;
        float share = clamp(0.5f + (v.position.z - c.bind_joints[toes].z) / (2 * blend), 0, 1);
        std::array<float, k_joint_count> weights{};
        for (size_t n = 0; n < 4; ++n) weights[v.joints[n]] += float(v.weights[n]) / 255;
        weights[toes] += weights[toes - 1] * share;
        weights[toes - 1] *= 1 - share;
        pack_weights(weights, v);
    }
}

// Vertices of trunk and thighs in the canonical pose, without hair.
static std::vector<Vec3> trunk_of(const Character& c) {
    std::vector<Vec3> surface;
    for (uint32_t i : c.lods[0]) {
        const CharacterVertex& v = c.vertices[i];
        const size_t j = v.joints[0];
        if (v.tint == Tint::hair || !is_of_trunk(int(j))) continue;
        surface.push_back(c.body.joints[j] + rotate(c.bind_to_canonical[j], v.position - c.bind_joints[j]));
    }
    return surface;
}

void set_body(Character& c, const std::vector<uint8_t>& held, bool has_clavicles) {
    set_rotations(c, held, has_clavicles);
    set_joints(c);
    c.body.carriage = clear_carriage(c, held);
    c.body.girth = measure_girth(c.body, trunk_of(c));
}

// The lowest that a leg's vertex, and the highest that any but a hand's, stands in the canonical pose.
std::pair<float, float> canonical_extent(const Character& c) {
    float low = 1e9f, high = -1e9f;
    for (uint32_t i : c.lods[0]) {
        const CharacterVertex& v = c.vertices[i];
        float y = standing(c, v).y;
        if (v.joints[0] >= left_upper_leg) low = std::min(low, y);
        if (v.joints[0] != left_hand && v.joints[0] != right_hand) high = std::max(high, y);
    }
    return {low, high};
}

}  // namespace flaneur
