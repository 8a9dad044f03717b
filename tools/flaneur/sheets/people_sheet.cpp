#include "tools/flaneur/sheets/people_sheet.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "sim/base/levels.h"
#include "sim/base/math.h"
#include "sim/body/pace.h"
#include "tools/extract/convert.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/console/ending.h"
#include "tools/flaneur/gait/measure/measure.h"
#include "tools/flaneur/output/output.h"
#include "tools/flaneur/sheets/caption.h"
#include "tools/flaneur/view/show.h"

namespace flaneur {

namespace {

constexpr int k_finer = 2;                            // pixels drawn for each of the sheet's, across and down
constexpr int k_least_cell = 64, k_most_cell = 4096;  // pixels
constexpr int k_largest = 16384;                      // pixels along an edge of the sheet
constexpr float k_away = 12;                          // of the eye, metres: nobody is much nearer
constexpr float k_turned = 40 * k_radians;            // from ahead
constexpr float k_gap = 0.1f;                         // between two figures, metres
const glm::vec3 k_to_sun(-0.5f, 0.7f, 0.55f);
constexpr uint32_t k_backdrop = 0xffb4b8bau;  // sRGB, R in the lowest byte

constexpr uint8_t k_paper = 0xd8;  // between the pictures

using Joints = std::array<JointPose, k_joint_count>;

// A floor that sweeps up into a wall, all of one colour.
CityMesh backdrop() {
    constexpr float k_front = 30, k_back = -2, k_sweep = 3, k_top = 30, k_side = 40;
    constexpr int k_segments = 24;
    CityMesh mesh;
    auto row = [&](float y, float z, glm::vec3 normal) {
        for (float x : {-k_side, k_side}) {
            CityVertex v{};
            v.position = {x, y, z};
            v.colour = k_backdrop;
            v.uv = {0.6f, 0.6f};  // the middle of one slab, everywhere
            for (int i = 0; i < 3; ++i) v.normal[i] = packed(normal[i]);
            v.material = static_cast<uint16_t>(k_material_plaza);
            mesh.vertices.push_back(v);
        }
        auto n = static_cast<uint32_t>(mesh.vertices.size());
        if (n < 4) return;
        mesh.indices.insert(mesh.indices.end(), {n - 4, n - 3, n - 1, n - 4, n - 1, n - 2});
    };
    row(0, k_front, {0, 1, 0});
    for (int i = 0; i <= k_segments; ++i) {
        float angle = 0.5f * k_pi * static_cast<float>(i) / k_segments;
        float up = std::cos(angle), ahead = std::sin(angle);
        row(k_sweep * (1 - up), k_back - k_sweep * ahead, {0, up, ahead});
    }
    row(k_top, k_back - k_sweep, {0, 0, 1});
    return mesh;
}

// As the mesh was bound but for the arms, which are held straight out: a T.
Joints tee(const Character& character) {
    Joints joints;
    for (size_t j = 0; j < joints.size(); ++j)
        joints[j] = {character.bind_joints[j], conjugate(character.bind_to_canonical[j])};
    for (size_t shoulder : {left_upper_arm, right_upper_arm}) {
        Vec3 out{shoulder == left_upper_arm ? 1.0f : -1.0f, 0, 0};
        // Shoulder, elbow and hand follow one another.
        for (size_t bent = shoulder; bent < shoulder + 2; ++bent) {
            Vec3 pivot = joints[bent].position;
            Quat turn = rotation_between(normalize_or(joints[bent + 1].position - pivot, out), out);
            for (size_t j = bent; j < shoulder + 3; ++j) {
                joints[j].position = pivot + rotate(turn, joints[j].position - pivot);
                joints[j].rotation = turn * joints[j].rotation;
            }
        }
    }
    return joints;
}

// Standing, and stepping on the left heel, both above the origin.
struct Moments {
    Joints standing, stepping;
};

Joints above_origin(const Instant& now) {
    Joints joints = now.joints;
    for (JointPose& joint : joints) joint.position -= now.root;
    return joints;
}

Moments moments_of(const Sitter& sitter) {
    constexpr double k_seconds = 6, k_stand = 1, k_steady = 3;
    const PersonOptions& person = sitter.character.person;
    const Body& body = sitter.character.body;
    Ground ground = ground_of(level_course(0));
    Vec2 onward{0, usual_speed(person.age, person.woman, leg_length(body))};
    Walk taken = walk(ground, {body, manner_at_age(person.age)}, k_seconds,
                      [&](double time) { return time < k_stand ? Vec2{} : onward; });
    auto tick = static_cast<size_t>(k_steady * taken.rate);
    for (const MeasuredStride& stride : strides(taken, tick, taken.ticks.size())) {
        if (stride.side != k_left) continue;
        tick = static_cast<size_t>(std::ceil(stride.begin));
        break;
    }
    return {above_origin(taken.ticks.front()), above_origin(taken.ticks[tick])};
}

// Turned about the upright through the origin, then moved aside.
Joints placed(const Joints& joints, float yaw, float x) {
    Vec2 ahead = heading_direction(yaw);
    Quat turn = rotation_between({0, 0, 1}, {ahead.x, 0, ahead.z});
    Joints out;
    for (size_t j = 0; j < joints.size(); ++j)
        out[j] = {rotate(turn, joints[j].position) + Vec3{x, 0, 0}, turn * joints[j].rotation};
    return out;
}

// visit(place) of every vertex of a posed figure; of the head's alone, with all that it wears, if told so.
template <class Visit>
void for_each_place(const Character& character, const Joints& joints, bool is_head, Visit&& visit) {
    for (const CharacterVertex& v : character.vertices) {
        if (is_head && v.joints[0] != head) continue;
        Vec3 place;
        for (int n = 0; n < 4; ++n) {
            const JointPose& joint = joints[v.joints[n]];
            Quat turn = joint.rotation * character.bind_to_canonical[v.joints[n]];
            Vec3 moved = joint.position + rotate(turn, v.position - character.bind_joints[v.joints[n]]);
            place += moved * (static_cast<float>(v.weights[n]) / 255);
        }
        visit(place);
    }
}

// Through the eye at k_away from the origin, how far to the left and the right of it a figure is seen.
struct Reach {
    float left = 0, right = 0;
};

Reach reach_of(const Character& character, const Joints& joints) {
    Reach reach;
    for_each_place(character, joints, false, [&](Vec3 place) {
        const float seen = place.x * k_away / (k_away - place.z);
        reach.left = std::max(reach.left, -seen);
        reach.right = std::max(reach.right, seen);
    });
    return reach;
}

// Looks ahead and `above` / k_away down. What is seen about the target is half as wide and as tall as this.
struct View {
    Vec3 target;
    float above = 0;
    float width = 0, height = 0;
};

Vec3 eye_of(const View& view) { return view.target + Vec3{0, view.above, k_away}; }

// What of it the figures take up: a view of them alone, looking the same way.
View around(const Character& character, std::span<const Joints> figures, bool is_head, View view) {
    const Vec3 ahead = normalize_or({0, -view.above, -k_away}, {0, 0, -1}), up = cross({1, 0, 0}, ahead);
    const float away = length(Vec3{0, view.above, k_away});
    for (int round = 0; round < 3; ++round) {  // moving the eye changes a little what it sees
        const Vec3 eye = eye_of(view);
        float low[2] = {1e9f, 1e9f}, high[2] = {-1e9f, -1e9f};
        for (const Joints& joints : figures)
            for_each_place(character, joints, is_head, [&](Vec3 place) {
                const Vec3 to = place - eye;
                const float seen[2] = {to.x * away / dot(to, ahead), dot(to, up) * away / dot(to, ahead)};
                for (int i = 0; i < 2; ++i)
                    low[i] = std::min(low[i], seen[i]), high[i] = std::max(high[i], seen[i]);
            });
        view.target += Vec3{1, 0, 0} * (0.5f * (low[0] + high[0])) + up * (0.5f * (low[1] + high[1]));
        view.width = high[0] - low[0];
        view.height = high[1] - low[1];
    }
    return view;
}

// Both poses of one sitter side by side, and a view of both.
struct PosedPair {
    std::array<Joints, 2> figures;  // its arms held out, stepping
    View view;
};

PosedPair pair_of(const Character& character, const Moments& moments, float turn) {
    PosedPair pair{{placed(tee(character), turn, 0), placed(moments.stepping, k_turned + turn, 0)}, {}};
    auto& [tee, stepping] = pair.figures;
    Reach a = reach_of(character, tee), b = reach_of(character, stepping);
    const float width = a.left + a.right + b.left + b.right + k_gap;
    tee = placed(tee, 0, -0.5f * width + a.left);
    stepping = placed(stepping, 0, 0.5f * width - b.right);
    constexpr float k_above = 1.5f;
    pair.view = around(character, pair.figures, false, {{0, 0.5f * character.body.height, 0}, k_above});
    return pair;
}

Camera camera_of(const View& view, Size size) {
    constexpr float k_margin = 1.06f;
    float aspect = static_cast<float>(size.width) / static_cast<float>(size.height);
    float away = length(Vec3{0, view.above, k_away});
    Camera camera;
    camera.eye = to_glm(eye_of(view));
    camera.target = to_glm(view.target);
    camera.vertical_fov = 2 * std::atan(0.5f * k_margin * std::max(view.height, view.width / aspect) / away);
    return camera;
}

struct PosedFigure {
    uint32_t sitter;
    Joints joints;
};

struct Sheet {
    Renderer& renderer;
    Size size;
    std::vector<uint8_t> rgba;
    PeopleFrame people;
};

// Draws one view, finer than it is kept, with its upper left corner at (left, top).
Result<void> draw_part(Sheet& sheet, const std::vector<Sitter>& sitters,
                       const std::vector<PosedFigure>& figures, const Camera& camera, int left, int top,
                       Size size) {
    PeopleFrame& people = sheet.people;
    people.walkers.resize(figures.size());
    people.palette.resize(figures.size() * k_palette_joints);
    for (size_t i = 0; i < figures.size(); ++i) {
        const Sitter& sitter = sitters[figures[i].sitter];
        pose_character(sitter.character, 1, figures[i].joints.data(), &people.palette[i * k_palette_joints]);
        WalkerDraw& draw = people.walkers[i];
        draw.centre = to_glm(figures[i].joints[hips].position);
        draw.radius = k_body_sphere * sitter.character.body.height;
        draw.mesh = figures[i].sitter;
        draw.instance.palette = static_cast<uint32_t>(i * k_palette_joints);
        draw.instance.scale = 1;
        std::copy(sitter.tints.begin(), sitter.tints.end(), std::begin(draw.instance.tints));
    }
    FrameInput frame;
    frame.camera = camera;
    frame.sun.direction = glm::normalize(k_to_sun);
    frame.walkers = people.walkers;
    frame.palette = people.palette;
    frame.is_finest = true;
    Result<Image> image = draw_image(sheet.renderer, frame, static_cast<uint32_t>(k_finer * size.width),
                                     static_cast<uint32_t>(k_finer * size.height));
    if (!image) return image.error();
    // The mean of light, not of its codes: their squares are near enough.
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            for (int c = 0; c < 4; ++c) {
                float light = 0;
                for (int n = 0; n < k_finer * k_finer; ++n) {
                    int row = k_finer * y + n / k_finer, column = k_finer * x + n % k_finer;
                    auto code = static_cast<float>(
                        image->rgba[static_cast<size_t>(4 * (row * k_finer * size.width + column) + c)]);
                    light += code * code;
                }
                auto to = static_cast<size_t>(top + y) * static_cast<size_t>(sheet.size.width) +
                          static_cast<size_t>(left + x);
                sheet.rgba[4 * to + static_cast<size_t>(c)] =
                    static_cast<uint8_t>(std::sqrt(light / (k_finer * k_finer)) + 0.5f);
            }
        }
    }
    return {};
}

