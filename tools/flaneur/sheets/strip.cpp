#include "tools/flaneur/sheets/strip.h"

#include <algorithm>
#include <cmath>

#include "assets/outfit.h"
#include "assets/population.h"
#include "sim/base/levels.h"
#include "sim/base/math.h"
#include "tools/extract/convert.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/console/ending.h"
#include "tools/flaneur/gait/people/who.h"
#include "tools/flaneur/output/film.h"
#include "tools/flaneur/output/output.h"
#include "tools/flaneur/sheets/take.h"
#include "tools/flaneur/view/show.h"

namespace flaneur {

namespace {

constexpr uint32_t k_pictures = 12;
constexpr Size k_tile = {240, 420}, k_alone = {480, 840};  // pixels of one; in a film of one
constexpr uint32_t k_film_step = 2;                        // ticks from picture to picture
constexpr double k_evened = 0.6;                           // seconds to each side
constexpr double k_abreast_at = 6, k_film_abreast = 4;  // seconds, of people at one moment; of a film of it
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
        const bool is_free = moments.last == 0;
        shown.take.first = (is_free ? k_abreast_at : moments.first) * shown.take.walk.rate;
        shown.take.last = (is_free ? k_abreast_at + k_film_abreast : moments.last) * shown.take.walk.rate;
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

// Metres, the ground's height about a tick, evened over the time that somebody takes for two steps.
float height_about(const Take& take, size_t tick) {
    const std::vector<Instant>& ticks = take.walk.ticks;
    const auto half = static_cast<size_t>(k_evened * take.walk.rate);
    const size_t first = tick > half ? tick - half : 0, last = std::min(tick + half, ticks.size() - 1);
    float sum = 0;
    for (size_t i = first; i <= last; ++i) sum += ticks[i].root.y;
    return sum / static_cast<float>(last - first + 1);
}

// Keeps at the person's middle, as tall as the ground thereabouts; far away, so that nothing is much nearer,
// and not below stairs that lie ahead. So far away that all pictures hold whoever is taken whole.
Camera camera_on(const Take& take, size_t tick, float tall, StripView view) {
    const Instant& now = take.walk.ticks[tick];
    const float climbed = height_about(take, tick);
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
    constexpr float k_aspect = static_cast<float>(k_tile.width) / static_cast<float>(k_tile.height);
    const float half = std::max(0.64f * tall, widest(take, target - now.root, view) / k_aspect);
    camera.vertical_fov = 2 * std::atan(half / length(eye - target));
    return camera;
}

// At a moment of the take, 0..1, of the person that is the `mesh`th.
FrameInput frame_of(const Shown& shown, uint32_t mesh, double moment, float tall, StripView view,
                    PeopleFrame& people) {
    const auto& [character, take] = shown;
    const auto at = static_cast<size_t>(std::lround(take.first + moment * (take.last - take.first)));
    const size_t tick = std::min(at, take.walk.ticks.size() - 1);
    const Instant& now = take.walk.ticks[tick];
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
    frame.camera = camera_on(take, tick, tall, view);
    frame.sun.direction = glm::normalize(glm::vec3(-0.5f, 0.7f, 0.55f));
    frame.walkers = people.walkers;
    frame.palette = people.palette;
    frame.grounds = people.grounds;
    return frame;
}

// Who is drawn, and what with.
struct Studio {
    RendererPtr renderer;
    std::vector<Shown> shown;
    float tallest = 0;
    StripView view = StripView::side;
    PeopleFrame people;
};

Result<Studio> make_studio(const Options& options, std::atomic<uint32_t>& messages, double height,
                           double speed, const Manner& manner) {
    const GaitOptions& gait = options.gait;
    Studio studio;
    Result<RendererPtr> renderer = make_renderer(renderer_options(options, messages));
    if (!renderer) return renderer.error();
    studio.renderer = std::move(*renderer);
    studio.view = gait.view;
    PersonOptions who{gait.style, static_cast<float>(height), gait.sex == Sex::woman};
    who.stick = gait.cane;
    who.bag = gait.bag;
    who.pram = gait.pram;
    who.age = static_cast<float>(gait.age);
    if (gait.abreast) {
        studio.shown = twelve_people(gait);
    } else {
        studio.shown.push_back(show(gait, who, manner, speed));
    }
    std::vector<Character> characters;
    for (const Shown& s : studio.shown) {
        characters.push_back(s.character);
        studio.tallest = std::max(studio.tallest, s.character.body.height);
    }
    City city;
    city.ground = studio.shown.front().take.ground;
    city.ground_axes.assign(city.ground.kinds.size(), {0, 1});
    Result<void> uploaded = upload_scene(*studio.renderer, extract_scene(city, characters));
    if (!uploaded) return uploaded.error();
    return studio;
}

// One of those shown, at a moment of the take, 0..1.
struct Tile {
    uint32_t who = 0;
    double moment = 0;
};

Size row_size(size_t tiles, Size tile) { return {static_cast<int>(tiles) * tile.width, tile.height}; }

// Tiles side by side.
Result<std::vector<uint8_t>> draw_row(Studio& studio, const std::vector<Tile>& tiles, Size tile) {
    const size_t row = size_t{4} * static_cast<size_t>(tile.width), whole = tiles.size() * row;
    std::vector<uint8_t> rgba(whole * static_cast<size_t>(tile.height));
    for (size_t i = 0; i < tiles.size(); ++i) {
        FrameInput frame = frame_of(studio.shown[tiles[i].who], tiles[i].who, tiles[i].moment, studio.tallest,
                                    studio.view, studio.people);
        Result<Image> image = draw_image(*studio.renderer, frame, static_cast<uint32_t>(tile.width),
                                         static_cast<uint32_t>(tile.height));
        if (!image) return image.error();
        for (size_t y = 0; y < static_cast<size_t>(tile.height); ++y)
            std::copy_n(image->rgba.begin() + static_cast<std::ptrdiff_t>(y * row), row,
                        rgba.begin() + static_cast<std::ptrdiff_t>(y * whole + i * row));
    }
    return rgba;
}

// Everybody side by side at each moment.
Result<void> draw_film(Studio& studio, Film& film, Size tile, uint32_t pictures) {
    std::vector<Tile> tiles(studio.shown.size());
    for (uint32_t i = 0; i < pictures; ++i) {
        if (is_stopping()) return interrupted();
        show_progress("picture " + std::to_string(i + 1) + " of " + std::to_string(pictures));
        for (uint32_t k = 0; k < tiles.size(); ++k) tiles[k] = {k, static_cast<double>(i) / pictures};
        Result<std::vector<uint8_t>> rgba = draw_row(studio, tiles, tile);
        if (!rgba) return rgba.error();
        if (Result<void> written = write_film(film, *rgba); !written) return written;
    }
    clear_progress();
    return {};
}

}  // namespace

Result<void> draw_strip(const Options& options, double height, double speed, const Manner& manner) {
    const GaitOptions& gait = options.gait;
    const Size tile = is_film(gait.strip) && !gait.abreast ? k_alone : k_tile;
    const size_t in_film = gait.abreast ? k_pictures : 1;
    PartFilePtr picture;
    FilmPtr film;
    if (is_film(gait.strip)) {
        Result<FilmPtr> opened = open_film(gait.strip, row_size(in_film, tile), k_film_step, {}, false);
        if (!opened) return opened.error();
        film = std::move(*opened);
    } else {
        Result<PartFilePtr> opened = open_file(gait.strip);
        if (!opened) return opened.error();
        picture = std::move(*opened);
    }
    std::atomic<uint32_t> messages = 0;
    Result<Studio> studio = make_studio(options, messages, height, speed, manner);
    if (!studio) return studio.error();
    if (film) {
        const Take& take = studio->shown.front().take;
        auto pictures =
            static_cast<uint32_t>(std::max(std::lround((take.last - take.first) / k_film_step), 1L));
        Result<void> drawn = draw_film(*studio, *film, tile, pictures);
        return drawn ? finish_film(std::move(film)) : drawn;
    }
    std::vector<Tile> tiles;
    for (uint32_t i = 0; i < k_pictures; ++i)
        tiles.push_back(gait.abreast ? Tile{i, 0} : Tile{0, static_cast<double>(i) / k_pictures});
    Result<std::vector<uint8_t>> rgba = draw_row(*studio, tiles, tile);
    if (!rgba) return rgba.error();
    return write_png(std::move(picture), *rgba, row_size(k_pictures, tile));
}

}  // namespace flaneur
