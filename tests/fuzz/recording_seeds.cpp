// recording_seeds FOLDER: a small recording, and chunks, for the fuzzer to begin with.
#include <memory>

#include "assets/recording/recorder.h"
#include "tests/fuzz/seeds.h"

int main(int argc, char** argv) {
    using namespace flaneur;
    const std::filesystem::path folder = seeds_folder(argc, argv);
    const BoneTree trees[] = {bone_tree_of(standard_body(1.7f)), rigid_tree()};
    Result<RecorderPtr> recorder = begin_recorder((folder / "a.flr").string(), "{}");
    if (!recorder) return 1;
    for (const BoneTree& tree : trees) add_tree(**recorder, tree);
    auto frames = std::make_unique<MotionFrames>();
    std::vector<PoseBlock> poses(1);
    for (auto& row : poses[0].rotation)
        for (float& w : row[3]) w = 1;
    const BodyMember body{{1, 0, 0, 1}, 0};
    for (uint32_t t = 0; t < 48; ++t) {
        poses[0].rotation[left_lower_leg][0][0] = static_cast<float>(t % 12) * 0.05f;
        const RigidMember car{{2, 0, 1, 1}, {static_cast<float>(t), 0, 0}, Quat{}};
        if (!add_tick(**recorder, t, poses, {&body, 1}, {&car, 1})) return 1;
        take_poses(poses, {&body, 1}, {&car, 1}, frames->frames[t]);
    }
    frames->ticks = 48;
    const WorkersPtr workers = make_workers(1);
    write_seed(folder / "motion", encode_motion(*frames, trees, {}, nullptr, *workers).bytes);
    write_seed(folder / "trees", encode_trees(trees));
    if (!finish_recorder(std::move(*recorder))) return 1;
}