// The head from ahead and half from the side, turned.
Result<void> draw_face(Sheet& sheet, const std::vector<Sitter>& sitters, uint32_t i, const Moments& moments,
                       float turn, int left, int top, Size size) {
    Size half{size.width / 2, size.height};
    float neck_up = sitters[i].character.body.height - moments.standing[head].position.y;
    for (int side : {0, 1}) {
        PosedFigure figure{i, placed(moments.standing, turn + (side == 0 ? 0 : k_turned), 0)};
        // All that the head wears, and some of the shoulders.
        View view{figure.joints[head].position + Vec3{0, 0.45f * neck_up, 0}};
        const View worn = around(sitters[i].character, std::span(&figure.joints, 1), true, view);
        auto cover = [](float have, float from, float wanted) {
            return std::max(have, wanted + 2 * std::abs(from));
        };
        view.width = cover(1.8f * neck_up, worn.target.x - view.target.x, worn.width);
        view.height = cover(1.22f * neck_up, worn.target.y - view.target.y, worn.height);
        Camera camera = camera_of(view, half);
        Result<void> drawn = draw_part(sheet, sitters, {figure}, camera, left + side * half.width, top, half);
        if (!drawn) return drawn;
    }
    return {};
}

// As many columns as make the sheet about 16 : 9.
Size sheet_size(size_t count, Size cell) {
    double shape = 16.0 / 9 * cell.height / cell.width;
    auto people = static_cast<int>(count);
    auto columns = static_cast<int>(std::lround(std::sqrt(static_cast<double>(count) * shape)));
    columns = std::clamp(columns, 1, people);
    return {columns * cell.width, (people + columns - 1) / columns * cell.height};
}

