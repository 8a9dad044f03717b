// Maps draw facades and roofs over one another; drawn, no two of them fight.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "assets/cities.h"
#include "assets/files/file.h"
#include "tests/folder.h"
#include "tests/sketch.h"
#include "tests/tools/fights.h"
#include "tools/extract/extract.h"

namespace flaneur {
namespace {

namespace fs = std::filesystem;

struct Horror {
    const char* name;
    Sketch sketch;
};

Horror halves() {
    Horror h{"parts that overlap by half", {}};
    h.sketch.way(box(0, 0, 4000, 2000), "building=yes height=12");
    h.sketch.way(box(0, 0, 2600, 2000), "building:part=yes height=18 min_height=3");
    h.sketch.way(box(1300, 0, 2700, 2000), "building:part=yes height=12");
    return h;
}

std::vector<Horror> horrors() {
    std::vector<Horror> all;
    auto add = [&](const char* name) -> Sketch& { return all.emplace_back(Horror{name, {}}).sketch; };
    all.push_back(halves());
    {
        Sketch& s = add("parts over parts that start higher");
        s.way(box(0, 0, 4000, 2000), "building=yes height=30");
        s.way(box(0, 0, 4000, 2000), "building:part=yes height=12");
        s.way(box(0, 0, 2000, 2000), "building:part=yes height=30 min_height=12");
        s.way(box(1000, 0, 2000, 2000), "building:part=yes height=25 min_height=9");
    }
    {
        Sketch& s = add("twins");
        s.way(box(0, 0, 2000, 2000), "building=yes height=9 roof:shape=flat");
        s.way(box(0, 0, 2000, 2000), "building=yes height=9 roof:shape=flat");
    }
    {
        Sketch& s = add("twins, one with a steep roof");
        s.way(box(0, 0, 2000, 2000), "building=yes height=14 roof:shape=gabled roof:height=8");
        s.way(box(0, 0, 2000, 2000), "building=yes height=9 roof:shape=flat");
    }
    {
        // Lines along (10, 3) lie 1.07 mm apart.
        Sketch& s = add("fronts a millimetre apart");
        auto house = [&](int x, int y, const char* tags) {
            s.way({{x, y}, {x + 2000, y + 600}, {x + 1700, y + 1600}, {x - 300, y + 1600 - 600}}, tags);
        };
        house(0, 0, "building=yes height=9 roof:shape=flat");
        house(1003, 301, "building=yes height=12 roof:shape=hipped");
        house(2006, 602, "building=yes height=7 roof:shape=flat");
    }
    for (auto [name, off] : {std::pair("fronts a centimetre apart", 1), std::pair("fronts 3 cm apart", 3)}) {
        Sketch& s = add(name);
        s.way(box(0, 0, 2000, 1000), "building=yes height=9 roof:shape=flat");
        s.way(box(1000, off, 2000, 1000), "building=yes height=15 roof:shape=gabled");
        s.way(box(2500, 2 * off, 2000, 1000), "building=yes height=12 roof:shape=mansard");
    }
    for (auto [name, gap] : {std::pair("a slit of a centimetre", 1), std::pair("a slit of 3 cm", 3)}) {
        Sketch& s = add(name);
        s.way(box(0, 0, 1000, 1000), "building=yes height=9 roof:shape=flat");
        s.way(box(1000 + gap, 0, 1000, 1000), "building=yes height=9 roof:shape=flat");
    }
    {
        Sketch& s = add("roofs in one plane");
        s.way(box(0, 0, 3000, 3000), "building=yes height=12");
        s.way(box(0, 0, 2000, 3000),
              "building:part=yes height=12 roof:shape=skillion roof:height=4 roof:direction=0");
        s.way(box(1000, 0, 2000, 3000),
              "building:part=yes height=12 roof:shape=skillion roof:height=4 roof:direction=0");
        s.way(box(5000, 0, 30, 3000), "building=yes height=6 roof:shape=flat");
        s.way(box(5027, 0, 2000, 3000), "building=yes height=6 roof:shape=flat");
    }
    {
        Sketch& s = add("a part inside an outline");
        s.way(box(0, 0, 3000, 3000), "building=yes height=15");
        s.way(box(1000, 0, 1000, 2000), "building:part=yes height=25");
    }
    {
        Sketch& s = add("a bridge over the same outline");
        s.way(box(0, 0, 4000, 1000), "building=bridge height=6 min_height=4");
        s.way({{-2500, 500}, {6500, 500}}, "highway=footway bridge=yes layer=1 width=8", false);
        s.way({{0, 0}, {4000, 0}, {4000, 1000}, {0, 1000}}, "building=roof height=5", true);
    }
    {
        Sketch& s = add("one house as a way and as a multipolygon");
        int outer = s.way(box(0, 0, 3000, 3000), "building=yes height=12 roof:shape=flat");
        int inner = s.way(box(1000, 1000, 1000, 1000), "note=yard");
        s.multipolygon(outer, inner, "building=yes height=12 roof:shape=flat");
    }
    {
        Sketch& s = add("parts stacked, with parapets");
        s.way(box(0, 0, 3000, 3000), "building=yes height=30");
        s.way(box(0, 0, 3000, 3000), "building:part=yes height=10");
        s.way(box(0, 0, 3000, 2000), "building:part=yes height=20 min_height=10");
        s.way(box(0, 0, 1500, 2000), "building:part=yes height=30 min_height=20");
    }
    return all;
}

// Two walls or roofs in front of each other, and what else is near them.
CityMesh sheets(std::initializer_list<std::array<glm::vec3, 4>> quads, uint32_t material) {
    CityMesh mesh;
    uint32_t house = 0;
    for (const auto& quad : quads) {
        auto first = static_cast<uint32_t>(mesh.vertices.size());
        for (glm::vec3 p : quad)
            mesh.vertices.push_back({p, 0xff000000u + house, {}, {}, uint16_t(material), 0, house});
        ++house;
        for (uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + k);
    }
    return mesh;
}

// Faces +z; half of it lies before the next one.
std::array<glm::vec3, 4> upright(float x, float z) {
    return {glm::vec3(x, 0, z), {x + 10, 0, z}, {x + 10, 8, z}, {x, 8, z}};
}
std::array<glm::vec3, 4> level(float x, float y, float z) {
    return {glm::vec3(x, y, z + 10), {x + 10, y, z + 10}, {x + 10, y, z}, {x, y, z}};
}

TEST(Fights, AreSeen) {
    auto on_walls = [](auto... quads) { return find_fights(sheets({quads...}, k_material_facade)); };
    std::vector<Fight> fights = on_walls(upright(0, 0), upright(5, 0));
    double area = 0;
    for (const Fight& f : fights) area += double(f.area);
    EXPECT_NEAR(area, 40, 1e-3);
    EXPECT_FALSE(on_walls(upright(0, 0), upright(5, 0.001f)).empty());
    EXPECT_FALSE(on_walls(upright(0, 0), upright(9.9f, -0.003f)).empty());
    EXPECT_TRUE(on_walls(upright(0, 0), upright(5, 0.01f)).empty()) << "a centimetre apart";
    EXPECT_TRUE(on_walls(upright(0, 0), upright(10, 0)).empty()) << "side by side";
    auto back = upright(0, 0);
    std::swap(back[0], back[1]), std::swap(back[2], back[3]);
    EXPECT_TRUE(on_walls(upright(0, 0), back).empty()) << "back to back";
    auto on_roofs = [](auto... quads) { return find_fights(sheets({quads...}, k_material_roof)); };
    EXPECT_FALSE(on_roofs(level(0, 5, 0), level(2, 5, 2)).empty());
    auto under = sheets({level(0, 5, 0), level(2, 5, 2)}, k_material_roof);
    CityMesh cover = sheets({{glm::vec3(-5, 9, 20), {20, 9, 20}, {20, 9, -5}, {-5, 9, -5}}}, k_material_roof);
    for (uint32_t i : cover.indices)
        under.indices.push_back(i + static_cast<uint32_t>(under.vertices.size()));
    under.vertices.insert(under.vertices.end(), cover.vertices.begin(), cover.vertices.end());
    EXPECT_TRUE(find_fights(under).empty()) << "within a solid";
}

// Ground over ground is the streets' matter.
void expect_peace(const std::string& name, const City& city) {
    std::vector<Fight> fights = find_fights(extract_scene(city, {}).city);
    std::cout << name << ": " << told(fights) << "\n";
    EXPECT_EQ(std::count_if(fights.begin(), fights.end(),
                            [](const Fight& f) { return f.a != Drawn::ground || f.b != Drawn::ground; }),
              0)
        << name;
}

TEST(Fights, HorrorsHaveNone) {
    for (const Horror& h : horrors()) {
        TestFolder folder;
        Result<City> city = load_osm(folder.write("map.osm", h.sketch.xml()));
        ASSERT_TRUE(city) << h.name << ": " << city.error().message;
        expect_peace(h.name, *city);
    }
}

TEST(Fights, TheDistrictHasNone) { expect_peace("district", generate_district({})); }

// Places on a wall stay what they were where it is cut.
TEST(Fights, PiecesKeepTheirPlaces) {
    City city;
    city.buildings.resize(2);
    city.buildings[1].seed = 1;
    city.ground.faces = {{{0, 0, 5}, {10, 0, 5}, 12, 12, FaceKind::facade, 0},
                         {{5, 0, 5}, {20, 0, 5}, 15, 15, FaceKind::facade, 1}};
    index_ground(city.ground);
    CityMesh mesh = extract_scene(city, {}).city;
    float widest = 0, area = 0;
    for (const CityVertex& v : mesh.vertices) {
        widest = std::max(widest, v.uv.x);
        EXPECT_NEAR(v.uv.y, v.position.y, 1e-4f);
        EXPECT_NEAR(v.uv.x, v.house == mesh.vertices[0].house ? v.position.x : v.position.x - 5, 1e-3f);
    }
    EXPECT_FLOAT_EQ(widest, 15);
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        auto at = [&](size_t k) { return mesh.vertices[mesh.indices[i + k]].position; };
        area += glm::length(glm::cross(at(1) - at(0), at(2) - at(0))) * 0.5f;
    }
    EXPECT_NEAR(area, 10 * 12 + 15 * 15 - 5 * 12, 0.2f);
}

// FLANEUR_MAPS names a folder of maps, such as the trial's; with hills or parts of them only where they say
// so.
TEST(Fights, MapsOfAFolderHaveNone) {
    const char* folder = std::getenv("FLANEUR_MAPS");
    if (!folder) GTEST_SKIP() << "SKIPPED: FLANEUR_MAPS names no folder of maps";
    int maps = 0;
    for (const fs::directory_entry& file : fs::recursive_directory_iterator(folder)) {
        if (!file.is_regular_file() || kind_of(file.path().string()) != FileKind::map) continue;
        Result<City> city = load_osm(file.path().string());
        if (!city) {
            std::cout << file.path().string() << " is refused: " << city.error().message << "\n";
            continue;
        }
        expect_peace(file.path().string(), *city);
        ++maps;
    }
    EXPECT_GT(maps, 0) << "no map in " << folder;
}

struct CorpusMap {
    const char *file, *terrain;
};

void PrintTo(const CorpusMap& map, std::ostream* out) { *out << map.file << " " << map.terrain; }

class RealMaps : public testing::TestWithParam<CorpusMap> {};

TEST_P(RealMaps, HaveNoFights) {
    fs::path corpus = fs::path(FLANEUR_SHARED_DIR) / "corpus" / "osm", path = corpus / GetParam().file;
    if (!fs::exists(path)) GTEST_SKIP() << "SKIPPED: there is no " << path << " here";
    CityOptions options;
    if (*GetParam().terrain) options.terrain = (corpus / GetParam().terrain).string();
    Result<City> city = load_osm(path.string(), options);
    ASSERT_TRUE(city) << city.error().message;
    expect_peace(GetParam().file, *city);
}

INSTANTIATE_TEST_SUITE_P(Fights, RealMaps,
                         testing::Values(CorpusMap{"berlin_neukolln_2024.osm", ""},
                                         CorpusMap{"london_moorgate_2024.osm.pbf", ""},
                                         CorpusMap{"taipei_2024.osm", ""},
                                         CorpusMap{"austin_downtown_2019.osm.pbf", ""},
                                         CorpusMap{"nyc_manhattan_2015_unsorted.osm.pbf", ""},
                                         CorpusMap{"monaco_2021.osm.pbf", ""},
                                         CorpusMap{"monaco_2021.osm.pbf", "N43E007_srtm3_monaco.hgt.zip"},
                                         CorpusMap{"osm-testdata/grid_all.osm", ""}));

}  // namespace
}  // namespace flaneur
