#include "renderer/light/sweep.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/light/sweep.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "sim/base/vec-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

constexpr size_t k_most_lanes = 16;

// The words of shaders/light/dialect.glsl, over lanes.
#define SHARED HWY_INLINE
using real = Lanes;
using real3 = V3<Lanes>;
using truth = LaneMask;

HWY_INLINE bool some(truth m) { return any(m); }
HWY_INLINE truth both(truth a, truth b) { return a & b; }
HWY_INLINE truth either(truth a, truth b) { return a | b; }
HWY_INLINE real saturate(real x) { return min(max(x, real(0.0f)), real(1.0f)); }
HWY_INLINE real3 make3(real x, real y, real z) { return {x, y, z}; }
HWY_INLINE real3 xyz(const vec4& v) { return {v.x, v.y, v.z}; }
HWY_INLINE real3 operator*(real3 a, real3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

struct Row {
    real a, b, c, d;
};
struct Lamp {
    real3 light;
    real ground;
};

using WholeTag = hn::Rebind<int32_t, LaneTag>;
using Whole = hn::Vec<WholeTag>;

HWY_INLINE Whole whole(real x) { return hn::ConvertTo(WholeTag(), x.v); }
HWY_INLINE real byte_of(Whole words, int shift) {
    return hn::ConvertTo(LaneTag(), hn::And(hn::ShiftRightSame(words, shift), hn::Set(WholeTag(), 255)));
}

// Lights pixels side by side. The formulas are members, so that they find the frame and its maps.
struct Light {
    const Unlit& unlit;
    const FrameConstants& frame;
    int map_edge;  // of the shadow maps, texels

    explicit Light(const Unlit& from)
        : unlit(from), frame(*from.frame), map_edge(static_cast<int>(from.frame->shadow_texels.z)) {}

    HWY_INLINE Row shadow_row(real layer, real x, real y) const {
        HWY_ALIGN int32_t at[k_most_lanes];
        HWY_ALIGN int32_t four[2 * k_most_lanes];
        const WholeTag tag;
        const Whole edge = hn::Set(tag, map_edge), low = hn::Set(tag, 0xffff);
        hn::Store(hn::Add(hn::Mul(hn::Add(hn::Mul(whole(layer), edge), whole(y)), edge), whole(x)), tag, at);
        for (size_t i = 0; i < lane_count(); ++i) std::memcpy(&four[2 * i], unlit.shadows + at[i], 8);
        Whole ab, cd;
        hn::LoadInterleaved2(tag, four, ab, cd);
        auto number = [&](Whole w) HWY_ATTR { return real(hn::ConvertTo(LaneTag(), hn::And(w, low))); };
        return {number(ab), number(hn::ShiftRight<16>(ab)), number(cd), number(hn::ShiftRight<16>(cd))};
    }

    HWY_INLINE Lamp lamp_texel(real x, real y) const {
        HWY_ALIGN int32_t column[k_most_lanes], row[k_most_lanes];
        HWY_ALIGN float out[4][k_most_lanes];
        const WholeTag tag;
        hn::Store(whole(x), tag, column);
        hn::Store(whole(y), tag, row);
        const int width = unlit.lamps_width,
                  height = width > 0 ? static_cast<int>(unlit.lamps.size()) / width : 0;
        for (size_t i = 0; i < lane_count(); ++i) {
            const bool is_there = column[i] >= 0 && row[i] >= 0 && column[i] < width && row[i] < height;
            const vec4 texel =
                is_there ? unlit.lamps[static_cast<size_t>(row[i] * width + column[i])] : vec4(0);
            for (int k = 0; k < 4; ++k) out[k][i] = texel[k];
        }
        const LaneTag lanes;
        return {{hn::Load(lanes, out[0]), hn::Load(lanes, out[1]), hn::Load(lanes, out[2])},
                hn::Load(lanes, out[3])};
    }

    HWY_INLINE real3 sky_corner(real column, real row) const {
        HWY_ALIGN int32_t at[k_most_lanes];
        HWY_ALIGN float out[3][k_most_lanes];
        const WholeTag tag;
        hn::Store(hn::Add(hn::Mul(whole(row), hn::Set(tag, k_sky_columns + 1)), whole(column)), tag, at);
        for (size_t i = 0; i < lane_count(); ++i)
            for (int k = 0; k < 3; ++k) out[k][i] = unlit.sky[static_cast<size_t>(at[i])][k];
        const LaneTag lanes;
        return {hn::Load(lanes, out[0]), hn::Load(lanes, out[1]), hn::Load(lanes, out[2])};
    }

#include "shaders/light/light.h"

    // Of samples `step` apart along a row, from x on.
    HWY_INLINE Kept kept_at(size_t x, size_t y, size_t step) const {
        const WholeTag tag;
        const LaneTag lanes;
        const int32_t* colours = unlit.colours.first + y * unlit.colours.stride + x;
        const int32_t* surfaces = unlit.surfaces.first + 2 * (y * unlit.surfaces.stride + x);
        const float* depths = unlit.depths.first + y * unlit.depths.stride + x;
        Whole c, n, r;
        hn::Vec<LaneTag> depth;
        if (step == 1) {
            c = hn::LoadU(tag, colours);
            hn::LoadInterleaved2(tag, surfaces, n, r);
            depth = hn::LoadU(lanes, depths);
        } else {
            HWY_ALIGN int32_t colour[k_most_lanes], surface[2 * k_most_lanes];
            HWY_ALIGN float ahead[k_most_lanes];
            for (size_t i = 0; i < lane_count(); ++i) {
                colour[i] = colours[i * step];
                surface[2 * i] = surfaces[2 * i * step];
                surface[2 * i + 1] = surfaces[2 * i * step + 1];
                ahead[i] = depths[i * step];
            }
            c = hn::Load(tag, colour);
            hn::LoadInterleaved2(tag, surface, n, r);
            depth = hn::Load(lanes, ahead);
        }
        const Whole twelve = hn::Set(tag, 4095);
        auto number = [&](Whole w) HWY_ATTR { return real(hn::ConvertTo(LaneTag(), w)); };
        return {byte_of(c, 0),
                byte_of(c, 8),
                byte_of(c, 16),
                byte_of(c, 24),
                number(hn::And(n, twelve)),
                number(hn::And(hn::ShiftRight<12>(n), twelve)),
                byte_of(n, 24),
                byte_of(r, 0),
                byte_of(r, 8),
                byte_of(r, 16),
                byte_of(r, 24),
                real(depth)};
    }

    HWY_INLINE real3 colour_at(Kept kept, real x, real y) {
        return colour_seen(kept, (x + real(0.5f)) * real(frame.samples.z), (y + real(0.5f)) * real(frame.samples.w));
    }

    HWY_INLINE real3 pixels_of_one(size_t x, size_t y, real column, real row) {
        return colour_at(kept_at(x, y, 1), column, row);
    }

    HWY_INLINE real3 pixels_of_four(size_t x, size_t y, real column, real row) {
        const Kept a = kept_at(2 * x, 2 * y, 2), b = kept_at(2 * x + 1, 2 * y, 2),
                   c = kept_at(2 * x, 2 * y + 1, 2), d = kept_at(2 * x + 1, 2 * y + 1, 2);
        const truth is_one = is_one_surface(a, b, c, d);
        real3 colour = colour_seen(mean(a, b, c, d), (column + real(0.5f)) * real(frame.screen.z),
                                   (row + real(0.5f)) * real(frame.screen.w));
        if (hn::AllTrue(LaneTag(), is_one.m)) return colour;
        const real left = column * real(2.0f), top = row * real(2.0f);
        const Kept all[4] = {a, b, c, d};
        real3 four[4];
        for (int i = 0; i < 4; ++i)
            four[i] = colour_at(all[i], left + real(static_cast<float>(i & 1)), top + real(static_cast<float>(i >> 1)));
        return select(is_one, colour, mean(four[0], four[1], four[2], four[3]));
    }
};

// A row of so many pixels. The last lanes lie over those before, so that none is beyond the row's end.
void light_row(const Unlit& unlit, size_t y, size_t width, uint32_t* colours, uint8_t* lumas) {
    Light light(unlit);
    const WholeTag tag;
    const size_t lanes = lane_count();
    const bool is_one = light.frame.samples.x == 1.0f;
    const real row(static_cast<float>(y));
    const real steps(hn::ConvertTo(LaneTag(), hn::Iota(tag, 0)));
    for (size_t x = 0; x < width; x += lanes) {
        const size_t at = std::min(x, width - lanes);
        const real column = real(static_cast<float>(at)) + steps;
        const real3 colour = is_one ? light.pixels_of_one(at, y, column, row) : light.pixels_of_four(at, y, column, row);
        auto bytes = [&](real c) HWY_ATTR {
            return floor(min(max(c, real(0.0f)), real(1.0f)) * real(255.0f) + real(0.5f));
        };
        const real r = bytes(colour.x), g = bytes(colour.y), b = bytes(colour.z);
        const real luma = floor((r * real(299.0f) + g * real(587.0f) + b * real(114.0f)) * real(0.001f) + real(0.5f));
        const Whole packed = hn::Or(hn::Or(whole(r), hn::ShiftLeft<8>(whole(g))), hn::ShiftLeft<16>(whole(b)));
        hn::StoreU(hn::BitCast(hn::Rebind<uint32_t, LaneTag>(), packed), hn::Rebind<uint32_t, LaneTag>(), colours + at);
        const hn::Rebind<uint8_t, LaneTag> narrow;
        hn::StoreU(hn::DemoteTo(narrow, whole(luma)), narrow, lumas + at);
    }
}

// Bit x: whether the pixel x of a row lies on an edge, as shaders/light/smooth.h asks first. Rows of lumas are
// `stride` apart, and one is above and below.
void find_edges(const uint8_t* lumas, size_t stride, size_t width, uint64_t* edges) {
    std::fill_n(edges, (width + 63) / 64, uint64_t{0});
    const hn::CappedTag<uint8_t, 64> tag;
    const size_t lanes = hn::Lanes(tag);
    size_t x = 1;
    for (; x + lanes < width; x += lanes) {
        const uint8_t* at = lumas + x;
        const auto m = hn::LoadU(tag, at), n = hn::LoadU(tag, at - stride), s = hn::LoadU(tag, at + stride),
                   w = hn::LoadU(tag, at - 1), e = hn::LoadU(tag, at + 1);
        const auto high = hn::Max(m, hn::Max(hn::Max(n, s), hn::Max(w, e)));
        const auto low = hn::Min(m, hn::Min(hn::Min(n, s), hn::Min(w, e)));
        const auto least = hn::Max(hn::Set(tag, static_cast<uint8_t>(k_least_contrast)), hn::ShiftRight<3>(high));
        const auto flat = hn::Eq(hn::SaturatedSub(hn::Sub(high, low), least), hn::Zero(tag));
        uint8_t bytes[8] = {};
        hn::StoreMaskBits(tag, hn::Not(flat), bytes);
        uint64_t bits = 0;
        std::memcpy(&bits, bytes, (lanes + 7) / 8);
        edges[x / 64] |= bits << x % 64;
        if (x % 64 + lanes > 64) edges[x / 64 + 1] |= bits >> (64 - x % 64);
    }
    for (; x + 1 < width; ++x) edges[x / 64] |= uint64_t{1} << x % 64;  // left to the question itself
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flaneur {

HWY_EXPORT(light_row);
HWY_EXPORT(find_edges);

namespace {

constexpr size_t k_rows = 8;           // that a thread takes at once
constexpr size_t k_least_width = 16;   // pixels, that lanes light together

// Copies of rows too short for lanes.
template <class T>
std::vector<T> widened(Texels<T>& texels, size_t each, size_t width, size_t rows, size_t least) {
    std::vector<T> out(each * least * rows);
    for (size_t y = 0; y < rows; ++y)
        std::copy_n(texels.first + each * y * texels.stride, each * width, &out[each * y * least]);
    texels = {out.data(), least};
    return out;
}

// Smooths edges, and lays over the picture what there is.
struct Finish {
    const Unlit& unlit;
    const LitPicture& lit;
    const uint8_t* lumas;
    size_t stride;  // of both, pixels
    bool is_blue_first;

    int luma_at(int x, int y) const { return lumas[y * static_cast<ptrdiff_t>(stride) + x]; }
    static int abs(int x) { return x < 0 ? -x : x; }
    template <class T>
    static T min(T a, T b) {
        return a < b ? a : b;
    }
    template <class T>
    static T max(T a, T b) {
        return a > b ? a : b;
    }

#include "shaders/light/smooth.h"

    static float channel(uint32_t colour, int number) { return static_cast<float>(colour >> 8 * number & 255); }

    uint32_t smoothed(int x, int y, int width, int height) {
        const uint32_t* colours = lit.colours.data();
        const uint32_t own = colours[static_cast<size_t>(y) * stride + static_cast<size_t>(x)];
        const Smoothing taken = smoothing_at(x, y, width, height);
        if (taken.share == 0) return own;
        const uint32_t other = colours[static_cast<size_t>(taken.y) * stride + static_cast<size_t>(taken.x)];
        uint32_t out = 0;
        for (int k = 0; k < 3; ++k) {
            const float mine = channel(own, k);
            out |= static_cast<uint32_t>(mine + (channel(other, k) - mine) * taken.share + 0.5f) << 8 * k;
        }
        return out;
    }

    uint32_t covered(uint32_t colour, size_t x, size_t y) const {
        const size_t samples = static_cast<size_t>(unlit.frame->samples.x);
        float over[4] = {};
        for (size_t i = 0; i < samples * samples; ++i) {
            const size_t row = samples * y + i / samples, column = samples * x + i % samples;
            const auto texel = unlit.overlay.first[row * unlit.overlay.stride + column];
            for (int k = 0; k < 4; ++k) over[k] += channel(static_cast<uint32_t>(texel), k) / static_cast<float>(samples * samples);
        }
        if (over[3] == 0) return colour;
        uint32_t out = 0;
        for (int k = 0; k < 3; ++k) {
            const float value = channel(colour, k) * (1 - over[3] / 255) + over[k] + 0.5f;
            out |= static_cast<uint32_t>(min(value, 255.0f)) << 8 * k;
        }
        return out;
    }

    uint32_t handed_on(uint32_t colour) const {
        const uint32_t swapped = (colour & 0xff) << 16 | (colour & 0xff00) | (colour >> 16 & 0xff);
        return 0xff000000u | (is_blue_first ? swapped : colour);
    }
};

}  // namespace

void light_picture(const Unlit& given, Workers& workers, LitPicture& lit, bool is_blue_first, uint32_t* pixels) {
    Unlit unlit = given;
    const auto width = static_cast<size_t>(given.frame->screen.x), height = static_cast<size_t>(given.frame->screen.y);
    const auto samples = static_cast<size_t>(given.frame->samples.x);
    const size_t span = std::max(width, k_least_width);
    std::vector<int32_t> colours, surfaces;
    std::vector<float> depths;
    if (width < span) {
        const size_t rows = samples * height;
        colours = widened(unlit.colours, 1, samples * width, rows, samples * span);
        surfaces = widened(unlit.surfaces, 2, samples * width, rows, samples * span);
        depths = widened(unlit.depths, 1, samples * width, rows, samples * span);
    }
    lit.colours.resize(span * height);
    lit.lumas.resize(span * height);
    parallel_for(workers, height, k_rows, [&](size_t begin, size_t end, int) {
        for (size_t y = begin; y < end; ++y)
            HWY_DYNAMIC_DISPATCH(light_row)(unlit, y, span, &lit.colours[y * span], &lit.lumas[y * span]);
    });
    const bool is_smooth = given.smooths_edges && given.frame->backdrop.w == 0;
    parallel_for(workers, height, k_rows, [&](size_t begin, size_t end, int) {
        Finish finish{unlit, lit, lit.lumas.data(), span, is_blue_first};
        std::vector<uint64_t> edges((width + 63) / 64);
        for (size_t y = begin; y < end; ++y) {
            const uint32_t* from = &lit.colours[y * span];
            uint32_t* to = pixels + y * width;
            for (size_t x = 0; x < width; ++x) to[x] = finish.handed_on(from[x]);
            if (is_smooth && y > 0 && y + 1 < height) {
                HWY_DYNAMIC_DISPATCH(find_edges)(&lit.lumas[y * span], span, width, edges.data());
                for (size_t word = 0; word < edges.size(); ++word)
                    for (uint64_t left = edges[word]; left != 0; left &= left - 1) {
                        const size_t x = word * 64 + static_cast<size_t>(std::countr_zero(left));
                        to[x] = finish.handed_on(finish.smoothed(static_cast<int>(x), static_cast<int>(y),
                                                                 static_cast<int>(width), static_cast<int>(height)));
                    }
            }
            if (given.frame->way.w > 0)
                for (size_t x = 0; x < width; ++x) {
                    const uint32_t colour = finish.handed_on(to[x]);  // twice is as it was
                    to[x] = finish.handed_on(finish.covered(colour, x, y));
                }
        }
    });
}

}  // namespace flaneur
#endif
