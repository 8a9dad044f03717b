#include "assets/trajectories/formats/hdf5.h"

#include <algorithm>
#include <cstring>

#include "assets/files/file.h"

namespace flaneur {
namespace {

// Bounds of what a sound file of this kind has, so that circles in one that is not come to an end.
constexpr int k_most_messages = 4096, k_most_blocks = 64, k_most_nodes = 4096;

const Error k_cut{"is cut short, or broken: as HDF5 it points to what is not there"};

Error unused_hdf(const std::string& what) {
    return Error{
        "has " + what +
        ", which is not read; `h5repack -l CONTI -f NONE IN OUT`, of Debian's hdf5-tools, writes data "
        "sets in one piece"};
}

// Little-endian, as all of HDF5's own numbers are. `fails` once something outside was asked for.
struct HdfBytes {
    std::string_view all;
    bool fails = false;

    std::string_view piece(uint64_t at, uint64_t size) {
        if (at > all.size() || size > all.size() - at) {
            fails = true;
            return {};
        }
        return all.substr(at, size);
    }
    uint64_t number(uint64_t at, uint64_t size) {
        const std::string_view bytes = piece(at, size);
        uint64_t value = 0;
        for (size_t i = bytes.size(); i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[i]);
        return value;
    }
    bool has(uint64_t at, std::string_view mark) { return piece(at, mark.size()) == mark; }
    // Up to a zero, within `size` bytes.
    std::string_view text(uint64_t at, uint64_t size) {
        if (at > all.size()) {
            fails = true;
            return {};
        }
        const std::string_view bytes = all.substr(at, size);
        const size_t end = bytes.find('\0');
        if (end == std::string_view::npos) fails = true;
        return bytes.substr(0, end);
    }
};

constexpr uint64_t padded(uint64_t size) { return (size + 7) / 8 * 8; }

enum class HdfClass : uint8_t { whole = 0, real = 1, text = 3, compound = 6, variable = 9 };

struct HdfType {
    HdfClass kind{};
    uint32_t size = 0, bits = 0;
};

HdfType type_at(HdfBytes& file, uint64_t at) {
    const uint64_t word = file.number(at, 4);
    return {static_cast<HdfClass>(word & 15), static_cast<uint32_t>(file.number(at + 4, 4)),
            static_cast<uint32_t>(word >> 8)};
}

bool is_number(const HdfType& type) {
    const bool big_endian = (type.bits & 1) != 0;
    if (type.kind == HdfClass::real) return !big_endian && (type.size == 4 || type.size == 8);
    return type.kind == HdfClass::whole && !big_endian && (type.size == 4 || type.size == 8);
}

double number_of(std::string_view bytes, bool is_float, bool is_signed) {
    if (is_float && bytes.size() == 4) {
        float value = 0;
        std::memcpy(&value, bytes.data(), 4);
        return static_cast<double>(value);
    }
    if (is_float) {
        double value = 0;
        std::memcpy(&value, bytes.data(), 8);
        return value;
    }
    uint64_t value = 0;
    std::memcpy(&value, bytes.data(), bytes.size());
    if (!is_signed) return static_cast<double>(value);
    return bytes.size() == 4 ? static_cast<double>(static_cast<int32_t>(value))
                             : static_cast<double>(static_cast<int64_t>(value));
}

Result<void> read_compound(HdfBytes& file, uint64_t at, HdfObject& object) {
    const uint32_t version = static_cast<uint32_t>(file.number(at, 1)) >> 4;
    const HdfType whole = type_at(file, at);
    if (whole.kind != HdfClass::compound) return {};  // a data set of something else
    object.row_size = whole.size;
    const uint32_t members = whole.bits & 0xffff;
    uint64_t next = at + 8;
    for (uint32_t i = 0; i < members; ++i) {
        HdfField field;
        field.name = file.text(next, 256);
        next += version < 3 ? padded(field.name.size() + 1) : field.name.size() + 1;
        // Version 3 has as many bytes of an offset as the size of a row needs.
        const uint32_t wide = version < 3             ? 4
                              : whole.size < 1u << 8  ? 1
                              : whole.size < 1u << 16 ? 2
                              : whole.size < 1u << 24 ? 3
                                                      : 4;
        field.offset = static_cast<uint32_t>(file.number(next, wide));
        next += wide;
        if (version == 1) next += 28;  // dimensions, of which there are none
        const HdfType type = type_at(file, next);
        if (file.fails) return k_cut;
        if (!is_number(type))
            return unused_hdf("the column " + excerpt(field.name) +
                              " of no numbers of 4 or 8 bytes, least first");
        next += 8 + (type.kind == HdfClass::whole ? 4 : 12);
        field.size = type.size;
        field.is_float = type.kind == HdfClass::real;
        field.is_signed = (type.bits & 8) != 0;
        if (field.offset > whole.size || field.size > whole.size - field.offset) return k_cut;
        object.fields.push_back(std::move(field));
    }
    return {};
}

// What a text of variable length refers to in the global heap.
std::string_view heap_text(HdfBytes& file, uint64_t at) {
    const uint64_t size = file.number(at, 4), heap = file.number(at + 4, 8), index = file.number(at + 12, 4);
    if (!file.has(heap, "GCOL")) {
        file.fails = true;
        return {};
    }
    const uint64_t end = std::min<uint64_t>(file.number(heap + 8, 8), file.all.size());
    uint64_t next = heap + 16;
    for (int i = 0; i < k_most_messages && next < heap + end && !file.fails; ++i) {
        const uint64_t length = file.number(next + 8, 8);
        if (file.number(next, 2) == index) return file.piece(next + 16, std::min(length, size));
        if (length > file.all.size()) break;
        next += 16 + padded(length);
    }
    file.fails = true;
    return {};
}

// Those that are neither numbers nor texts are passed over.
void read_attribute(HdfBytes& file, uint64_t at, HdfObject& object) {
    const uint64_t version = file.number(at, 1);
    const uint64_t sizes[3] = {file.number(at + 2, 2), file.number(at + 4, 2), file.number(at + 6, 2)};
    uint64_t next = at + (version == 3 ? 9 : 8);
    uint64_t begins[4];
    for (int i = 0; i < 3; ++i) {
        begins[i] = next;
        next += version == 1 ? padded(sizes[i]) : sizes[i];
    }
    begins[3] = next;
    HdfAttribute attribute;
    attribute.name = file.text(begins[0], sizes[0]);
    const HdfType type = type_at(file, begins[1]);
    if (is_number(type)) {
        const std::string_view bytes = file.piece(begins[3], type.size);
        if (file.fails) return;
        attribute.number = number_of(bytes, type.kind == HdfClass::real, (type.bits & 8) != 0);
    } else if (type.kind == HdfClass::text)
        attribute.text =
            file.piece(begins[3], type.size).substr(0, file.piece(begins[3], type.size).find('\0'));
    else if (type.kind == HdfClass::variable && (type.bits & 15) == 1)
        attribute.text = heap_text(file, begins[3]);
    else
        return;
    object.attributes.push_back(std::move(attribute));
}

Result<void> read_message(HdfBytes& file, uint64_t type, uint64_t at, HdfObject& object) {
    switch (type) {
        case 0x01: {  // data space
            const uint64_t version = file.number(at, 1), rank = file.number(at + 1, 1);
            object.rows = rank == 1 ? file.number(at + (version == 1 ? 8 : 4), 8) : 0;
            return {};
        }
        case 0x03:
            return read_compound(file, at, object);
        case 0x08:  // layout
            if (file.number(at, 1) != 3 || file.number(at + 1, 1) != 1)
                return unused_hdf("a data set in several pieces");
            object.values = file.piece(file.number(at + 2, 8), file.number(at + 10, 8));
            return {};
        case 0x0b:
            return unused_hdf("a data set that went through filters");
        case 0x0c:
            read_attribute(file, at, object);
            return {};
        case 0x11:  // symbol table
            object.tree = file.number(at, 8);
            object.heap = file.number(at + 8, 8);
            return {};
        default:
            return {};
    }
}

Result<HdfObject> object_at(HdfBytes& file, uint64_t at) {
    HdfObject object;
    if (file.number(at, 1) != 1) return unused_hdf("an object of a newer kind");
    struct Block {
        uint64_t at, size;
    };
    std::vector<Block> blocks{{at + 16, file.number(at + 8, 4)}};
    int messages = 0;
    for (size_t b = 0; b < blocks.size() && b < k_most_blocks && !file.fails; ++b) {
        (void)file.piece(blocks[b].at, blocks[b].size);
        for (uint64_t next = 0; next + 8 <= blocks[b].size && messages < k_most_messages && !file.fails;
             ++messages) {
            const uint64_t message = blocks[b].at + next;
            const uint64_t type = file.number(message, 2), size = file.number(message + 2, 2);
            next += 8 + size;
            if (next > blocks[b].size) return k_cut;
            if (type == 0x10)
                blocks.push_back({file.number(message + 8, 8), file.number(message + 16, 8)});
            else if (Result<void> read = read_message(file, type, message + 8, object); !read)
                return read.error();
        }
    }
    if (file.fails) return k_cut;
    if (!object.fields.empty() &&
        (object.row_size == 0 || object.rows > object.values.size() / object.row_size))
        return k_cut;
    return object;
}

}  // namespace

Result<HdfObject> hdf_root(std::string_view bytes) {
    HdfBytes file{bytes};
    if (!file.has(0, "\x89HDF\r\n\x1a\n")) return Error{"is no HDF5 file"};
    const uint64_t version = file.number(8, 1);
    if (version > 1) return unused_hdf("a superblock of a newer kind");
    if (file.number(13, 1) != 8 || file.number(14, 1) != 8)
        return unused_hdf("addresses that are not of 8 bytes");
    return object_at(file, file.number(version == 0 ? 64 : 68, 8));
}

Result<HdfObject> hdf_member(std::string_view bytes, const HdfObject& group, std::string_view name) {
    HdfBytes file{bytes};
    if (group.tree == 0 || !file.has(group.heap, "HEAP")) return unused_hdf("a group of a newer kind");
    const uint64_t names = file.number(group.heap + 24, 8);
    std::vector<uint64_t> nodes{group.tree};
    for (size_t n = 0; n < nodes.size() && n < k_most_nodes && !file.fails; ++n) {
        const uint64_t node = nodes[n];
        if (file.has(node, "TREE")) {
            const uint64_t used = file.number(node + 6, 2);
            for (uint64_t i = 0; i < used && !file.fails; ++i)
                nodes.push_back(file.number(node + 32 + 16 * i, 8));
        } else if (file.has(node, "SNOD")) {
            const uint64_t used = file.number(node + 6, 2);
            for (uint64_t i = 0; i < used && !file.fails; ++i) {
                const uint64_t entry = node + 8 + 40 * i;
                if (names <= file.all.size() && file.text(names + file.number(entry, 8), 256) == name &&
                    !file.fails)
                    return object_at(file, file.number(entry + 8, 8));
            }
        } else {
            file.fails = true;
        }
    }
    if (file.fails) return k_cut;
    return Error{"has nothing that is called " + std::string(name)};
}

const HdfField* field_of(const HdfObject& object, std::string_view name) {
    const auto found = std::find_if(object.fields.begin(), object.fields.end(),
                                    [&](const HdfField& field) { return field.name == name; });
    return found == object.fields.end() ? nullptr : &*found;
}

const HdfAttribute* attribute_of(const HdfObject& object, std::string_view name) {
    const auto found = std::find_if(object.attributes.begin(), object.attributes.end(),
                                    [&](const HdfAttribute& attribute) { return attribute.name == name; });
    return found == object.attributes.end() ? nullptr : &*found;
}

double number_at(const HdfObject& object, const HdfField& field, uint64_t row) {
    return number_of(object.values.substr(row * object.row_size + field.offset, field.size), field.is_float,
                     field.is_signed);
}

}  // namespace flaneur
