#include "sim/navigation/string_pulling.h"

namespace flaneur {

static bool is_same(Vec3 a, Vec3 b) {
    constexpr float k_same = 1e-3f;  // metres
    return length_squared(on_ground(a - b)) <= k_same * k_same;
}

namespace {
// One side of the funnel, and the doorway that bounds it there.
struct Side {
    Vec3 end;
    size_t at = 0;
};
}  // namespace

// A funnel that gets narrower from doorway to doorway (Lee and Preparata 1984); where it would turn over, the
// string lies about the end of one side, and a new funnel begins.
int pull_string(std::span<const Doorway> doorways, Vec3 from, Vec3 to, Vec3* corners, int capacity) {
    int count = 0;
    Vec3 apex = from;
    Side left{apex}, right{apex};
    auto turn_about = [&](const Side& side) {
        const Side corner = side;
        if (!is_same(corner.end, apex)) corners[count++] = corner.end;
        apex = corner.end;
        left = right = corner;
        return corner.at;
    };
    for (size_t i = 0; i <= doorways.size() && count < capacity; ++i) {
        const Doorway doorway = i < doorways.size() ? doorways[i] : Doorway{to, to};
        const Vec2 to_left = on_ground(doorway.left - apex), to_right = on_ground(doorway.right - apex);
        if (cross(on_ground(right.end - apex), to_right) <= 0) {
            if (right.end == apex || cross(on_ground(left.end - apex), to_right) > 0) {
                right = {doorway.right, i};
            } else {
                i = turn_about(left);
                continue;
            }
        }
        if (cross(on_ground(left.end - apex), to_left) >= 0) {
            if (left.end == apex || cross(on_ground(right.end - apex), to_left) < 0) {
                left = {doorway.left, i};
            } else {
                i = turn_about(right);
            }
        }
    }
    if (count == capacity) return count;
    if (count > 0 && is_same(corners[count - 1], to)) --count;
    corners[count++] = to;
    return count;
}

}  // namespace flaneur