Result<void> draw_cells(Sheet& sheet, const std::vector<Sitter>& sitters, bool one_scale,
                        const PeopleOptions& people) {
    int columns = sheet.size.width / people.cell.width;
    int letters = std::max(people.cell.height / 250, 1);
    Size picture{people.cell.width, people.cell.height - 14 * letters};
    auto turn = static_cast<float>(people.turn) * k_radians;
    std::vector<Moments> moments;
    std::vector<PosedPair> pairs;
    float widest = 0, tallest = 0;
    for (const Sitter& sitter : sitters) {
        moments.push_back(moments_of(sitter));
        pairs.push_back(pair_of(sitter.character, moments.back(), turn));
        widest = std::max(widest, pairs.back().view.width);
        tallest = std::max(tallest, pairs.back().view.height);
    }
    for (uint32_t i = 0; i < sitters.size(); ++i) {
        if (is_stopping()) return interrupted();
        show_progress("picture " + std::to_string(i + 1) + " of " + std::to_string(sitters.size()));
        int left = static_cast<int>(i) % columns * people.cell.width;
        int top = static_cast<int>(i) / columns * people.cell.height;
        Result<void> drawn;
        if (people.close) {
            drawn = draw_face(sheet, sitters, i, moments[i], turn, left, top, picture);
        } else {
            View view = pairs[i].view;
            if (one_scale) view.width = widest, view.height = tallest;
            std::vector<PosedFigure> both{{i, pairs[i].figures[0]}, {i, pairs[i].figures[1]}};
            const Camera camera = camera_of(view, picture);
            drawn = draw_part(sheet, sitters, both, camera, left, top, picture);
        }
        if (!drawn) return drawn;
        draw_caption(sheet.rgba, sheet.size, left + 4 * letters, top + picture.height + 4 * letters, letters,
                     sitters[i].caption);
    }
    return {};
}

}  // namespace

