#include "tools/flaneur/sheets/strip.h"

#include <algorithm>
#include <cmath>

#include "assets/outfit.h"
#include "sim/base/levels.h"
#include "sim/base/math.h"
#include "sim/crowd/locomotion.h"
#include "tools/extract/convert.h"
#include "tools/flaneur/gait/measure.h"
#include "tools/flaneur/output/output.h"
#include "tools/flaneur/view/show.h"

namespace flaneur {

namespace {

constexpr uint32_t k_moments = 12;
constexpr uint32_t k_width = 240, k_height = 420;              // pixels of one
constexpr double k_stand = 1, k_steady = 5, k_turn = 2.7;      // seconds: stands; then turns; shown of a turn
constexpr float k_begin = 9;                                   // metres: where stairs, slopes and kerbs begin
constexpr float k_near = -60, k_far = 600, k_half_width = 10;  // metres, of the ground

// A walk somewhere, and the ticks that are shown.
struct Take {
    Ground ground;
    Walk walk;
    double first = 0, last = 0;
};

// The upright face of each step between the levels of a strip of ground.
void add_risers(Ground& ground, const std::function<float(float)>& height, const std::vector<float>& edges) {
    for (size_t i = 1; i + 1 < edges.size(); ++i) {
        float z = edges[i];
        float before = height((edges[i - 1] + z) / 2), after = height((z + edges[i + 1]) / 2);
        Vec3 left{k_half_width, std::min(before, after), z}, right = left - Vec3{2 * k_half_width, 0, 0};
        if (after < before) std::swap(left, right);
        float top = std::max(before, after);
        ground.faces.push_back({left, right, top, top, FaceKind::riser});
    }
}

Ground ground_of(const GaitOptions& gait) {
    std::vector<float> edges{k_near};
    std::function<float(float)> height = [](float) { return 0.0f; };
    bool stepped = !gait.stairs.empty() || gait.kerb != 0;
    if (!gait.stairs.empty()) {
        constexpr int k_steps = 40;
        auto rise = static_cast<float>(gait.stairs == "up" ? gait.riser : -gait.riser);
        auto run = static_cast<float>(gait.tread);
        for (int i = 0; i < k_steps; ++i) edges.push_back(k_begin + static_cast<float>(i) * run);
        height = [=](float z) { return clamp(std::floor((z - k_begin) / run) + 1, 0, k_steps) * rise; };
    } else if (gait.slope != 0) {
        constexpr float k_length = 60;
        edges.insert(edges.end(), {k_begin, k_begin + k_length});
        auto grade = static_cast<float>(gait.slope / 100);
        height = [=](float z) { return clamp(z - k_begin, 0, k_length) * grade; };
    } else if (gait.kerb != 0) {
        edges.push_back(k_begin);
        auto kerb = static_cast<float>(gait.kerb);
        height = [=](float z) { return z > k_begin ? kerb : 0; };
    }
    edges.push_back(k_far);
    Ground ground = strip(height, edges, stepped, gait.stairs.empty() ? Surface::sidewalk : Surface::steps);
    if (stepped) add_risers(ground, height, edges);
    if (gait.wall > 0) {
        auto x = static_cast<float>(gait.wall);
        ground.faces.push_back({{x, 0, k_near}, {x, 0, k_far}, 2.4f, 2.4f, FaceKind::garden_wall});
    }
    index_ground(ground);
    return ground;
}

Take make_take(const GaitOptions& gait, const Person& person, double speed) {
    Vec2 onward{0, static_cast<float>(speed)};
    Vec2 turned = heading_direction(static_cast<float>(gait.turn) * k_radians) * onward.z;
    float from = k_begin + (gait.kerb != 0 ? -0.9f : 4 * static_cast<float>(gait.tread));
    Take take;
    take.ground = ground_of(gait);
    double seconds = k_steady + k_turn + static_cast<double>(from / stair_speed(onward.z)) + 3;
    take.walk = walk(take.ground, person, seconds, [&](double t) {
        return t < k_stand ? Vec2{} : gait.turn != 0 && t >= k_steady ? turned : onward;
    });
    const std::vector<Instant>& ticks = take.walk.ticks;
    if (gait.turn != 0) {
        take.first = (k_steady - 0.3) * take.walk.rate;
        take.last = take.first + k_turn * take.walk.rate;
        return take;
    }
    auto there = std::find_if(ticks.begin(), ticks.end(), [&](const Instant& i) { return i.root.z >= from; });
    auto tick = static_cast<size_t>(there - ticks.begin());
    take.first = static_cast<double>(tick);
    take.last = take.first + take.walk.rate;
    for (const MeasuredStride& stride : strides(take.walk, tick, ticks.size())) {
        if (stride.side != k_left) continue;
        take.first = stride.begin;
        take.last = stride.end;
        break;
    }
    return take;
}

// Keeps at the person's middle, as tall as the ground on the whole is; far away, so that nothing is much
// nearer.
Camera camera_on(const Take& take, const Instant& now, double moment, StripView view) {
    const std::vector<Instant>& ticks = take.walk.ticks;
    float climbed = lerp(ticks[static_cast<size_t>(take.first)].root.y,
                         ticks[static_cast<size_t>(take.last)].root.y, static_cast<float>(moment));
    constexpr float k_away = 12;
    float tall = take.walk.body.height;
    Vec3 target{now.root.x, climbed + 0.47f * tall, now.root.z};
    Vec3 away = view == StripView::side ? Vec3{-k_away, 0.6f, 0} : Vec3{0, 0.6f, k_away};
    Camera camera;
    camera.eye = to_glm(target + away);
    camera.target = to_glm(target);
    camera.vertical_fov = 2 * std::atan(0.64f * tall / k_away);
    return camera;
}

FrameInput frame_of(const Take& take, const Character& character, uint64_t style, double moment,
                    StripView view, PeopleFrame& people) {
    auto tick = static_cast<size_t>(std::lround(take.first + moment * (take.last - take.first)));
    const Instant& now = take.walk.ticks[std::min(tick, take.walk.ticks.size() - 1)];
    people.walkers.resize(1);
    people.palette.resize(k_palette_joints);
    pose_character(character, 1, now.joints.data(), people.palette.data());
    WalkerDraw& draw = people.walkers[0];
    draw.centre = to_glm(place(now, hips));
    draw.radius = k_body_sphere * character.body.height;
    draw.instance.scale = 1;
    auto tints = outfit(character.person, style, 0);
    std::copy(tints.begin(), tints.end(), std::begin(draw.instance.tints));
    FrameInput frame;
    frame.camera = camera_on(take, now, moment, view);
    frame.sun.direction = glm::normalize(glm::vec3(-0.5f, 0.7f, 0.55f));
    frame.walkers = people.walkers;
    frame.palette = people.palette;
    return frame;
}

}  // namespace

Result<void> draw_strip(const Options& options, double height, double speed, const Manner& manner) {
    const GaitOptions& gait = options.gait;
    Result<PartFilePtr> file = open_file(gait.strip);
    if (!file) return file.error();
    std::atomic<uint32_t> messages = 0;
    Result<RendererPtr> renderer = make_renderer(renderer_options(options, messages));
    if (!renderer) return renderer.error();
    Character character = generate_person({gait.style, static_cast<float>(height), gait.sex == Sex::woman});
    Take take = make_take(gait, {character.body, manner}, speed);
    City city;
    city.ground = take.ground;
    city.ground_axes.assign(city.ground.kinds.size(), {0, 1});
    Result<void> uploaded = upload_scene(**renderer, extract_scene(city, {character}));
    if (!uploaded) return uploaded;

    std::vector<uint8_t> rgba(size_t{4} * k_moments * k_width * k_height);
    PeopleFrame people;
    for (uint32_t i = 0; i < k_moments; ++i) {
        FrameInput frame =
            frame_of(take, character, gait.style, static_cast<double>(i) / k_moments, gait.view, people);
        Result<Image> image = draw_image(**renderer, frame, k_width, k_height);
        if (!image) return image.error();
        for (uint32_t y = 0; y < k_height; ++y) {
            std::copy_n(image->rgba.begin() + size_t{4} * y * k_width, size_t{4} * k_width,
                        rgba.begin() + size_t{4} * (y * k_moments + i) * k_width);
        }
    }
    return write_png(std::move(*file), rgba, {k_moments * k_width, k_height});
}

}  // namespace flaneur
