#include "assets/gltf/accessor.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace flaneur {

namespace {

struct Located {
    const unsigned char* data = nullptr;  // null: all zero
    size_t stride = 0;
};

// Where `count` elements of `size` bytes lie, checked against view and buffer.
Result<Located> locate(const tinygltf::Model& model, int view_index, size_t offset, size_t count, size_t size,
                       size_t accessor_stride, const std::string& what) {
    if (view_index < 0) return Located{nullptr, size};
    if (size_t(view_index) >= model.bufferViews.size())
        return Error{what + " names buffer view " + std::to_string(view_index) + ", which does not exist"};
    const tinygltf::BufferView& view = model.bufferViews[size_t(view_index)];
    if (view.buffer < 0 || size_t(view.buffer) >= model.buffers.size())
        return Error{what + " names a buffer that does not exist"};
    const auto& buffer = model.buffers[size_t(view.buffer)].data;
    size_t stride = view.byteStride ? view.byteStride : accessor_stride;
    bool fits = view.byteOffset <= buffer.size() && view.byteLength <= buffer.size() - view.byteOffset &&
                stride >= size && offset <= view.byteLength && stride < (size_t{1} << 20);
    if (fits && count > 0) fits = (count - 1) * stride + size <= view.byteLength - offset;
    if (!fits) return Error{what + " reaches beyond its buffer"};
    return Located{buffer.data() + view.byteOffset + offset, stride};
}

double component(const unsigned char* p, int type, bool normalized) {
    auto get = [p](auto zero) {
        std::memcpy(&zero, p, sizeof zero);
        return zero;
    };
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE: {
            double v = get(int8_t{});
            return normalized ? std::max(v / 127, -1.0) : v;
        }
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return get(uint8_t{}) / (normalized ? 255.0 : 1.0);
        case TINYGLTF_COMPONENT_TYPE_SHORT: {
            double v = get(int16_t{});
            return normalized ? std::max(v / 32767, -1.0) : v;
        }
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return get(uint16_t{}) / (normalized ? 65535.0 : 1.0);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return get(uint32_t{});
        default:
            return double(get(float{}));
    }
}

struct Layout {
    const tinygltf::Accessor* accessor;
    int components;
    size_t component_size, element_size;
};

Result<Layout> layout_of(const tinygltf::Model& model, int index, const std::string& what, size_t most) {
    if (index < 0 || size_t(index) >= model.accessors.size())
        return Error{what + " names accessor " + std::to_string(index) + ", which does not exist"};
    const tinygltf::Accessor& a = model.accessors[size_t(index)];
    int components = tinygltf::GetNumComponentsInType(uint32_t(a.type));
    int size = tinygltf::GetComponentSizeInBytes(uint32_t(a.componentType));
    if (components < 1 || size < 1 || a.componentType == TINYGLTF_COMPONENT_TYPE_DOUBLE)
        return Error{what + " has an unknown component type"};
    if (a.count > most)
        return Error{what + " are " + std::to_string(a.count) + " where at most " + std::to_string(most) +
                     " are of use; simplify it or export it again"};
    return Layout{&a, components, size_t(size), size_t(components) * size_t(size)};
}

// Calls put(element, component, value) for all values, then for the sparse ones.
template <class Put>
Result<void> visit(const tinygltf::Model& model, const Layout& l, const std::string& what, Put&& put) {
    const tinygltf::Accessor& a = *l.accessor;
    auto bytes = locate(model, a.bufferView, a.byteOffset, a.count, l.element_size, l.element_size, what);
    if (!bytes) return bytes.error();
    auto put_element = [&](size_t element, const unsigned char* p) {
        for (int c = 0; c < l.components; ++c)
            put(element, c, component(p + size_t(c) * l.component_size, a.componentType, a.normalized));
    };
    if (bytes->data)
        for (size_t i = 0; i < a.count; ++i) put_element(i, bytes->data + i * bytes->stride);
    if (!a.sparse.isSparse) return {};
    if (a.sparse.count < 0 || size_t(a.sparse.count) > a.count)
        return Error{what + " has a broken sparse part"};
    size_t count = size_t(a.sparse.count);
    int type = a.sparse.indices.componentType, size = tinygltf::GetComponentSizeInBytes(uint32_t(type));
    if (size < 1 || a.sparse.indices.byteOffset < 0 || a.sparse.values.byteOffset < 0)
        return Error{what + " has a broken sparse part"};
    auto indices = locate(model, a.sparse.indices.bufferView, size_t(a.sparse.indices.byteOffset), count,
                          size_t(size), size_t(size), what);
    auto values = locate(model, a.sparse.values.bufferView, size_t(a.sparse.values.byteOffset), count,
                         l.element_size, l.element_size, what);
    if (!indices) return indices.error();
    if (!values) return values.error();
    if (!indices->data || !values->data) return Error{what + " has a broken sparse part"};
    for (size_t i = 0; i < count; ++i) {
        double element = component(indices->data + i * indices->stride, type, false);
        if (!(element >= 0 && element < double(a.count)))
            return Error{what + " has a sparse index out of range"};
        put_element(size_t(element), values->data + i * values->stride);
    }
    return {};
}

}  // namespace

Result<AccessorData> read_accessor(const tinygltf::Model& model, int accessor, const std::string& what,
                                   size_t most) {
    auto layout = layout_of(model, accessor, what, most);
    if (!layout) return layout.error();
    AccessorData data;
    data.components = layout->components;
    data.count = layout->accessor->count;
    // Check the extent before taking the memory: a short file may claim much.
    auto extent = locate(model, layout->accessor->bufferView, layout->accessor->byteOffset, data.count,
                         layout->element_size, layout->element_size, what);
    if (!extent) return extent.error();
    data.values.assign(data.count * size_t(data.components), 0.0f);
    bool finite = true;
    auto done = visit(model, *layout, what, [&](size_t element, int c, double value) {
        auto f = float(value);
        finite = finite && std::isfinite(f);
        data.values[element * size_t(data.components) + size_t(c)] = f;
    });
    if (!done) return done.error();
    if (!finite) return Error{what + " holds numbers that are not finite"};
    return data;
}

Result<std::vector<uint32_t>> read_indices(const tinygltf::Model& model, int accessor,
                                           const std::string& what) {
    auto layout = layout_of(model, accessor, what, k_most_elements);
    if (!layout) return layout.error();
    int type = layout->accessor->componentType;
    bool whole = type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                 type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                 type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    if (layout->components != 1 || !whole) return Error{what + " are not unsigned whole numbers"};
    auto extent = locate(model, layout->accessor->bufferView, layout->accessor->byteOffset,
                         layout->accessor->count, layout->element_size, layout->element_size, what);
    if (!extent) return extent.error();
    std::vector<uint32_t> indices(layout->accessor->count);
    auto done =
        visit(model, *layout, what, [&](size_t i, int, double value) { indices[i] = uint32_t(value); });
    if (!done) return done.error();
    return indices;
}

}  // namespace flaneur
