// HDF5 as the data archive of the Forschungszentrum Juelich has it, version 1.0.0 of its files.
#include <cmath>

#include "assets/trajectories/formats.h"
#include "assets/trajectories/hdf5.h"
#include "assets/trajectories/wkt.h"

namespace flaneur {

Result<Trajectories> parse_juelich(std::string_view bytes) {
    Result<HdfObject> root = hdf_root(bytes);
    if (!root) return root.error();
    Result<HdfObject> rows = hdf_member(bytes, *root, "trajectory");
    if (!rows) return rows.error();
    Trajectories t;
    const HdfAttribute* fps = attribute_of(*rows, "fps");
    if (!fps) return Error{"does not say how many frames a second it has"};
    t.fps = static_cast<float>(fps->number);
    if (const HdfAttribute* wkt = attribute_of(*root, "wkt_geometry")) {
        Result<std::vector<WalkablePolygon>> area = parse_wkt(wkt->text);
        if (!area) return area.error();
        t.area = std::move(*area);
    }
    const HdfField *frame = field_of(*rows, "frame"), *id = field_of(*rows, "id"), *x = field_of(*rows, "x"),
                   *y = field_of(*rows, "y"), *z = field_of(*rows, "z");
    if (!frame || !id || !x || !y) return Error{"has a trajectory without the columns id, frame, x and y"};
    auto whole = [&](const HdfField& field, uint64_t row) {
        const double value = number_at(*rows, field, row);
        return value >= 0 && value < 9e15 ? static_cast<int64_t>(value) : -1;
    };
    for (uint64_t row = 0; row < rows->rows; ++row) {
        Result<void> added = add_sighting(t, whole(*frame, row), whole(*id, row), number_at(*rows, *x, row),
                                          number_at(*rows, *y, row), z ? number_at(*rows, *z, row) : 0);
        if (!added) return Error{"has " + added.error().message};
    }
    return t;
}

}  // namespace flaneur