Result<PartFilePtr> open_sheet(const PeopleOptions& people, size_t count) {
    Size cell = people.cell, size = sheet_size(count, cell);
    if (std::min(cell.width, cell.height) < k_least_cell || std::max(cell.width, cell.height) > k_most_cell) {
        return Error{"--size of a cell must be from " + std::to_string(k_least_cell) + " to " +
                     std::to_string(k_most_cell) + " pixels each way."};
    }
    if (size.width > k_largest || size.height > k_largest) {
        return Error{"--sheet " + people.sheet + " would be " + std::to_string(size.width) + "x" +
                     std::to_string(size.height) + " pixels, more than " + std::to_string(k_largest) +
                     " along an edge: ask for fewer people or a smaller --size."};
    }
    return open_file(people.sheet);
}

Result<void> draw_sheet(PartFilePtr file, const std::vector<Sitter>& sitters, bool one_scale,
                        const Options& options) {
    std::atomic<uint32_t> messages = 0;
    {
        Result<RendererPtr> renderer = make_renderer(renderer_options(options, messages));
        if (!renderer) return renderer.error();
        SceneMeshes scene;
        scene.city = backdrop();
        for (const Sitter& sitter : sitters) scene.people.push_back(extract_character(sitter.character));
        Result<void> uploaded = upload_scene(**renderer, scene);
        if (!uploaded) return uploaded;
        Size size = sheet_size(sitters.size(), options.people.cell);
        Sheet sheet{**renderer, size, {}, {}};
        sheet.rgba.assign(size_t{4} * static_cast<size_t>(size.width) * static_cast<size_t>(size.height),
                          k_paper);
        Result<void> drawn = draw_cells(sheet, sitters, one_scale, options.people);
        clear_progress();
        if (!drawn) return drawn;
        Result<void> written = write_png(std::move(file), sheet.rgba, size);
        if (!written) return written;
    }
    return check_messages(messages);
}

}  // namespace flaneur
