// Bodies that fall as physics has it: energy that is lost and never won, ground that holds, joints that stay
// together and within their limits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/base/tick.h"
#include "sim/fall/fall.h"
#include "sim/fall/lane.h"
#include "sim/gait/gait.h"

namespace flaneur {
namespace {

// Sixteen people who stand at the origin of level ground.
struct Sixteen {
    Gait gait;
    std::vector<PoseBlock> poses;
    Segments segments[k_block];
    TumbleShapes shapes;
    TumbleBlock block;
    TumbleAims aims;
    TumblePlanes planes;
    Residue residue[k_block];
};

std::optional<GroundHit> level(Vec3 point, float up, float down) {
    if (point.y + up < 0 || point.y - down > 0) return std::nullopt;
    return GroundHit{};
}
void ask_level(const void*, std::span<const Vec3> points, float up, float down,
               std::optional<GroundHit>* hits) {
    for (size_t i = 0; i < points.size(); ++i) hits[i] = level(points[i], up, down);
}
const Surroundings k_level{nullptr, ask_level, nullptr};

// Nothing is tried; joints are a little stiff.
void go_limp(TumbleAims& aims, int lane) {
    for (int s = 0; s < k_segment_count; ++s) {
        set_row(aims.turn[s], lane, Quat{});
        aims.haste[s][lane] = 0, aims.drag[s][lane] = 4;
    }
}

std::unique_ptr<Sixteen> sixteen(uint64_t seed) {
    auto s = std::make_unique<Sixteen>();
    std::vector<Body> bodies;
    std::vector<uint32_t> of(k_block);
    std::vector<float> scale(k_block, 1.0f), heading(k_block), rate(k_block, 0.0f);
    std::vector<Vec3> place(k_block, Vec3{});
    std::vector<Vec2> still(k_block, Vec2{});
    for (uint32_t i = 0; i < k_block; ++i) {
        const RandomKey key{seed, i, 0, Purpose::body};
        bodies.push_back(standard_body(random_between(key, 1.1f, 1.95f, 0)));
        of[i] = i;
        heading[i] = random_between(key, -k_pi, k_pi, 1);
    }
    const RootMotion root{place.data(), still.data(), heading.data(), rate.data()};
    start_gait(s->gait, k_block, bodies, of.data(), scale.data(), root, k_level, seed);
    s->poses.resize(1);
    pose_blocks(s->gait, 0, 1, s->poses);
    for (int i = 0; i < k_block; ++i) {
        s->segments[i] = segments_of(s->gait.people[0], i);
        set_shape(s->shapes, i, s->segments[i]);
        const BodyPose now = body_pose_of(s->poses, i);
        s->residue[i] =
            take_over(s->block, i, s->segments[i], s->gait.people[0], i, now, now, k_tick, Vec3{});
        go_limp(s->aims, i);
    }
    return s;
}

void push(Sixteen& s, int lane, Vec2 speed) {
    for (int i = 0; i < k_segment_count; ++i) {
        s.block.velocity[i][0][lane] += speed.x;
        s.block.velocity[i][2][lane] += speed.z;
    }
}

void tick(Sixteen& s) {
    s.planes.has_walls = 0;
    for (int i = 0; i < k_block; ++i) find_planes(s.planes, i, s.block, s.shapes, Vec3{}, k_level, 0);
    tumble(s.shapes, s.aims, s.planes, k_tick, s.block);
}

// Metres that segments are apart where they join, at most.
float widest_gap(const Sixteen& s, int lane) {
    float most = 0;
    auto place = [&](int i, Vec3 from) {
        const auto& q = s.block.rotation[i];
        return row_of(s.block.place[i], lane) +
               rotate(Quat{q[0][lane], q[1][lane], q[2][lane], q[3][lane]}, from);
    };
    for (int i = 1; i < k_segment_count; ++i)
        most = std::max(most, length(place(i, s.segments[lane].pivot[i]) -
                                     place(k_segments[i].parent, s.segments[lane].socket[i])));
    return most;
}

TEST(Tumble, LosesEnergyAndNeverWinsAny) {
    float most_won = 0, widest = 0, deepest = 0, last = 0;
    for (uint64_t seed = 1; seed <= 6; ++seed) {
        auto s = sixteen(seed);
        for (int i = 0; i < k_block; ++i) {
            const RandomKey key{seed, static_cast<uint32_t>(i), 0, Purpose::touch};
            push(*s, i, heading_direction(random_between(key, -k_pi, k_pi)) * random_between(key, 0, 3, 1));
        }
        float had[k_block], first[k_block], won[k_block] = {};
        for (int i = 0; i < k_block; ++i) had[i] = first[i] = energy_of(s->block, s->segments[i], i);
        for (int t = 0; t < 300; ++t) {
            tick(*s);
            for (int i = 0; i < k_block; ++i) {
                const float has = keep_energy(s->block, s->segments[i], i, had[i]);
                ASSERT_TRUE(std::isfinite(has));
                won[i] += std::max(has - had[i], 0.0f);
                had[i] = has;
                widest = std::max(widest, widest_gap(*s, i));
                for (int k = 0; k < k_ball_count; ++k) {
                    const Segment g = k_segment_of_ball[k];
                    const auto& q = s->block.rotation[g];
                    const Vec3 middle =
                        row_of(s->block.place[g], i) +
                        rotate(Quat{q[0][i], q[1][i], q[2][i], q[3][i]}, row_of(s->shapes.ball[k], i));
                    if (t > 20) deepest = std::max(deepest, s->shapes.radius[k][i] - middle.y);
                }
            }
        }
        for (int i = 0; i < k_block; ++i) most_won = std::max(most_won, won[i] / first[i]);
        for (int i = 0; i < k_block; ++i) last = std::max(last, liveliness(s->block, s->shapes, i));
    }
    std::printf(
        "wins %.4f of what it had in all ticks that it does, joints %.4f m apart, balls %.4f m in the "
        "ground, %.3f m/s at the end\n",
        static_cast<double>(most_won), static_cast<double>(widest), static_cast<double>(deepest),
        static_cast<double>(last));
    EXPECT_LT(most_won, 0.01f);
    EXPECT_LT(widest, 0.02f);
    EXPECT_LT(deepest, 0.02f);
    EXPECT_LT(last, 1);
}

TEST(Tumble, ComesToRestWithMusclesAtWork) {
    float slowest = 0;
    int late = 0;
    for (uint64_t seed = 1; seed <= 6; ++seed) {
        auto s = sixteen(seed);
        std::array<Quat, k_segment_count> stood[k_block];
        Vec2 to[k_block];
        float lain[k_block] = {}, rests[k_block] = {}, energy[k_block] = {};
        for (int i = 0; i < k_block; ++i) {
            const RandomKey key{seed, static_cast<uint32_t>(i), 0, Purpose::touch};
            to[i] = heading_direction(random_between(key, -k_pi, k_pi));
            stood[i] = turns_of(s->block, i);
            push(*s, i, to[i] * random_between(key, 1, 3, 1));
        }
        for (int t = 0; t < 300; ++t) {
            for (int i = 0; i < k_block; ++i)
                aim_fall(s->aims, i, s->block, stood[i], to[i], static_cast<float>(t) * k_tick, lain[i]);
            tick(*s);
            for (int i = 0; i < k_block; ++i) {
                if (lain[i] > 0.8f) calm(s->block, i, 0.93f);
                energy[i] = keep_energy(s->block, s->segments[i], i, lain[i] > 0 ? energy[i] : 1e9f);
                if (lain[i] > 0 || is_down(s->block, s->shapes, s->planes, i)) lain[i] += k_tick;
                if (liveliness(s->block, s->shapes, i) > 0.12f) rests[i] = static_cast<float>(t) * k_tick;
            }
        }
        for (float at : rests) {
            slowest = std::max(slowest, at);
            late += at > 2.5f;
        }
    }
    std::printf("at rest after %.2f s at most\n", static_cast<double>(slowest));
    std::printf("%d of 96 later than 2.5 s\n", late);
    EXPECT_LT(late, 24);
}

}  // namespace
}  // namespace flaneur
