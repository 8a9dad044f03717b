#include "tools/flaneur/sheets/strip.h"

#include <algorithm>
#include <cmath>

#include "assets/outfit.h"
#include "assets/population.h"
#include "sim/base/levels.h"
#include "sim/base/math.h"
#include "tools/extract/convert.h"
#include "tools/flaneur/gait/people/who.h"
#include "tools/flaneur/output/output.h"
#include "tools/flaneur/sheets/take.h"
#include "tools/flaneur/view/show.h"

namespace flaneur {

namespace {

constexpr uint32_t k_pictures = 12;
constexpr uint32_t k_width = 240, k_height = 420;  // pixels of one
constexpr double k_abreast_at = 6;                 // seconds, of people at one moment
constexpr uint64_t k_abreast_seed = 3;
constexpr float k_around = 0.16f;  // metres from a joint to the end of what it moves, toes of shoes say

// Somebody who is drawn, and the walk.
struct Shown {
    Character character;
    Take take;
};

Shown show(const GaitOptions& gait, const PersonOptions& who, const Manner& manner, double speed) {
    Shown shown{generate_person(who), {}};
    Person person{shown.character.body, manner, who.seed};
    const Moments& moments = gait.moments;
    if (moments.last > 0 || gait.abreast) {
        shown.take = make_take(gait, person, speed, std::max(gait.seconds, moments.last));
        double first = gait.abreast && moments.last == 0 ? k_abreast_at : moments.first;
        shown.take.first = first * shown.take.walk.rate;
        shown.take.last = moments.last * shown.take.walk.rate;
    } else {
        shown.take = make_moment(gait, person, speed);
    }
    return shown;
}

// Twelve people as the built-in ones are dealt, each at the pace they like.
std::vector<Shown> twelve_people(const GaitOptions& gait) {
    std::vector<Shown> all;
    for (const PersonOptions& who : draw_population(k_pictures, k_abreast_seed + gait.style)) {
        Who like{who.woman ? Sex::woman : Sex::man, static_cast<double>(who.age), all.size() + 1};
        double leg = static_cast<double>(leg_length(standard_body(who.height)));
        Manner manner = manner_of(like);
        free_hands(manner, like, gait);
        all.push_back(show(gait, who, manner, gait.speed > 0 ? gait.speed : liked_speed(like, leg)));
    }
    return all;
}

// Metres to a side that somebody's joints ever are from what the pictures of a take look at, which is `off`
// the root.
float widest(const Take& take, Vec3 off, StripView view) {
    const auto last = std::min(static_cast<size_t>(take.last) + 1, take.walk.ticks.size());
    float far = 0;
    for (size_t tick = static_cast<size_t>(take.first); tick < last; ++tick) {
        const Instant& at = take.walk.ticks[tick];
        for (const JointPose& joint : at.joints) {
            const Vec3 from = joint.position - at.root - off;
            far = std::max(far, std::abs(view == StripView::side ? from.z : from.x));
        }
    }
    return far + k_around;
}

// Keeps at the person's middle, as tall as the ground on the whole is; far away, so that nothing is much
// nearer, and not below stairs that lie ahead. So far away that all pictures hold whoever is taken whole.
Camera camera_on(const Take& take, const Instant& now, double moment, float tall, StripView view) {
    const std::vector<Instant>& ticks = take.walk.ticks;
    auto height_at = [&](double tick) {
        return ticks[std::min(static_cast<size_t>(tick), ticks.size() - 1)].root.y;
    };
    float climbed = lerp(height_at(take.first), height_at(take.last), static_cast<float>(moment));
    constexpr float k_away = 12, k_above = 0.6f, k_any = 50;
    Vec3 target{now.root.x, climbed + 0.47f * tall, now.root.z};
    // A pram reaches farther ahead than one is wide.
    if (take.walk.body.pram != Vec3{}) {
        tall *= 1.5f;
        target += at_height(heading_direction(now.heading) * 0.6f, 0);
    }
    Vec3 eye = target + (view == StripView::side ? Vec3{-k_away, k_above, 0} : Vec3{0, k_above, k_away});
    if (auto hit = ground_at(take.ground, eye, k_any, k_any)) eye.y = std::max(eye.y, hit->height + k_above);
    Camera camera;
    camera.eye = to_glm(eye);
    camera.target = to_glm(target);
    constexpr float k_aspect = static_cast<float>(k_width) / static_cast<float>(k_height);
    const float half = std::max(0.64f * tall, widest(take, target - now.root, view) / k_aspect);
    camera.vertical_fov = 2 * std::atan(half / length(eye - target));
    return camera;
}

// At a moment of the take, 0..1, of the person that is the `mesh`th.
FrameInput frame_of(const Shown& shown, uint32_t mesh, double moment, float tall, StripView view,
                    PeopleFrame& people) {
    const auto& [character, take] = shown;
    auto tick = static_cast<size_t>(std::lround(take.first + moment * (take.last - take.first)));
    const Instant& now = take.walk.ticks[std::min(tick, take.walk.ticks.size() - 1)];
    people.walkers.resize(1);
    people.palette.resize(k_palette_joints);
    pose_character(character, 1, now.joints.data(), people.palette.data(), &now.trail,
                   now.pram ? &*now.pram : nullptr);
    people.grounds = {
        find_ground_below(surroundings_of(take.ground), now.joints.data(), now.pram ? &*now.pram : nullptr)};
    WalkerDraw& draw = people.walkers[0];
    draw.centre = to_glm(place(now, hips));
    draw.radius = k_body_sphere * character.body.height;
    draw.mesh = mesh;
    draw.instance.scale = 1;
    auto tints = outfit(character.person, character.person.seed, mesh);
    std::copy(tints.begin(), tints.end(), std::begin(draw.instance.tints));
    FrameInput frame;
    frame.camera = camera_on(take, now, moment, tall, view);
    frame.sun.direction = glm::normalize(glm::vec3(-0.5f, 0.7f, 0.55f));
    frame.walkers = people.walkers;
    frame.palette = people.palette;
    frame.grounds = people.grounds;
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
    who.bag = gait.bag;
    who.pram = gait.pram;
    who.age = static_cast<float>(gait.age);
    std::vector<Shown> shown =
        gait.abreast ? twelve_people(gait) : std::vector<Shown>{show(gait, who, manner, speed)};
    std::vector<Character> characters;
    float tallest = 0;
    for (const Shown& s : shown) {
        characters.push_back(s.character);
        tallest = std::max(tallest, s.character.body.height);
    }
    City city;
    city.ground = shown.front().take.ground;
    city.ground_axes.assign(city.ground.kinds.size(), {0, 1});
    Result<void> uploaded = upload_scene(**renderer, extract_scene(city, characters));
    if (!uploaded) return uploaded;

    std::vector<uint8_t> rgba(size_t{4} * k_pictures * k_width * k_height);
    PeopleFrame people;
    for (uint32_t i = 0; i < k_pictures; ++i) {
        uint32_t mesh = gait.abreast ? i : 0;
        double moment = gait.abreast ? 0 : static_cast<double>(i) / k_pictures;
        FrameInput frame = frame_of(shown[mesh], mesh, moment, tallest, gait.view, people);
        Result<Image> image = draw_image(**renderer, frame, k_width, k_height);
        if (!image) return image.error();
        for (uint32_t y = 0; y < k_height; ++y) {
            std::copy_n(image->rgba.begin() + size_t{4} * y * k_width, size_t{4} * k_width,
                        rgba.begin() + size_t{4} * (y * k_pictures + i) * k_width);
        }
    }
    return write_png(std::move(*file), rgba, {k_pictures * k_width, k_height});
}

}  // namespace flaneur
