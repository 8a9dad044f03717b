#include "assets/gltf/draco.h"

#include <draco/compression/decode.h>

#include <cstring>
#include <memory>
#include <new>

namespace flaneur {

namespace {

constexpr const char* k_extension = "KHR_draco_mesh_compression";
constexpr int k_float = 5126, k_unsigned_int = 5125;  // glTF's component types

// How many numbers an accessor's elements have, 0 if it does not say so.
int components_of(const Json& accessor) {
    std::string type = text(accessor, "type");
    if (type == "SCALAR") return 1;
    return type == "VEC2" ? 2 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 0;
}

struct Decoder {
    Json& gltf;
    std::vector<Bytes>& buffers;
    size_t room = k_most_gltf_bytes;

    // A new accessor over a view and a buffer of its own; its number.
    size_t add(Bytes bytes, const Json& type, int component, size_t count) {
        gltf["bufferViews"].push_back({{"buffer", buffers.size()}, {"byteLength", bytes.size()}});
        gltf["accessors"].push_back({{"bufferView", gltf["bufferViews"].size() - 1},
                                     {"componentType", component},
                                     {"count", count},
                                     {"type", type}});
        buffers.push_back(std::move(bytes));
        return gltf["accessors"].size() - 1;
    }

    Result<std::unique_ptr<draco::Mesh>> mesh_of(const Json& from, const std::string& what) const {
        const Json& view = element(member(gltf, "bufferViews"), whole_number(from, "bufferView"));
        size_t buffer = whole_number(view, "buffer"), offset = whole_number(view, "byteOffset", 0),
               length = whole_number(view, "byteLength");
        bool inside = buffer < buffers.size() && offset <= buffers[buffer].size() &&
                      length <= buffers[buffer].size() - offset;
        if (!inside) return Error{what + " names compressed data that is not there; export it again"};
        draco::DecoderBuffer bytes;
        bytes.Init(reinterpret_cast<const char*>(buffers[buffer].data()) + offset, length);
        auto mesh = draco::Decoder().DecodeMeshFromBuffer(&bytes);
        if (!mesh.ok()) return Error{what + " has broken compressed data; export it again"};
        return std::move(mesh).value();
    }

    Result<void> decode(Json& primitive, const std::string& what) {
        const Json from = member(member(primitive, "extensions"), k_extension);
        if (!from.is_object()) return {};
        auto mesh = mesh_of(from, what);
        if (!mesh) return mesh.error();
        size_t points = (*mesh)->num_points(), faces = (*mesh)->num_faces();
        Error too_much{what + " unpacks to more than can be taken in; simplify it"};
        for (const auto& [name, id] : member(from, "attributes").items()) {
            size_t old = whole_number(member(primitive, "attributes"), name.c_str());
            const Json& accessor = element(member(gltf, "accessors"), old);
            int components = components_of(accessor);
            const auto* values =
                id.is_number_unsigned() ? (*mesh)->GetAttributeByUniqueId(id.get<uint32_t>()) : nullptr;
            if (components == 0 || !values || values->num_components() < components)
                return Error{std::string(what)
                                 .append(" has compressed ")
                                 .append(name)
                                 .append(" that does not fit; export it again")};
            size_t each = size_t(components) * sizeof(float);
            if (points > room / each) return too_much;
            Bytes bytes(points * each);
            room -= bytes.size();
            for (uint32_t i = 0; i < points; ++i) {
                float out[4] = {};
                auto index = values->mapped_index(draco::PointIndex(i));
                if (index.value() >= values->size() ||
                    !values->ConvertValue<float>(index, int8_t(components), out))
                    return Error{what + " has broken compressed data; export it again"};
                std::memcpy(&bytes[i * each], out, each);
            }
            Json type = accessor["type"];
            primitive["attributes"][name] = add(std::move(bytes), type, k_float, points);
        }
        if (faces > room / (3 * sizeof(uint32_t))) return too_much;
        Bytes bytes(faces * 3 * sizeof(uint32_t));
        room -= bytes.size();
        for (uint32_t f = 0; f < faces; ++f)
            for (size_t k = 0; k < 3; ++k) {
                uint32_t point = (*mesh)->face(draco::FaceIndex(f))[int(k)].value();
                std::memcpy(&bytes[(3 * size_t{f} + k) * sizeof point], &point, sizeof point);
            }
        primitive["indices"] = add(std::move(bytes), "SCALAR", k_unsigned_int, faces * 3);
        primitive["mode"] = 4;  // triangles, whatever they were before
        return {};
    }
};

}  // namespace

Result<void> decode_draco(Json& gltf, std::vector<Bytes>& buffers) {
    if (!member(gltf, "meshes").is_array() || !member(gltf, "bufferViews").is_array() ||
        !member(gltf, "accessors").is_array())
        return {};
    Decoder decoder{gltf, buffers};
    try {
        for (size_t m = 0; m < gltf["meshes"].size(); ++m) {
            auto primitives = gltf["meshes"][m].find("primitives");
            if (primitives == gltf["meshes"][m].end() || !primitives->is_array()) continue;
            for (size_t p = 0; p < primitives->size(); ++p) {
                if (!(*primitives)[p].is_object()) continue;
                std::string what = "mesh " + std::to_string(m) + ", primitive " + std::to_string(p);
                if (auto done = decoder.decode((*primitives)[p], what); !done) return done;
            }
        }
    } catch (const std::bad_alloc&) {
        return Error{"needs more memory than there is"};
    }
    return {};
}

}  // namespace flaneur
