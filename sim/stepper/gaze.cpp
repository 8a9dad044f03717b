#include "sim/stepper/gaze.h"

#include "sim/base/math.h"
#include "sim/pose/arm.h"

namespace flaneur {

void turn_heads(const Bipeds& bipeds, std::vector<PoseBlock>& poses) {
    constexpr float k_neck = 0.4f;  // of the whole
    for (size_t i = 0; i < bipeds.all.size(); ++i) {
        const Biped& b = bipeds.all[i];
        if (b.gaze == Vec2{} || b.is_down != 0) continue;
        Posed pose{poses[bipeds.walkers[i] / k_block], bipeds.walkers[i] % k_block};
        const Quat body = rotation_y(b.heading);
        auto turned = [&](float share) {
            // About the body's own axes; up is a turn of the nose towards +y.
            const Quat turn = rotation_y(b.gaze.x * share) * rotation_x(-b.gaze.z * share);
            return body * turn * conjugate(body);
        };
        const Vec3 at = pose.place_os(neck), to_head = pose.place_os(head) - at;
        const Quat by = turned(k_neck);
        pose.set(neck, at, by * pose.rotation(neck));
        pose.set(head, at + rotate(by, to_head), turned(1) * pose.rotation(head));
    }
}

}  // namespace flaneur
