#include "tests/assets/trajectories/tiny_hdf5.h"

#include <cstring>

namespace flaneur {
namespace {

struct HdfMaker {
    std::string bytes;

    void put(uint64_t value, int size) {
        for (int i = 0; i < size; ++i) bytes += static_cast<char>(value >> 8 * i);
    }
    void text(std::string_view text, size_t size) {
        bytes += text;
        bytes.append(size - text.size(), '\0');
    }
    void fill(size_t to) { bytes.resize(to); }
};

constexpr uint64_t k_nowhere = ~uint64_t{0};
constexpr size_t k_root = 0x60, k_tree = 0x600, k_heap = 0x700, k_names = 0x740, k_node = 0x780,
                 k_set = 0x800, k_values = 0xc00;

size_t padded_size(size_t size) { return (size + 7) / 8 * 8; }

// Type, then size of the message that follows.
void message(HdfMaker& m, int type, const std::string& body) {
    m.put(static_cast<uint64_t>(type), 2);
    m.put(padded_size(body.size()), 2);
    m.put(0, 4);
    m.text(body, padded_size(body.size()));
}

std::string number_type(bool is_float) {
    HdfMaker m;
    m.put(is_float ? 0x3f2011 : 0x0810, 4);
    m.put(8, 4);
    m.put(0x400000, 4);
    if (is_float) m.put(0x03ff000034000b34, 8);
    return m.bytes;
}

std::string attribute(std::string_view name, const std::string& type, const std::string& value) {
    HdfMaker m;
    m.put(1, 2);
    m.put(name.size() + 1, 2);
    m.put(type.size(), 2);
    m.put(8, 2);
    m.text(name, padded_size(name.size() + 1));
    m.text(type, padded_size(type.size()));
    m.put(1, 8);  // one value
    m.bytes += value;
    return m.bytes;
}

void object(HdfMaker& m, const std::string& messages, uint64_t count) {
    m.put(1, 2);
    m.put(count, 2);
    m.put(1, 4);
    m.put(messages.size(), 8);
    m.bytes += messages;
}

}  // namespace

std::string tiny_hdf5(const std::vector<HdfRow>& rows, double fps, std::string_view wkt) {
    HdfMaker file, root, set;
    file.text("\x89HDF\r\n\x1a\n", 8);
    file.put(0, 5);
    file.put(0x0808, 3);
    file.put(0x00100004, 4);
    file.put(0, 4);
    for (uint64_t address :
         {uint64_t{0}, k_nowhere, k_values + 40 * rows.size(), k_nowhere, uint64_t{0}, uint64_t{k_root}})
        file.put(address, 8);
    file.fill(k_root);
    HdfMaker table, text_type;
    table.put(k_tree, 8);
    table.put(k_heap, 8);
    text_type.put(0x13, 4);
    text_type.put(wkt.size(), 4);
    message(root, 0x11, table.bytes);
    message(root, 0x0c, attribute("wkt_geometry", text_type.bytes, std::string(wkt)));
    object(file, root.bytes, 2);

    file.fill(k_tree);
    file.text("TREE", 8);
    file.bytes[k_tree + 6] = 1;
    for (uint64_t word : {k_nowhere, k_nowhere, uint64_t{0}, uint64_t{k_node}, uint64_t{8}})
        file.put(word, 8);
    file.fill(k_heap);
    file.text("HEAP", 8);
    for (uint64_t word : {uint64_t{32}, uint64_t{1}, uint64_t{k_names}}) file.put(word, 8);
    file.fill(k_names + 8);
    file.text("trajectory", 11);
    file.fill(k_node);
    file.text("SNOD\1", 6);
    file.put(1, 2);
    for (uint64_t word : {uint64_t{8}, uint64_t{k_set}}) file.put(word, 8);
    file.fill(k_set);

    HdfMaker space, type, layout;
    space.put(0x0101, 8);
    space.put(rows.size(), 8);
    type.put(0x0516, 4);
    type.put(40, 4);
    uint64_t offset = 0;
    for (std::string_view name : {"id", "frame", "x", "y", "z"}) {
        type.text(name, 8);
        type.put(offset, 4);
        type.text("", 28);
        type.bytes += number_type(offset >= 16);
        offset += 8;
    }
    layout.put(0x0103, 2);
    layout.put(k_values, 8);
    layout.put(40 * rows.size(), 8);
    std::string rate(8, '\0');
    std::memcpy(rate.data(), &fps, 8);
    message(set, 0x01, space.bytes);
    message(set, 0x03, type.bytes);
    message(set, 0x08, layout.bytes);
    message(set, 0x0c, attribute("fps", number_type(true), rate));
    object(file, set.bytes, 4);
    file.fill(k_values);
    for (const HdfRow& row : rows) {
        char bytes[40];
        std::memcpy(bytes, &row, sizeof bytes);
        file.bytes.append(bytes, sizeof bytes);
    }
    return file.bytes;
}

}  // namespace flaneur
