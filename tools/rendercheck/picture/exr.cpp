#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStdIO.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <string_view>

#include "tools/rendercheck/picture/picture.h"

namespace flaneur {
namespace {

// For a list of lines is allocated by the height that a header claims.
constexpr int k_most_side = 1 << 17;

// No number is none.
uint8_t whole_share(float v) {
    return v > 0 ? static_cast<uint8_t>(std::lround(std::min(v, 1.0f) * 255)) : uint8_t{0};
}

uint8_t shown(float linear) {
    const float v = std::min(linear, 1.0f);
    return whole_share(v <= 0.0031308f ? v * 12.92f : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f);
}

// Which channel goes to R, G, B and A, by name; "" for none. Those of a layer, "layer.R", only where there is
// none of plain colour; of depths, ids and greys the first three channels, one of them in all three colours.
std::array<std::string, 4> channels_shown(const Imf::ChannelList& channels) {
    constexpr std::string_view k_places = "RGBA";
    std::array<std::string, 4> names;
    for (const bool is_layer : {false, true}) {
        for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
            const std::string_view name = channel.name();
            const size_t point = name.rfind('.');
            const std::string_view last = point == name.npos ? name : name.substr(point + 1);
            const size_t place = last.size() == 1 ? k_places.find(last) : k_places.npos;
            if (place != k_places.npos && (point != name.npos) == is_layer && names[place].empty())
                names[place] = name;
        }
        if (std::any_of(names.begin(), names.end(), [](const std::string& name) { return !name.empty(); }))
            return names;
    }
    size_t count = 0;
    for (auto channel = channels.begin(); channel != channels.end() && count < 3; ++channel)
        names[count++] = channel.name();
    for (; count > 0 && count < 3; ++count) names[count] = names[count - 1];
    return names;
}

Result<CheckedPicture> read_pixels(Imf::IStream& bytes) {
    Imf::InputFile file(bytes, 0);
    const Imath::Box2i window = file.header().dataWindow();
    const int64_t width = int64_t{window.max.x} - window.min.x + 1,
                  height = int64_t{window.max.y} - window.min.y + 1;
    if (width < 1 || height < 1 || width * height > int64_t{k_most_checked_pixels})
        return Error{"has " + std::to_string(width) + "x" + std::to_string(height) + " pixels, and 1 to " +
                     std::to_string(k_most_checked_pixels) + " are looked at."};
    CheckedPicture picture;
    picture.width = static_cast<int>(width), picture.height = static_cast<int>(height);
    picture.precision = Precision::floats;
    const size_t count = static_cast<size_t>(width * height);
    picture.deep.assign(count * 4, 0.0f);
    const std::array<std::string, 4> names = channels_shown(file.header().channels());
    // One plane a place: no channel can be read to two at once.
    std::vector<float> plane(count);
    for (size_t place = 0; place < 4; ++place) {
        if (names[place].empty()) {
            for (size_t i = 0; i < count; ++i) picture.deep[4 * i + place] = place == 3;
            continue;
        }
        const Imf::Channel& channel = file.header().channels()[names[place].c_str()];
        if (channel.xSampling != 1 || channel.ySampling != 1)
            return Error{"has a channel " + names[place] + " of fewer pixels than the picture: write RGB."};
        if (place == 0 || names[place] != names[place - 1]) {
            Imf::FrameBuffer pixels;
            pixels.insert(names[place], Imf::Slice::Make(Imf::FLOAT, plane.data(), window));
            file.setFrameBuffer(pixels);
            file.readPixels(window.min.y, window.max.y);
        }
        for (size_t i = 0; i < count; ++i) picture.deep[4 * i + place] = plane[i];
    }
    picture.rgba.resize(count * 4);
    for (size_t i = 0; i < picture.deep.size(); ++i)
        picture.rgba[i] = i % 4 == 3 ? whole_share(picture.deep[i]) : shown(picture.deep[i]);
    return picture;
}

}  // namespace

Result<CheckedPicture> read_exr(std::span<const uint8_t> bytes) {
    Imf::Header::setMaxImageSize(k_most_side, k_most_side);
    Imf::StdISStream stream;
    stream.str({bytes.begin(), bytes.end()});
    try {
        return read_pixels(stream);
    } catch (const std::exception& e) {
        return Error{std::string("is no OpenEXR picture that can be read: ") + e.what()};
    }
}

}  // namespace flaneur
