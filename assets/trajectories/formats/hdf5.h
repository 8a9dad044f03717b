// What of HDF5 the Juelich data archive uses, after the "HDF5 File Format Specification", version 2.0: groups
// of the old kind in a file of superblock 0 or 1, data sets of one dimension whose values lie in one piece,
// compounds of numbers, attributes that are numbers or texts. All else is refused, by name; nothing that a
// file says about itself is believed. The bytes must outlive what refers to them. Private to
// assets/trajectories.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/result.h"

namespace flaneur {

struct HdfField {
    std::string name;
    uint32_t offset = 0, size = 0;  // bytes, within a row
    bool is_float = false, is_signed = false;
};

struct HdfAttribute {
    std::string name, text;  // text: of texts
    double number = 0;       // of numbers
};

// A group or a data set.
struct HdfObject {
    std::vector<HdfAttribute> attributes;
    std::vector<HdfField> fields;  // of a row
    uint64_t rows = 0;
    uint32_t row_size = 0;        // bytes
    std::string_view values;      // all rows
    uint64_t tree = 0, heap = 0;  // of a group: where its members stand; 0: it is none
};

// Errors' sentences have no subject.
Result<HdfObject> hdf_root(std::string_view bytes);
// A member of a group.
Result<HdfObject> hdf_member(std::string_view bytes, const HdfObject& group, std::string_view name);

const HdfField* field_of(const HdfObject& object, std::string_view name);
const HdfAttribute* attribute_of(const HdfObject& object, std::string_view name);

// A field of a row, below `rows`.
double number_at(const HdfObject& object, const HdfField& field, uint64_t row);

}  // namespace flaneur
