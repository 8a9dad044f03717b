#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "assets/files/file.h"
#include "assets/files/picture.h"
#include "renderer/renderer.h"
#include "tests/folder.h"
#include "tests/tools/loaded.h"
#include "tools/extract/extract.h"
#include "tools/extract/ids.h"
#include "tools/flaneur/output/channels.h"
#include "tools/flaneur/view/ids.h"
#include "tools/flaneur/window/ask/things.h"
#include "tools/flaneur/window/pick.h"

namespace flaneur {
namespace {

const Size k_size{5, 3};

TEST(Channels, HoldDepthsInCentimetresOrMetres) {
    std::vector<float> depths(5 * 3, 12.345f);
    depths[0] = std::numeric_limits<float>::infinity(), depths[1] = 1e9f, depths[14] = 0.1f;
    const TestFolder folder;
    const std::string png = folder / "depth.png", pfm = folder / "depth.pfm";
    ASSERT_TRUE(write_depths(std::move(*open_file(png)), depths, k_size));
    ASSERT_TRUE(write_depths(std::move(*open_file(pfm)), depths, k_size));
    const Bytes text = *read_bytes(pfm, 1 << 20), head = *read_bytes(png, 1 << 20);
    EXPECT_EQ(head[24], 16) << "bits";
    EXPECT_EQ(head[25], 0) << "grey";
    const DecodedPicture greys = decode_picture(head, 100).value();
    EXPECT_EQ(greys.rgba[0], 0) << "nothing";
    EXPECT_EQ(greys.rgba[4], 255) << "all that is farther";
    EXPECT_EQ(greys.rgba[8], 1235 / 256);
    const std::string begin = "Pf\n5 3\n-1.0\n";
    ASSERT_EQ(text.size(), begin.size() + sizeof(float) * 15);
    EXPECT_EQ(std::string(text.begin(), text.begin() + static_cast<ptrdiff_t>(begin.size())), begin);
    std::array<float, 15> metres{};
    std::memcpy(metres.data(), &text[begin.size()], sizeof metres);
    EXPECT_FLOAT_EQ(metres[4], 0.1f) << "rows from the bottom";
    EXPECT_FLOAT_EQ(metres[10], 0) << "nothing";
    EXPECT_FLOAT_EQ(metres[11], 1e9f);
    EXPECT_FLOAT_EQ(metres[12], 12.345f);
}

// The one channel of an .exr, in its own type.
template <class Value>
std::vector<Value> read_exr(const std::string& path, const char* name, Imf::PixelType type) {
    Imf::InputFile file(path.c_str());
    const Imf::ChannelList& channels = file.header().channels();
    EXPECT_EQ(++channels.begin(), channels.end());
    EXPECT_EQ(channels[name].type, type);
    const Imath::Box2i window = file.header().dataWindow();
    EXPECT_EQ(window, Imath::Box2i({0, 0}, {k_size.width - 1, k_size.height - 1}));
    std::vector<Value> values(15);
    Imf::FrameBuffer pixels;
    pixels.insert(name, Imf::Slice::Make(type, values.data(), window));
    file.setFrameBuffer(pixels);
    file.readPixels(window.min.y, window.max.y);
    return values;
}

TEST(Channels, HoldMetresAndIdsInExr) {
    const TestFolder folder;
    std::vector<float> depths(5 * 3, 12.345f);
    depths[0] = std::numeric_limits<float>::infinity(), depths[14] = 0.1f;
    ASSERT_TRUE(write_depths(std::move(*open_file(folder / "d.exr")), depths, k_size));
    depths[0] = 0;
    EXPECT_EQ(read_exr<float>(folder / "d.exr", "Z", Imf::FLOAT), depths);
    std::vector<uint32_t> ids(5 * 3, 0x800001u);
    ids[0] = 0, ids[7] = 0xffffff, ids[14] = 12;
    ASSERT_TRUE(write_ids(std::move(*open_file(folder / "i.exr")), ids, k_size));
    EXPECT_EQ(read_exr<uint32_t>(folder / "i.exr", "id", Imf::UINT), ids);
    ASSERT_TRUE(write_ids(std::move(*open_file(folder / "i.png")), ids, k_size));
    const DecodedPicture read = decode_picture(*read_bytes(folder / "i.png", 1 << 20), 100).value();
    for (size_t i = 0; i < ids.size(); ++i)
        EXPECT_EQ(read.rgba[4 * i] + 256u * read.rgba[4 * i + 1] + 65536u * read.rgba[4 * i + 2], ids[i]);
    EXPECT_EQ(legend_path("a.b/i.exr"), "a.b/i.json");
}

TEST(Channels, HaveALegend) {
    City city;
    city.props.resize(2);
    city.props[1].kind = PropKind::bench;
    std::vector<uint32_t> ids(5 * 3, 0);
    ids[1] = ids[2] = ids[8] = id_of(IdKind::walker, 12);
    ids[5] = id_of(IdKind::prop, 1), ids[6] = id_of(IdKind::ground, k_kerb_number);
    ids[7] = id_of(IdKind::wall, ~0u);
    const auto things = nlohmann::json::parse(legend_of(ids, k_size, city))["things"];
    ASSERT_EQ(things.size(), 5u);
    EXPECT_EQ(things[0]["kind"], "nothing");
    EXPECT_EQ(things[1]["what"], "kerb");
    EXPECT_EQ(things[2]["number"], k_last_number);
    EXPECT_EQ(things[3]["what"], "bench");
    const auto& walker = things[4];
    EXPECT_EQ(walker["kind"], "walker");
    EXPECT_EQ(walker["number"], 12);
    EXPECT_EQ(walker["id"], ids[1]);
    EXPECT_EQ(walker["pixels"], 3);
    EXPECT_EQ(walker["box"], nlohmann::json({1, 0, 3, 2}));
}

// What a click tells of a pixel, and what its id says.
TEST(Channels, ShowWhatIsUnderACursor) {
    Loaded loaded = loaded_scene("corner", 60);
    for (int i = 0; i < 300; ++i) step(*loaded.world);
    RendererOptions options;
    options.device = "llvmpipe", options.quality = Quality::medium;
    Result<RendererPtr> renderer = make_renderer(options);
    ASSERT_TRUE(renderer) << renderer.error().message;
    ASSERT_TRUE(upload_scene(**renderer, extract_scene(*loaded.city, loaded.characters)));
    PeopleFrame people;
    extract_people(*loaded.world, loaded.characters, people);
    constexpr Size size{320, 180};
    FrameInput frame;
    frame.camera = {.eye = {-14, 7, -14}, .target = {0, 0.5f, 0}, .vertical_fov = 0.8f};
    frame.walkers = people.walkers, frame.palette = people.palette;
    frame.wants_ids = true;
    const Image image = draw_image(**renderer, frame, size.width, size.height).value();
    const CityIndex index = index_things(loaded.city);
    int met = 0, agreed = 0, people_met = 0, people_agreed = 0;
    std::map<IdKind, int> kinds;
    for (int y = 1; y < size.height; y += 2)
        for (int x = 1; x < size.width; x += 2) {
            const uint32_t id = image.ids[static_cast<size_t>(y * size.width + x)];
            ++kinds[kind_of_id(id)];
            const glm::vec3 way = ray_through(frame.camera, size, {x, y}), eye = frame.camera.eye;
            const bool is_walker = kind_of_id(id) == IdKind::walker;
            if (const auto who = walker_along(*loaded.world, frame.camera, way, 0)) {
                if (is_walker) ++people_met, people_agreed += number_of_id(id) == *who;
                continue;  // about a body is room for more
            }
            if (is_walker) {  // an arm, a bag
                EXPECT_TRUE(walker_along(*loaded.world, frame.camera, way, 0.03f)) << x << " " << y;
                continue;
            }
            const auto thing = thing_along(index, {eye.x, eye.y, eye.z}, {way.x, way.y, way.z});
            const IdKind kind = kind_of_id(id);
            const bool is_built = kind == IdKind::house || kind == IdKind::wall;
            // What is simpler than it looks: crowns of leaves.
            if (thing && thing->kind == ThingKind::prop && number_of_id(id) != thing->index) continue;
            ++met;
            if (!thing)
                agreed += kind == IdKind::none || kind == IdKind::scenery;
            else if (thing->kind == ThingKind::ground)
                agreed += id == id_of(IdKind::ground,
                                      static_cast<uint32_t>(loaded.city->ground.kinds[thing->index]));
            else if (thing->kind == ThingKind::building)
                agreed += is_built && number_of_id(id) == thing->index;
            else if (thing->kind == ThingKind::prop)
                agreed += kind == IdKind::tree || kind == IdKind::car || kind == IdKind::prop;
            else
                agreed += is_built;
        }
    EXPECT_GT(met, 10'000);
    EXPECT_GT(agreed, met * 98 / 100);
    EXPECT_GT(people_met, 20);
    EXPECT_GT(people_agreed, people_met * 9 / 10);
    for (const IdKind kind : {IdKind::ground, IdKind::house, IdKind::tree, IdKind::walker})
        EXPECT_GT(kinds[kind], 10) << static_cast<int>(kind);
}

}  // namespace
}  // namespace flaneur
