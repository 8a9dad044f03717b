// The scene that other renderers were measured by (N copies of CesiumMan that play their own clip), drawn
// with levels of detail and with every triangle.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "assets/gltf/character/clip.h"
#include "sim/animation/blend.h"
#include "sim/base/levels.h"
#include "sim/base/math.h"
#include "sim/base/parallel_for.h"
#include "tools/extract/convert.h"
#include "tools/extract/extract.h"
#include "tools/flaneur/bench/bench.h"
#include "tools/flaneur/console/ending.h"
#include "tools/flaneur/load/load.h"
#include "tools/flaneur/output/output.h"
#include "tools/flaneur/view/show.h"
#include "tools/rendercheck/verdict/flip.h"

namespace flaneur {

namespace {

using Clock = std::chrono::steady_clock;

constexpr float k_spacing = 1.5f, k_clip_seconds = 2;
constexpr int k_warm_frames = 3, k_compared_frame = 30;
constexpr int k_counts[] = {100, 500, 1000};

struct Mode {
    const char* name;
    bool is_finest;
    double goals[3];
};
constexpr Mode k_modes[] = {{"with LOD", false, {10, 15, 20}}, {"every triangle", true, {30, 60, 80}}};

struct Dancers {
    Character character;
    Skeleton skeleton;
    BlendTree tree;  // the clip alone; its input is the phase
    WorkersPtr workers;
    std::vector<LaneRow> phases, local, model;  // one, local_rows and model_rows a block
    PeopleFrame people;
};

Result<Dancers> make_dancers(const Options& options) {
    const std::vector<PeopleShare>& people = options.scene.people;
    if (people.size() != 1 || people[0].character.empty())
        return Error{
            "bench peers draws copies of one character with a clip of its own: give --character FILE, "
            "Khronos' CesiumMan.glb to compare with others."};
    const std::string& path = people[0].character;
    Result<Character> character = read_character(path, options.force);
    if (!character) return character.error();
    Result<RecordedMotion> motion = load_motion(path, "");
    if (!motion) return motion.error();
    Dancers d;
    d.character = std::move(*character);
    d.skeleton = humanoid(d.character.body);
    Result<Clip> clip = make_clip(d.skeleton, motion->keys, motion->rate, true, Curve::linear);
    if (!clip) return Error{path + ": " + clip.error().message};
    d.tree.clips = {std::move(*clip)};
    d.tree.nodes = {{}};
    d.tree.layers = {{}};
    d.tree.inputs = 1;
    if (Result<void> sound = check_tree(d.tree); !sound) return sound.error();
    d.workers = make_workers(options.threads);
    const size_t blocks = block_count(options.bench_count);
    d.phases.resize(blocks);
    d.local.resize(blocks * local_rows(k_joint_count));
    d.model.resize(blocks * model_rows(k_joint_count));
    d.people.walkers.resize(options.bench_count);
    d.people.palette.resize(size_t{options.bench_count} * k_palette_joints);
    return d;
}

float part(float x) { return x - std::floor(x); }

float phase_of(uint32_t number, uint32_t frame) {
    const double seconds = frame / 60.0 + std::fmod(number * 0.61803399, 1.0) * k_clip_seconds;
    return static_cast<float>(std::fmod(seconds, k_clip_seconds) / k_clip_seconds);
}

// Joints of one of a block's characters, about where its canonical pose stands.
std::array<JointPose, k_joint_count> joints_of(const LaneRow* model, size_t lane) {
    std::array<JointPose, k_joint_count> joints;
    for (size_t j = 0; j < k_joint_count; ++j) {
        const LaneRow* rows = model + 7 * j;
        auto value = [&](size_t row) { return rows[row].lanes[lane]; };
        joints[j] = {{value(0), value(1), value(2)}, {value(3), value(4), value(5), value(6)}};
    }
    return joints;
}

void pose_block(Dancers& d, size_t block) {
    LaneRow* local = &d.local[block * local_rows(k_joint_count)];
    evaluate_blends(d.tree, d.phases.data(), block, block + 1, d.local.data());
    model_pose(d.skeleton, local, &d.model[block * model_rows(k_joint_count)]);
}

// PersonMesh::strides out of the clip.
std::vector<JointTransform> strides_of(Dancers& d) {
    std::vector<JointTransform> strides(size_t{k_stride_poses} * k_palette_joints);
    for (int i = 0; i < k_stride_poses; ++i) {
        d.phases[0].lanes[0] = part(static_cast<float>(i) / k_stride_phases);
        pose_block(d, 0);
        auto joints = joints_of(d.model.data(), 0);
        const Vec3 middle = joints[hips].position;
        for (JointPose& joint : joints) joint.position -= middle;
        pose_character(d.character, 1, joints.data(), &strides[static_cast<size_t>(i * k_palette_joints)]);
    }
    return strides;
}

// Where everyone is in a frame.
void animate(Dancers& d, uint32_t frame) {
    const auto count = static_cast<uint32_t>(d.people.walkers.size());
    const auto columns = static_cast<uint32_t>(std::ceil(std::sqrt(static_cast<double>(count))));
    const float middle = (static_cast<float>(columns) - 1) / 2;
    parallel_for(*d.workers, d.phases.size(), 1, [&](size_t begin, size_t end, int) {
        for (size_t block = begin; block < end; ++block) {
            const auto first = static_cast<uint32_t>(block * k_block);
            const uint32_t last = std::min(first + k_block, count);
            for (uint32_t i = first; i < last; ++i) d.phases[block].lanes[i - first] = phase_of(i, frame);
            pose_block(d, block);
            for (uint32_t i = first; i < last; ++i) {
                auto joints = joints_of(&d.model[block * model_rows(k_joint_count)], i - first);
                const float yaw = static_cast<float>(std::fmod(i * 2.399963, 2.0 * 3.14159265358979));
                const Quat turn = rotation_y(yaw);
                const uint32_t column = i % columns, row = i / columns;
                const Vec3 place{(static_cast<float>(column) - middle) * k_spacing, 0,
                                 (static_cast<float>(row) - middle) * k_spacing};
                for (JointPose& joint : joints)
                    joint = {place + rotate(turn, joint.position), turn * joint.rotation};
                pose_character(d.character, 1, joints.data(),
                               &d.people.palette[size_t{i} * k_palette_joints]);
                WalkerDraw& draw = d.people.walkers[i];
                draw.centre = to_glm(joints[hips].position);
                draw.radius = k_body_sphere * d.character.body.height;
                draw.instance = {i * k_palette_joints, 1, {}, 0};
                std::fill(std::begin(draw.instance.tints), std::end(draw.instance.tints), 0xffffffffu);
                draw.heading = yaw;
                draw.phase = d.phases[block].lanes[i - first];
            }
        }
    });
}

FrameInput frame_of(const Dancers& d, bool is_finest) {
    const float side = std::ceil(std::sqrt(static_cast<float>(d.people.walkers.size()))) * k_spacing;
    FrameInput frame;
    frame.camera = {.eye = {0, 0.45f * side + 1.5f, 0.85f * side + 2.5f},
                    .target = {0, 0.5f, 0},
                    .vertical_fov = 45 * k_radians,
                    .near_plane = 0.1f};
    frame.sun = {{0.5f, 1, 0.7f}};
    frame.walkers = d.people.walkers;
    frame.palette = d.people.palette;
    frame.backdrop = {{0.6f, 0.8f, 1.0f}};
    frame.is_finest = is_finest;
    return frame;
}

SceneMeshes scene_of(Dancers& d) {
    SceneMeshes scene;
    const float half =
        (std::ceil(std::sqrt(static_cast<float>(d.people.walkers.size()))) * k_spacing * 4 + 40) / 2;
    for (glm::vec2 at : {glm::vec2(-1, 1), {1, 1}, {1, -1}, {-1, -1}}) {
        CityVertex v{};
        v.position = {at.x * half, 0, at.y * half};
        v.colour = 0xff808080u;
        v.uv = {0.6f, 0.6f};
        v.normal[1] = 127;
        v.material = static_cast<uint16_t>(k_material_plaza);
        scene.city.vertices.push_back(v);
    }
    scene.city.indices = {0, 1, 2, 0, 2, 3};
    scene.people.push_back(extract_character(d.character));
    scene.people[0].strides = strides_of(d);
    return scene;
}

Result<Image> draw(Renderer& renderer, const Options& options, const FrameInput& frame) {
    return draw_image(renderer, frame, static_cast<uint32_t>(options.scene.size.width),
                      static_cast<uint32_t>(options.scene.size.height));
}

// Fills `figures`; gives the picture of k_compared_frame.
Result<Image> measure(Dancers& d, Renderer& renderer, const Options& options, bool is_finest,
                      Figures& figures) {
    auto ms_since = [](Clock::time_point start) {
        return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    };
    for (uint32_t i = 0; i < k_warm_frames + options.bench_frames; ++i) {
        if (is_stopping()) return interrupted();
        const auto start = Clock::now();
        const double cpu_start = cpu_ms();
        animate(d, i);
        const double animated = ms_since(start);
        Result<Image> image = draw(renderer, options, frame_of(d, is_finest));
        if (!image) return image.error();
        if (i < k_warm_frames) continue;
        add_sample(figures, "frame", ms_since(start));
        add_sample(figures, "animate", animated);
        add_sample(figures, "all threads", cpu_ms() - cpu_start);
        for (const FrameStats::Stage& stage : frame_stats(renderer).stages)
            add_sample(figures, "gpu " + stage.name, stage.gpu_ms);
    }
    add_counts(figures, frame_stats(renderer));
    animate(d, k_compared_frame);
    return draw(renderer, options, frame_of(d, is_finest));
}

// One for each mode; none where nobody asked for pictures.
Result<std::vector<PartFilePtr>> open_pictures(const Options& options) {
    std::vector<PartFilePtr> files;
    if (options.out.empty()) return files;
    for (const Mode& mode : k_modes) {
        Result<PartFilePtr> file = open_file(options.out + "/peers_" + std::to_string(options.bench_count) +
                                             (mode.is_finest ? "_all.png" : "_lod.png"));
        if (!file) return file.error();
        files.push_back(std::move(*file));
    }
    return files;
}

}  // namespace

Result<Figures> bench_peers(const Options& options) {
    Result<std::vector<PartFilePtr>> files = open_pictures(options);
    if (!files) return files.error();
    Result<Dancers> dancers = make_dancers(options);
    if (!dancers) return dancers.error();
    std::atomic<uint32_t> messages = 0;
    RendererOptions drawing = renderer_options(options, messages);
    drawing.quality = Quality::medium;  // the scene is drawn with one sample a pixel
    Result<RendererPtr> renderer = make_renderer(drawing);
    if (!renderer) return renderer.error();
    if (Result<void> done = upload_scene(**renderer, scene_of(*dancers)); !done) return done.error();

    const auto* known =
        std::find(std::begin(k_counts), std::end(k_counts), static_cast<int>(options.bench_count));
    const size_t column = static_cast<size_t>(known - std::begin(k_counts));
    const bool is_known = known != std::end(k_counts);
    Figures both;
    std::vector<Image> images;
    for (const Mode& mode : k_modes) {
        Figures figures;
        figures.setting = {{"characters", options.bench_count},
                           {"drawn", mode.name},
                           {"device", device_name(**renderer)},
                           {"measured", options.bench_frames}};
        Result<Image> image = measure(*dancers, **renderer, options, mode.is_finest, figures);
        if (!image) return image.error();
        if (is_known) figures.counts.emplace_back("goal, ms", mode.goals[column]);
        print_figures(figures);
        std::printf("\n");
        both.setting = figures.setting;
        std::erase_if(both.setting, [](const auto& one) { return one.first == "drawn"; });
        const std::string prefix = std::string(mode.name) + "/";
        for (Series& series : figures.series) {
            series.name.insert(0, prefix);
            if (!series.within.empty()) series.within.insert(0, prefix);
            both.series.push_back(std::move(series));
        }
        for (auto& [name, value] : figures.counts) both.counts.emplace_back(prefix + name, value);
        images.push_back(std::move(*image));
        if (files->empty()) continue;
        Result<void> kept =
            write_png(std::move((*files)[images.size() - 1]), images.back().rgba, options.scene.size);
        if (!kept) return kept.error();
    }
    const double difference = mean_flip(images[0].rgba, images[1].rgba, options.scene.size.width);
    std::printf("%-36s %9.4f (goal 0.02)\n", "mean FLIP between the two", difference);
    both.counts.emplace_back("mean FLIP between the two", difference);
    if (Result<void> quiet = check_messages(messages); !quiet) return quiet.error();
    return both;
}

}  // namespace flaneur
