// The bodies of those who do something where they stay, or on the way.
#include <algorithm>

#include "sim/base/math.h"
#include "sim/base/spans.h"
#include "sim/base/tick.h"
#include "sim/pastimes/choose.h"
#include "sim/pastimes/handheld.h"
#include "sim/pastimes/seated.h"
#include "sim/pastimes/standing.h"

namespace flaneur {

namespace {

float seconds_since(uint32_t tick, uint32_t began) { return static_cast<float>(tick - began) * k_tick; }

void come_nearer(float& value, float to, float most) { value += clamp(to - value, -most, most); }

// Where the gait has a foot. Its pose's own may be late, held back by one that it had as it sat.
FootAt gait_foot(const PastimeTick& t, const BodyPose& pose, Someone who, uint32_t walker, Side side) {
    constexpr float k_same = 0.02f, k_other = 0.05f;  // metres
    const FootAt posed = foot_of(pose, who, side);
    const FootBlock& foot = t.gait.blocks[walker / k_block].feet[side];
    const size_t lane = walker % k_block;
    if (foot.swinging[lane] != 0) return posed;
    const float ankle = who.person.joints[left_foot][1][lane];
    const FootAt stands{{foot.to.x[lane], foot.to.y[lane] + ankle, foot.to.z[lane]}, foot.to.yaw[lane], 0};
    const float off = smoothstep(k_same, k_other, length(stands.ankle - posed.ankle));
    return {lerp(posed.ankle, stands.ankle, off), posed.yaw + wrap_angle(stands.yaw - posed.yaw) * off,
            lerp(posed.down, 0, off)};
}

// 0 as it stands .. 1 as it stays there.
float share_of(const Pastime& p, uint32_t tick, float lasts) {
    const float since = seconds_since(tick, p.began) / lasts;
    switch (p.phase) {
        case StayPhase::begins:
            return clamp(since, 0, 1);
        case StayPhase::stays:
            return 1;
        case StayPhase::ends:
            return 1 - clamp(since, 0, 1);
        default:
            return 0;
    }
}

// Each a little after another.
void breathe_by_itself(const PastimeTick& t, const Pastime& p, float share, BodyPose& pose) {
    breathe(pose, static_cast<float>(t.tick) * k_tick + static_cast<float>(p.walker % 16), share);
}

void pose_seated(const PastimeTick& t, const Pastime& p, Someone who, BodyPose& pose) {
    constexpr float k_shifts = 1.6f;  // seconds
    const float share = share_of(p, t.tick, k_sits_down);
    if (share <= 0) return;
    const float shifted = seconds_since(t.tick, p.posture_began) / k_shifts;
    const BodyPose seated = shifted < 1 ? sitting_otherwise(p.before, p.now, who, shifted) : p.now;
    if (share >= 1) {
        pose = seated;
    } else {
        const FootAt stands[2] = {gait_foot(t, pose, who, p.walker, k_left),
                                  gait_foot(t, pose, who, p.walker, k_right)};
        pose = sitting_down(pose, stands, seated, who, share * k_sits_down);
    }
    breathe_by_itself(t, p, share, pose);
}

void pose_leaning(const PastimeTick& t, const Pastime& p, Someone who, BodyPose& pose) {
    const float share = share_of(p, t.tick, k_leans_back);
    if (share <= 0) return;
    const FootAt stands[2] = {gait_foot(t, pose, who, p.walker, k_left),
                              gait_foot(t, pose, who, p.walker, k_right)};
    pose = leaning_back(pose, stands, who, {p.at, p.facing}, p.posture % 3, share);
    breathe_by_itself(t, p, share, pose);
}

// From the pose in which it came to stand there: the gait may step meanwhile.
void pose_leaning_out(const PastimeTick& t, const Pastime& p, Someone who, BodyPose& pose) {
    const float share = share_of(p, t.tick, k_leans_out), u = bell(share);
    if (share <= 0) return;
    FootAt stands[2];
    for (const Side side : {k_left, k_right}) {
        const FootAt now = gait_foot(t, pose, who, p.walker, side), stood = foot_of(p.now, who, side);
        stands[side] = {lerp(now.ankle, stood.ankle, u), now.yaw + wrap_angle(stood.yaw - now.yaw) * u,
                        lerp(now.down, stood.down, u)};
    }
    const Railing& rail = t.pastimes.places.railings[p.place];
    const Vec2 along{-rail.facing.z, rail.facing.x};
    const float aside = dot(p.to - on_ground(rail.at), along);
    pose = leaning_out(mixed(pose, p.now, u), stands, who,
                       {rail.at + at_height(along * aside, 0), rail.facing}, p.posture, share);
}

// About where the eyes of another are, who may sit.
Vec3 eyes_of(const PastimeTick& t, uint32_t whom) {
    constexpr float k_standing = 0.9f, k_over_hips = 0.4f;  // heights
    const float height = t.gait.people[whom / k_block].height[whom % k_block];
    const Pastime* other = own_of(t.pastimes.all, whom);
    const bool sits = other && other->what == Staying::sits && other->phase == StayPhase::stays;
    return sits ? other->now.hips + Vec3{0, k_over_hips * height, 0}
                : t.crowd.motion.position[whom] + Vec3{0, k_standing * height, 0};
}

// Where it looks, if anywhere.
struct Look {
    HeadTurn turn{};
    bool is = false;
};
Look look_of(const PastimeTick& t, const Pastime& p, Someone who, const BodyPose& pose, float out) {
    if (p.phone == PhoneUse::texts && out > 0.3f) {
        // Against the chest; who leans back has it nearer.
        const Vec3 up = rotate(pose.rotation[upper_chest], {0, 1, 0});
        const Vec3 ahead = rotate(pose.rotation[upper_chest], {0, 0, 1});
        const float leant = arctan2(ahead.y, up.y);
        return {{0, -k_reads_down - leant}, true};
    }
    Vec3 place;
    const bool is_there_now = p.phase == StayPhase::begins || p.phase == StayPhase::stays;
    const bool has_place = (p.what == Staying::looks || p.what == Staying::photographs ||
                            p.what == Staying::marvels || p.what == Staying::leans_out) &&
                           is_there_now;
    if (has_place || (p.what == Staying::glances && p.phase == StayPhase::stays)) {
        place = p.at;
    } else if (p.whom != k_nobody && p.phase == StayPhase::stays) {
        place = eyes_of(t, p.whom);
    } else {
        return {};
    }
    const HeadTurn turn = turn_to_look(pose, who.person, who.lane, place);
    return {turn, turn.yaw != 0 || turn.pitch != 0};
}

void turn_to(Pastime& p, const Look& look, float dt, BodyPose& pose) {
    constexpr float k_turns = 2.6f, k_heeds = 1 / 0.4f;  // rad/s; 1/s
    if (look.is) {
        come_nearer(p.gaze.yaw, look.turn.yaw, k_turns * dt);
        come_nearer(p.gaze.pitch, look.turn.pitch, k_turns * dt);
    }
    come_nearer(p.heed, look.is ? 1 : 0, k_heeds * dt);
    if (p.heed == 0) p.gaze = {};
    if (p.heed > 0) turn_head(pose, p.gaze, smoothstep(0, 1, p.heed));
}

void pose_pastime(const PastimeTick& t, Pastime& p, float dt) {
    constexpr float k_bows = 0.16f;  // radians of the back, of who looks closely
    const float out = phone_out(p, t.tick);
    const bool is_body = (p.what == Staying::sits || p.what == Staying::leans || p.what == Staying::looks ||
                          p.what == Staying::leans_out) &&
                         p.phase != StayPhase::comes && p.phase != StayPhase::over;
    const bool looks = p.what != Staying::nowhere && p.phase == StayPhase::stays;
    if (!is_body && !looks && out == 0 && p.heed == 0) return;
    const Someone who{t.gait.people[p.walker / k_block], static_cast<int>(p.walker % k_block)};
    BodyPose pose = body_pose_of(t.poses, p.walker);
    if (p.what == Staying::sits) pose_seated(t, p, who, pose);
    if (p.what == Staying::leans) pose_leaning(t, p, who, pose);
    if (p.what == Staying::leans_out) pose_leaning_out(t, p, who, pose);
    if (p.what == Staying::looks && p.phase == StayPhase::stays) {
        const float since = seconds_since(t.tick, p.began), left = seconds_since(p.until, t.tick);
        lean_trunk(pose, k_bows * bell(clamp((since - 1) / 1.5f, 0, 1)) * bell(clamp(left / 1.2f, 0, 1)));
    }
    const Look look = look_of(t, p, who, pose, out);
    turn_to(p, look, dt, pose);
    const int32_t free = who.person.free_hands[who.lane];
    const bool both =
        free == 3 && (p.walker % 5 < 2 || p.what == Staying::sits || p.phone != PhoneUse::texts);
    hold_phone(pose, who, p.phone, out, both, seconds_since(t.tick, p.phone_began));
    set_body_pose(t.poses, who.person, p.walker, pose);
}

}  // namespace

void pose_pastimes(const PastimeTick& t, size_t begin, size_t end) {
    if (t.pastimes.all.empty()) return;
    const Span own = span_of(t.pastimes.all, begin, end);
    const uint32_t ticks = ticks_due(t.crowd, begin / k_block, t.tick);
    const float dt = static_cast<float>(std::max(ticks, 1u)) * k_tick;
    for (size_t k = own.begin; k < own.end; ++k) pose_pastime(t, t.pastimes.all[k], dt);
}

std::optional<JointPose> phone_of(const Pastimes& all, const Gait& gait, uint32_t walker, uint32_t tick,
                                  const JointPose& right_hand) {
    constexpr float k_drawn = 0.35f;  // of the way out of the pocket
    const Pastime* p = own_of(all.all, walker);
    if (!p || phone_out(*p, tick) < k_drawn) return std::nullopt;
    const PersonBlock& person = gait.people[walker / k_block];
    if (person.free_hands[walker % k_block] == 1) return std::nullopt;  // has its own
    return phone_in_hand(right_hand, {person, static_cast<int>(walker % k_block)});
}

}  // namespace flaneur
