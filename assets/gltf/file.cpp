#include "assets/gltf/file.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <string_view>

#include "assets/gltf/draco.h"
#include "assets/gltf/json.h"
#include "assets/gltf/meshopt.h"

namespace flaneur {

namespace {

// What a parser makes of a value takes some hundred bytes, and of an element of these arrays up to a
// thousand.
constexpr size_t k_most_values = 1'000'000, k_most_depth = 64;
constexpr size_t k_most_views = 131'072, k_most_nodes = 65'536, k_most_skins = 512, k_most_others = 8192;

struct Parts {
    std::string_view json;
    std::span<const uint8_t> binary;
};

uint32_t word(std::span<const uint8_t> bytes, size_t at) {
    return bytes[at] | bytes[at + 1] << 8 | bytes[at + 2] << 16 | uint32_t{bytes[at + 3]} << 24;
}

std::string_view as_text(std::span<const uint8_t> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

constexpr const char* k_old_version = "is glTF 1.0; convert it to glTF 2.0, with Blender or gltf-pipeline";

// glTF 2.0, 4: header, a chunk of JSON, perhaps a chunk of bytes, perhaps others.
Result<Parts> split(std::span<const uint8_t> bytes) {
    if (bytes.size() < 4) return Error{"is no glTF file (it has fewer than four bytes)"};
    if (as_text(bytes.first(4)) != "glTF") {
        std::string_view json = as_text(bytes);
        if (json.starts_with("\xef\xbb\xbf")) json.remove_prefix(3);
        if (json.starts_with("Kaydara FBX") || json.starts_with("; FBX"))
            return Error{"is an FBX file; convert it with Blender or FBX2glTF"};
        if (json.starts_with("PK\x03\x04")) return Error{"is a ZIP archive; unpack it"};
        if (json.starts_with("<"))
            return Error{"is XML; if it is a map of OpenStreetMap, let its name end in .osm"};
        return Parts{json, {}};
    }
    if (bytes.size() < 20) return Error{"is cut short: a .glb file has 20 bytes at least; export it again"};
    if (word(bytes, 4) == 1) return Error{k_old_version};
    if (word(bytes, 4) != 2)
        return Error{"is of .glb version " + std::to_string(word(bytes, 4)) + "; export it as glTF 2.0"};
    if (word(bytes, 8) > bytes.size())
        return Error{"is cut short: " + std::to_string(bytes.size()) + " of " +
                     std::to_string(word(bytes, 8)) + " bytes are there; copy or export it again"};
    std::span<const uint8_t> rest = bytes.first(std::max<size_t>(word(bytes, 8), 12)).subspan(12);
    Parts parts;
    for (int chunk = 0; rest.size() >= 8 && chunk < 2; ++chunk) {
        constexpr uint32_t k_json = 0x4e4f534a, k_binary = 0x004e4942;
        size_t length = word(rest, 0);
        if (length > rest.size() - 8)
            return Error{"has a chunk " + std::to_string(chunk) +
                         " that reaches beyond the file; export it again"};
        if (chunk == 0 && word(rest, 4) != k_json) break;
        if (chunk == 0) parts.json = as_text(rest.subspan(8, length));
        if (chunk == 1 && word(rest, 4) == k_binary) parts.binary = rest.subspan(8, length);
        rest = rest.subspan(8 + length);
    }
    if (parts.json.empty()) return Error{"is a .glb file without JSON; export it again"};
    return parts;
}

Result<void> check_version(const Json& gltf) {
    if (!gltf.is_object() || !member(gltf, "asset").is_object())
        return Error{"is JSON, but no glTF: it has no asset"};
    std::string version = text(gltf["asset"], "version");
    if (version.starts_with("1.")) return Error{k_old_version};
    return {};
}

// Sizes, and that arrays are arrays of objects.
Result<void> check_outline(const Json& gltf) {
    for (const char* name : {"accessors", "animations", "bufferViews", "buffers", "images", "materials",
                             "meshes", "nodes", "scenes", "skins", "textures"}) {
        const Json& array = member(gltf, name);
        if (array.is_null()) continue;
        if (!array.is_array())
            return Error{"has " + std::string(name) + " that are no list; export it again"};
        std::string_view view = name;
        size_t most = view == "accessors" || view == "bufferViews" ? k_most_views
                      : view == "nodes" || view == "meshes"        ? k_most_nodes
                      : view == "skins"                            ? k_most_skins
                                                                   : k_most_others;
        if (array.size() > most)
            return Error{"has " + std::to_string(array.size()) + " " + name +
                         ", more than can be taken in; simplify it"};
        for (size_t i = 0; i < array.size(); ++i)
            if (!array[i].is_object())
                return Error{std::string(name) + "[" + std::to_string(i) + "] is no object; export it again"};
    }
    return {};
}

// What a file may say it cannot do without: what is read, and what only changes how light plays on a surface
// or moves after the pose, without which people and cities are still themselves.
Result<void> check_extensions(const Json& gltf) {
    static constexpr std::string_view k_read[] = {"EXT_meshopt_compression",
                                                  "EXT_texture_webp",
                                                  "KHR_draco_mesh_compression",
                                                  "KHR_materials_emissive_strength",
                                                  "KHR_materials_pbrSpecularGlossiness",
                                                  "KHR_materials_unlit",
                                                  "KHR_materials_variants",
                                                  "KHR_mesh_quantization",
                                                  "KHR_texture_transform",
                                                  "VRM",
                                                  "VRMC_vrm"};
    static constexpr std::string_view k_spared[] = {"KHR_lights_punctual",
                                                    "KHR_materials_anisotropy",
                                                    "KHR_materials_clearcoat",
                                                    "KHR_materials_dispersion",
                                                    "KHR_materials_ior",
                                                    "KHR_materials_iridescence",
                                                    "KHR_materials_sheen",
                                                    "KHR_materials_specular",
                                                    "KHR_materials_transmission",
                                                    "KHR_materials_volume",
                                                    "VRMC_materials_hdr_emissiveMultiplier",
                                                    "VRMC_materials_mtoon",
                                                    "VRMC_node_constraint",
                                                    "VRMC_springBone"};
    for (const Json& entry : member(gltf, "extensionsRequired")) {
        std::string name = entry.is_string() ? entry.get<std::string>() : "?";
        bool fine = std::find(std::begin(k_read), std::end(k_read), name) != std::end(k_read) ||
                    std::find(std::begin(k_spared), std::end(k_spared), name) != std::end(k_spared);
        if (fine) continue;
        bool packed = name == "KHR_texture_basisu";
        return Error{"requires the extension " + excerpt(name) + ", which is not supported; export it " +
                     (packed ? "with PNG, JPEG or WebP textures" : "without it")};
    }
    return {};
}

// The parser cuts numbers to the 32 bits of an int, without a word.
Result<void> check_numbers(const Json& at, const std::string& key) {
    constexpr int64_t k_most = std::numeric_limits<int32_t>::max();
    if (at.is_number_integer() && key != "min" && key != "max") {  // which are values, not counts
        bool fits =
            at.is_number_unsigned() ? at.get<uint64_t>() <= uint64_t(k_most) : at.get<int64_t>() >= -k_most;
        if (!fits)
            return Error{"has a " + excerpt(key) + " of " + at.dump() + ", where at most " +
                         std::to_string(k_most) + " makes sense; export it again"};
    }
    if (!at.is_structured()) return {};
    for (const auto& [name, below] : at.items()) {
        if (at.is_object() && (name == "extras" || name == "extensions")) continue;
        if (auto done = check_numbers(below, at.is_object() ? name : key); !done) return done;
    }
    return {};
}

int sextet(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    return c == '+' || c == '-' ? 62 : c == '/' || c == '_' ? 63 : -1;
}

// RFC 4648, with either alphabet.
Result<Bytes> from_base64(std::string_view text) {
    while (text.ends_with('=')) text.remove_suffix(1);
    Bytes out;
    out.reserve(text.size() / 4 * 3 + 2);
    uint32_t bits = 0;
    int held = 0;
    for (char c : text) {
        int six = sextet(c);
        if (six < 0) return Error{"is not base64"};
        bits = bits << 6 | uint32_t(six);
        held += 6;
        if (held < 8) continue;
        held -= 8;
        out.push_back(uint8_t(bits >> held));
    }
    return out;
}

// %20 and the like.
std::string decoded_uri(std::string_view uri) {
    auto digit = [](char c) {
        return c >= '0' && c <= '9'   ? c - '0'
               : c >= 'a' && c <= 'f' ? c - 'a' + 10
               : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                      : -1;
    };
    std::string out;
    for (size_t i = 0; i < uri.size(); ++i) {
        int high = uri[i] == '%' && i + 2 < uri.size() ? digit(uri[i + 1]) : -1;
        int low = high >= 0 ? digit(uri[i + 2]) : -1;
        out += low >= 0 ? char(high * 16 + low) : uri[i];
        if (low >= 0) i += 2;
    }
    return out;
}

// The file that a URI which is no data stands for, from the folder on.
Result<std::filesystem::path> named_file(const std::string& uri) {
    if (uri.find("://") != std::string::npos)
        return Error{"lies at " + excerpt(uri) + "; nothing is downloaded"};
    std::filesystem::path file = decoded_uri(uri);
    bool climbs = std::find(file.begin(), file.end(), "..") != file.end();
    if (file.is_absolute() || climbs || file.native().find('\0') != std::string::npos)
        return Error{"is in " + excerpt(file.string()) + "; only files in its own folder are read"};
    return file;
}

// What a URI stands for: base64 in itself, or a file in the folder.
Result<Bytes> resolve(const std::string& uri, const std::string& folder, size_t most) {
    if (uri.starts_with("data:")) {
        size_t begin = uri.find(";base64,");
        if (begin == std::string::npos) return Error{"is a data URI that is not base64"};
        return from_base64(std::string_view(uri).substr(begin + 8));
    }
    auto file = named_file(uri);
    if (!file) return file.error();
    auto bytes = read_bytes((std::filesystem::path(folder) / *file).string(), most);
    if (!bytes)
        return Error{"is in the file " + excerpt(file->string()) + ", which " + bytes.error().message};
    return bytes;
}

Result<std::vector<Bytes>> read_buffers(const Json& gltf, std::span<const uint8_t> binary,
                                        const std::string& folder) {
    std::vector<Bytes> buffers;
    size_t room = k_most_gltf_bytes;
    for (const Json& entry : member(gltf, "buffers")) {
        std::string what = "buffer " + std::to_string(buffers.size()), uri = text(entry, "uri");
        size_t length = whole_number(entry, "byteLength");
        if (length == k_no_number || length == 0)
            return Error{what + " does not say how long it is; export it again"};
        Bytes bytes;
        if (!uri.empty()) {
            auto found = resolve(uri, folder, room);
            if (!found) return Error{what + " " + found.error().message};
            bytes = std::move(*found);
        } else if (buffers.empty() && !binary.empty()) {
            bytes.assign(binary.begin(), binary.end());
        } else if (!member(entry, "extensions").is_object()) {  // those have it elsewhere
            return Error{what + " has no data: it names no file; export it again as .glb"};
        }
        if (bytes.size() > room) return Error{"has more than 128 MB of data; simplify it"};
        if (!bytes.empty() && bytes.size() < length)
            return Error{what + " is " + std::to_string(bytes.size()) + " bytes long and not " +
                         std::to_string(length) + ", as it says; export it again"};
        room -= bytes.size();
        bytes.resize(std::min(bytes.size(), length));
        bytes.shrink_to_fit();
        buffers.push_back(std::move(bytes));
    }
    return buffers;
}

// What lacks its texture is still of use: what cannot be had stays empty.
std::vector<Bytes> read_images(const Json& gltf, const std::vector<Bytes>& buffers,
                               const std::string& folder) {
    std::vector<Bytes> images;
    size_t room = k_most_gltf_bytes;
    for (const Json& entry : member(gltf, "images")) {
        Bytes& image = images.emplace_back();
        if (std::string uri = text(entry, "uri"); !uri.empty()) {
            if (auto bytes = resolve(uri, folder, room)) image = std::move(*bytes);
        } else {
            const Json& view = element(member(gltf, "bufferViews"), whole_number(entry, "bufferView"));
            size_t buffer = whole_number(view, "buffer"), offset = whole_number(view, "byteOffset", 0),
                   length = whole_number(view, "byteLength");
            bool inside = buffer < buffers.size() && offset <= buffers[buffer].size() &&
                          length <= std::min(buffers[buffer].size() - offset, room);
            if (inside)
                image.assign(buffers[buffer].begin() + std::ptrdiff_t(offset),
                             buffers[buffer].begin() + std::ptrdiff_t(offset + length));
        }
        if (image.size() > room) image = {};
        room -= image.size();
    }
    return images;
}

// Leaves what characters and cities are made of: what else is in the file need not be sound.
void trim(Json& gltf) {
    static constexpr std::string_view k_kept[] = {
        "accessors", "animations", "asset", "bufferViews", "extensions", "extensionsUsed", "materials",
        "meshes",    "nodes",      "scene", "scenes",      "skins",      "textures"};
    auto drop_others = [](Json& object, auto&& wanted) {
        for (auto it = object.begin(); it != object.end();)
            it = wanted(it.key()) ? std::next(it) : object.erase(it);
    };
    drop_others(gltf, [](const std::string& key) {
        return std::find(std::begin(k_kept), std::end(k_kept), key) != std::end(k_kept);
    });
    if (!member(gltf, "extensions").is_object()) gltf.erase("extensions");
    if (auto found = gltf.find("extensions"); found != gltf.end())
        drop_others(*found, [](const std::string& key) { return key == "VRM" || key == "VRMC_vrm"; });
    gltf["asset"] = {{"version", "2.0"}};
    if (auto nodes = gltf.find("nodes"); nodes != gltf.end())
        for (Json& node : *nodes)
            for (const char* key : {"camera", "extras", "weights"}) node.erase(key);
}

Result<Json> parse(std::string_view json) {
    if (auto done = check_json(json, k_most_depth, k_most_values); !done) return done.error();
    Json gltf = Json::parse(json, nullptr, false);
    if (gltf.is_discarded())
        return Error{"is no glTF file: it is neither .glb nor sound JSON; export it again as .glb"};
    return gltf;
}

}  // namespace

std::vector<std::string> files_named_by(const std::string& path) {
    auto bytes = read_bytes(path, k_most_gltf_bytes);
    auto parts = bytes ? split(*bytes) : bytes.error();
    auto gltf = parts ? parse(parts->json) : parts.error();
    if (!gltf || !check_version(*gltf) || !check_outline(*gltf)) return {};
    std::vector<std::string> files;
    for (const char* list : {"buffers", "images"}) {
        for (const Json& entry : member(*gltf, list)) {
            std::string uri = text(entry, "uri");
            auto file = uri.empty() || uri.starts_with("data:") ? Error{""} : named_file(uri);
            if (file) files.push_back((std::filesystem::path(path).parent_path() / *file).string());
        }
    }
    return files;
}

Result<GltfFile> open_gltf(std::span<const uint8_t> bytes, const std::string& folder) {
    auto parts = split(bytes);
    if (!parts) return parts.error();
    auto parsed = parse(parts->json);
    if (!parsed) return parsed.error();
    Json gltf = std::move(*parsed);
    if (auto done = check_version(gltf); !done) return done.error();
    if (auto done = check_extensions(gltf); !done) return done.error();
    if (auto done = check_outline(gltf); !done) return done.error();
    GltfFile out;
    auto buffers = read_buffers(gltf, parts->binary, folder);
    if (!buffers) return buffers.error();
    out.buffers = std::move(*buffers);
    out.images = read_images(gltf, out.buffers, folder);
    if (auto done = decode_meshopt(gltf, out.buffers); !done) return done.error();
    if (auto done = decode_draco(gltf, out.buffers); !done) return done.error();
    trim(gltf);
    if (auto done = check_numbers(gltf, ""); !done) return done.error();
    out.json = gltf.dump(-1, ' ', false, Json::error_handler_t::replace);
    return out;
}

}  // namespace flaneur
