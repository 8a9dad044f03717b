#include "tools/flaneur/view/path.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/base/math.h"
#include "tools/flaneur/view/camera.h"
#include "tools/flaneur/view/rig.h"

namespace flaneur {
namespace {

// From a to b in `span` seconds, leaving and arriving so fast; `share` of the time has gone by.
double cubic(double a, double b, double leaving, double arriving, double span, double share) {
    const double t = share, t2 = t * t, t3 = t2 * t;
    return (2 * t3 - 3 * t2 + 1) * a + (t3 - 2 * t2 + t) * span * leaving + (3 * t2 - 2 * t3) * b +
           (t3 - t2) * span * arriving;
}

// How fast a value passes a key between two others: Catmull and Rom's, or, so that nothing overshoots, at
// most three times the slower change about it, and not at all where it turns.
double passing(double before, double here, double after, double to_here, double from_here, bool is_monotone) {
    const double in = (here - before) / to_here, out = (after - here) / from_here;
    if (is_monotone && in * out <= 0) return 0;
    const double middle = (in * from_here + out * to_here) / (to_here + from_here);
    if (!is_monotone) return middle;
    const double most = 3 * std::min(std::fabs(in), std::fabs(out));
    return std::clamp(middle, -most, most);
}

// Long stretches beside short ones do not swing out: a place is passed so fast at most that it would take the
// longer stretch's time for three times the shorter one's length.
double most_passing(const CameraKey& before, const CameraKey& here, const CameraKey& after) {
    constexpr double k_swing = 3;
    const float shorter = std::min(length(here.eye - before.eye), length(after.eye - here.eye));
    return k_swing * static_cast<double>(shorter) / std::max(here.time - before.time, after.time - here.time);
}

constexpr size_t k_places = 3;  // values of a key: x, y, z; then heading, pitch, lens
using KeyValues = std::array<double, 6>;

// A speed among places.
void hold_back(KeyValues& speed, double most) {
    const double now = std::hypot(speed[0], speed[1], speed[2]);
    if (now <= most) return;
    for (size_t i = 0; i < k_places; ++i) speed[i] *= most / now;
}

// Headings go on from `before` the shorter way round.
KeyValues values_of(const CameraKey& key, double before) {
    Camera camera = make_camera(key.eye, key.target);
    const Gaze gaze = gaze_of(camera);
    const double yaw = before + static_cast<double>(wrap_angle(gaze.yaw - static_cast<float>(before)));
    return {static_cast<double>(key.eye.x),  static_cast<double>(key.eye.y),
            static_cast<double>(key.eye.z),  yaw,
            static_cast<double>(gaze.pitch), static_cast<double>(key.fov)};
}

Camera camera_of(const KeyValues& v) {
    auto f = [&](size_t i) { return static_cast<float>(v[i]); };
    return camera_of(Gaze{{f(0), f(1), f(2)}, f(3), f(4), f(5)});
}

}  // namespace

CameraKey key_of(const Camera& camera, double time) {
    return {time,
            {camera.eye.x, camera.eye.y, camera.eye.z},
            {camera.target.x, camera.target.y, camera.target.z},
            camera.vertical_fov};
}

double duration(const CameraPath& path) {
    return path.keys.empty() ? 0 : path.keys.back().time - path.keys.front().time;
}

Camera camera_at(const CameraPath& path, double seconds) {
    const std::vector<CameraKey>& keys = path.keys;
    auto rest = [](const CameraKey& key) {
        Camera camera = make_camera(key.eye, key.target);
        camera.vertical_fov = key.fov;
        return camera;
    };
    const double time = keys.front().time + seconds;
    if (time <= keys.front().time) return rest(keys.front());
    if (time >= keys.back().time) return rest(keys.back());
    const auto next =
        static_cast<size_t>(std::upper_bound(keys.begin(), keys.end(), time,
                                             [](double t, const CameraKey& key) { return t < key.time; }) -
                            keys.begin());
    // The keys about this stretch; beyond both ends of the path there are none.
    const size_t a = next - 1, b = next;
    const bool has_before = a > 0, has_after = b + 1 < keys.size();
    const KeyValues from = values_of(keys[a], 0), to = values_of(keys[b], from[k_places]);
    const KeyValues before = has_before ? values_of(keys[a - 1], from[k_places]) : from;
    const KeyValues after = has_after ? values_of(keys[b + 1], to[k_places]) : to;
    const double span = keys[b].time - keys[a].time;
    const double share = (time - keys[a].time) / span;
    KeyValues leaving{}, arriving{}, now;
    for (size_t i = 0; i < now.size(); ++i) {
        const bool is_monotone = i >= k_places;
        if (has_before)
            leaving[i] =
                passing(before[i], from[i], to[i], keys[a].time - keys[a - 1].time, span, is_monotone);
        if (has_after)
            arriving[i] =
                passing(from[i], to[i], after[i], span, keys[b + 1].time - keys[b].time, is_monotone);
    }
    if (has_before) hold_back(leaving, most_passing(keys[a - 1], keys[a], keys[b]));
    if (has_after) hold_back(arriving, most_passing(keys[a], keys[b], keys[b + 1]));
    for (size_t i = 0; i < now.size(); ++i)
        now[i] = cubic(from[i], to[i], leaving[i], arriving[i], span, share);
    return camera_of(now);
}

}  // namespace flaneur
