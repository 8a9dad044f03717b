// osm_seeds FOLDER: small maps for the fuzzer to begin with.
#include <osmium/io/any_compression.hpp>
#include <osmium/io/pbf_input.hpp>
#include <osmium/io/pbf_output.hpp>
#include <osmium/io/writer.hpp>
#include <osmium/io/xml_input.hpp>
#include <osmium/io/xml_output.hpp>

#include "tests/fuzz/seeds.h"

namespace {

void write(const std::filesystem::path& path, const std::string& body) {
    write_seed(path, "<osm version=\"0.6\">" + body + "</osm>");
}

// A map of text once more, packed.
void pack(const std::filesystem::path& from, const std::string& to, const char* format) {
    osmium::io::Reader reader{from.string()};
    osmium::io::Writer writer{osmium::io::File{to, format}, osmium::io::overwrite::allow};
    while (osmium::memory::Buffer buffer = reader.read()) writer(std::move(buffer));
    writer.close();
    reader.close();
}

// Nodes 1 to 36, six by six, 11 m apart.
std::string nodes() {
    std::string text;
    for (int i = 0; i < 36; ++i) {
        text += "<node id=\"" + std::to_string(i + 1) + "\" lat=\"0.000" + std::to_string(i / 6) +
                "\" lon=\"0.000" + std::to_string(i % 6) + "\"/>";
    }
    return text;
}

std::string way(int id, std::initializer_list<int> refs, const std::string& tags) {
    std::string text = "<way id=\"" + std::to_string(id) + "\">";
    for (int ref : refs) text += "<nd ref=\"" + std::to_string(ref) + "\"/>";
    return text + tags + "</way>";
}

std::string tag(const std::string& key, const std::string& value) {
    return "<tag k=\"" + key + "\" v=\"" + value + "\"/>";
}

}  // namespace

int main(int argc, char** argv) {
    std::filesystem::path folder = seeds_folder(argc, argv);
    std::string street = way(100, {1, 2, 3, 6}, tag("highway", "residential") + tag("sidewalk", "both"));
    for (const char* roof : {"gabled", "hipped", "pyramidal", "skillion", "gambrel", "mansard", "dome",
                             "onion", "half-hipped", "round"}) {
        write(folder / (std::string(roof) + ".osm"),
              nodes() + street +
                  way(101, {8, 11, 23, 20, 8},
                      tag("building", "yes") + tag("height", "12") + tag("roof:shape", roof) +
                          tag("roof:height", "4")));
    }
    write(folder / "parts.osm",
          nodes() + street +
              way(101, {8, 12, 36, 32, 8}, tag("building", "church") + tag("building:levels", "3")) +
              way(102, {8, 9, 15, 14, 8},
                  tag("building:part", "yes") + tag("height", "40") + tag("min_height", "9")) +
              way(103, {15, 17, 29, 27, 15}, tag("building:part", "yes") + tag("roof:direction", "90")));
    write(folder / "court.osm",
          nodes() + street + way(101, {7, 12, 36, 31, 7}, "") + way(102, {14, 16, 28, 26, 14}, "") +
              "<relation id=\"1\"><member type=\"way\" ref=\"101\" role=\"outer\"/><member type=\"way\" "
              "ref=\"102\" "
              "role=\"inner\"/>" +
              tag("type", "multipolygon") + tag("building", "yes") + "</relation>" +
              way(104, {3, 9, 21}, tag("highway", "footway") + tag("tunnel", "building_passage")));
    write(folder / "ways.osm",
          nodes() + street + way(101, {3, 9, 15, 21}, tag("highway", "steps") + tag("step_count", "12")) +
              way(102, {2, 8, 14, 15}, tag("highway", "footway") + tag("footway", "crossing")) +
              way(103, {19, 20, 26, 25, 19}, tag("natural", "water")) +
              way(104, {31, 32, 33, 34, 35, 36}, tag("natural", "coastline")) +
              way(105, {22, 23, 24}, tag("highway", "primary") + tag("bridge", "yes") + tag("layer", "1")) +
              way(106, {10, 11, 12}, tag("barrier", "wall") + tag("height", "2")) +
              way(107, {16, 17, 18}, tag("natural", "tree_row")) +
              way(108, {28, 29, 35, 34, 28}, tag("highway", "pedestrian") + tag("area", "yes")));
    for (const char* name : {"court", "ways", "gabled"}) {
        std::filesystem::path plain = folder / (std::string(name) + ".osm");
        std::string packed = (folder / name).string();
        pack(plain, packed + ".osm.gz", "osm.gz");
        pack(plain, packed + ".osm.bz2", "osm.bz2");
        pack(plain, packed + ".pbf", "pbf,pbf_compression=none");
        pack(plain, packed + ".sparse.pbf", "pbf,pbf_compression=none,pbf_dense_nodes=false");
        pack(plain, packed + ".deflated.pbf", "pbf");
    }
}
