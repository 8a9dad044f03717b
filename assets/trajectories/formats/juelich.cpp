// HDF5 as the data archive of the Forschungszentrum Juelich has it, version 1.0.0 of its files.
#include <cmath>

#include "assets/trajectories/formats.h"
#include "assets/trajectories/formats/hdf5.h"
#include "assets/trajectories/wkt.h"

namespace flaneur {

Result<FoundTracks> parse_juelich(const TrajectorySource& source) {
    const std::string_view bytes = source.text;
    Result<HdfObject> root = hdf_root(bytes);
    if (!root) return root.error();
    Result<HdfObject> rows = hdf_member(bytes, *root, "trajectory");
    if (!rows) return rows.error();
    FoundTracks found;
    found.format = "HDF5 of the Juelich data archive";
    found.is_in_frames = true;
    found.unit = 1;
    const HdfAttribute* fps = attribute_of(*rows, "fps");
    if (!fps) return Error{"does not say how many frames a second it has"};
    found.fps = fps->number;
    if (!(found.fps > 0)) return Error{"has a rate of frames that is not from 0 to 1000 a second"};
    if (const HdfAttribute* wkt = attribute_of(*root, "wkt_geometry")) {
        Result<std::vector<WalkablePolygon>> area = parse_wkt(wkt->text);
        if (!area) return area.error();
        found.area = std::move(*area);
    }
    const HdfField *frame = field_of(*rows, "frame"), *id = field_of(*rows, "id"), *x = field_of(*rows, "x"),
                   *y = field_of(*rows, "y"), *z = field_of(*rows, "z");
    if (!frame || !id || !x || !y) return Error{"has a trajectory without the columns id, frame, x and y"};
    found.has_heights = z != nullptr;
    for (uint64_t row = 0; row < rows->rows; ++row) {
        const double who = number_at(*rows, *id, row);
        if (!(who >= -9e15 && who < 9e15)) return Error{"has somebody with no number"};
        const float height = z ? static_cast<float>(number_at(*rows, *z, row)) : 0;
        Result<void> added = add_row(found, {.time = number_at(*rows, *frame, row),
                                             .x = number_at(*rows, *x, row),
                                             .y = number_at(*rows, *y, row),
                                             .z = std::isfinite(height) ? height : 0,
                                             .who = who_is(found, static_cast<int64_t>(who)),
                                             .facing = {}});
        if (!added) return Error{"has " + added.error().message};
    }
    return found;
}

}  // namespace flaneur
