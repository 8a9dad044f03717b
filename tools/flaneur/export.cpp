#include "assets/files/file.h"
#include "assets/scene.h"
#include "assets/trajectories/write.h"
#include "tools/flaneur/commands.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/export/motion.h"
#include "tools/flaneur/export/tracks.h"
#include "tools/flaneur/output/output.h"
#include "tools/flaneur/tracks/record.h"

namespace flaneur {

Result<void> run_export(const Options& asked) {
    Options options = asked;
    const bool is_file = !options.file.empty();
    const bool is_motion = has_ending(options.out, ".glb") || has_ending(options.out, ".bvh");
    if (!is_motion && !trajectory_format_of(options.out))
        return Error{printable(options.out) +
                     " has no ending that tells its format: of motion .glb or .bvh, of places .sqlite, .txt, "
                     ".csv, .xml (.fcd.xml), .geojson (.json) or .traj."};
    if (is_small_world(options.scene) && !is_file && !is_motion)
        return Error{"Places in " + printable(options.out) +
                     " are of a ground plane, and here people walk all round: take a .glb or a .bvh."};
    if (is_file)
        if (Result<void> found = find_file(options.file); !found) return found;
    Result<PartFilePtr> file = is_motion ? open_file(options.out) : open_tracks(options.out);
    if (!file) return file.error();
    if (!is_motion && is_file) return export_file(options, std::move(*file));
    if (is_file) options.scene = scene_of_trajectories(options.file);
    if (!is_motion) return export_tracks(options, std::move(*file));
#ifdef FLANEUR_VULKAN
    return export_motion(options, std::move(*file));
#else
    return Error{
        "This flaneur was built without Vulkan, and has no bodies to write: of places it writes all."};
#endif
}

}  // namespace flaneur
