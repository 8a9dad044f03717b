#include "assets/gltf/meshopt.h"

#include <meshoptimizer.h>

namespace flaneur {

namespace {

constexpr const char* k_extension = "EXT_meshopt_compression";

Result<Bytes> decode(const Json& from, const std::vector<Bytes>& buffers, size_t room,
                     const std::string& what) {
    size_t buffer = whole_number(from, "buffer"), offset = whole_number(from, "byteOffset", 0),
           length = whole_number(from, "byteLength"), stride = whole_number(from, "byteStride"),
           count = whole_number(from, "count");
    std::string mode = text(from, "mode"), filter = text(from, "filter");
    bool inside = buffer < buffers.size() && offset <= buffers[buffer].size() &&
                  length <= buffers[buffer].size() - offset;
    bool vertices = mode == "ATTRIBUTES", triangles = mode == "TRIANGLES", indices = mode == "INDICES";
    bool good = inside && (vertices ? stride >= 4 && stride <= 256 && stride % 4 == 0
                                    : (triangles || indices) && (stride == 2 || stride == 4));
    if (triangles) good = good && count % 3 == 0;
    if (!good)
        return Error{what + " is compressed in a way that cannot be read; export it without compression"};
    if (count > room / stride) return Error{what + " claims more than a character needs; simplify it"};

    Bytes out(count * stride);
    const unsigned char* source = buffers[buffer].data() + offset;
    int failed = vertices    ? meshopt_decodeVertexBuffer(out.data(), count, stride, source, length)
                 : triangles ? meshopt_decodeIndexBuffer(out.data(), count, stride, source, length)
                             : meshopt_decodeIndexSequence(out.data(), count, stride, source, length);
    if (failed) return Error{what + " has broken compressed data; export it again"};
    if (filter == "OCTAHEDRAL" && vertices && (stride == 4 || stride == 8))
        meshopt_decodeFilterOct(out.data(), count, stride);
    else if (filter == "QUATERNION" && vertices && stride == 8)
        meshopt_decodeFilterQuat(out.data(), count, stride);
    else if (filter == "EXPONENTIAL" && vertices)
        meshopt_decodeFilterExp(out.data(), count, stride);
    else if (!filter.empty() && filter != "NONE")
        return Error{what + " has a compression filter that does not fit; export it without compression"};
    return out;
}

}  // namespace

Result<void> decode_meshopt(Json& gltf, std::vector<Bytes>& buffers) {
    if (!member(gltf, "bufferViews").is_array()) return {};
    size_t room = k_most_gltf_bytes, index = 0;
    for (Json& view : gltf["bufferViews"]) {
        std::string what = "buffer view " + std::to_string(index++);
        const Json& from = member(member(view, "extensions"), k_extension);
        if (!from.is_object()) continue;
        auto bytes = decode(from, buffers, room, what);
        if (!bytes) return bytes.error();
        room -= bytes->size();
        size_t stride = whole_number(from, "byteStride");
        bool vertices = text(from, "mode") == "ATTRIBUTES";
        view = {{"buffer", buffers.size()}, {"byteLength", bytes->size()}};
        if (vertices) view["byteStride"] = stride;
        buffers.push_back(std::move(*bytes));
    }
    return {};
}

}  // namespace flaneur
