#include "tools/flaneur/sheets/strip.h"

#include <algorithm>
#include <cmath>

#include "assets/outfit.h"
#include "sim/base/levels.h"
#include "tools/extract/convert.h"
#include "tools/flaneur/output/output.h"
#include "tools/flaneur/sheets/take.h"
#include "tools/flaneur/view/show.h"

namespace flaneur {

namespace {

constexpr uint32_t k_moments = 12;
constexpr uint32_t k_width = 240, k_height = 420;  // pixels of one

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
    pose_character(character, 1, now.joints.data(), people.palette.data(), &now.trail);
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
    PersonOptions who{gait.style, static_cast<float>(height), gait.sex == Sex::woman};
    who.stick = gait.cane;
    who.age = static_cast<float>(gait.age);
    Character character = generate_person(who);
    Take take = make_moment(gait, {character.body, manner}, speed);
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
