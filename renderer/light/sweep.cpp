#include "renderer/light/sweep.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

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
HWY_INLINE real3 operator*(real3 a, real3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

struct Row {
    real a, b, c, d;
};
struct Block {
    Row a, b, c, d;
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

HWY_INLINE Whole packed(Whole red, Whole green, Whole blue) {
    return hn::Or(hn::Or(red, hn::ShiftLeft<8>(green)), hn::ShiftLeft<16>(blue));
}

// Lights pixels side by side. The formulas are members, so that they find the frame and its maps.
struct Light {
    const Unlit& unlit;
    const FrameConstants& frame;
    int map_edge;  // of the shadow maps, texels

    explicit Light(const Unlit& from)
        : unlit(from), frame(*from.frame), map_edge(static_cast<int>(from.frame->shadow_texels.z)) {}

    HWY_INLINE Block shadow_texels(real layer, real x, real y) const {
        HWY_ALIGN int32_t at[k_most_lanes];
        HWY_ALIGN int32_t rows[4][2 * k_most_lanes];
        const WholeTag tag;
        const Whole edge = hn::Set(tag, map_edge), low = hn::Set(tag, 0xffff);
        hn::Store(hn::Add(hn::Mul(hn::Add(hn::Mul(whole(layer), edge), whole(y)), edge), whole(x)), tag, at);
        for (size_t i = 0; i < lane_count(); ++i) {
            const uint16_t* texels = unlit.shadows + at[i];
            for (int row = 0; row < 4; ++row) std::memcpy(&rows[row][2 * i], texels + row * map_edge, 8);
        }
        auto number = [&](Whole w) HWY_ATTR { return real(hn::ConvertTo(LaneTag(), hn::And(w, low))); };
        auto row_of = [&](const int32_t* row) HWY_ATTR {
            Whole ab, cd;
            hn::LoadInterleaved2(tag, row, ab, cd);
            return Row{number(ab), number(hn::ShiftRight<16>(ab)), number(cd),
                       number(hn::ShiftRight<16>(cd))};
        };
        return {row_of(rows[0]), row_of(rows[1]), row_of(rows[2]), row_of(rows[3])};
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
        return colour_seen(kept, (x + real(0.5f)) * real(frame.samples.z),
                           (y + real(0.5f)) * real(frame.samples.w));
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
            four[i] = colour_at(all[i], left + real(static_cast<float>(i & 1)),
                                top + real(static_cast<float>(i >> 1)));
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
        const real3 colour =
            is_one ? light.pixels_of_one(at, y, column, row) : light.pixels_of_four(at, y, column, row);
        auto bytes = [&](real c) HWY_ATTR { return floor(saturate(c) * real(255.0f) + real(0.5f)); };
        const real r = bytes(colour.x), g = bytes(colour.y), b = bytes(colour.z);
        const real luma =
            floor((r * real(299.0f) + g * real(587.0f) + b * real(114.0f)) * real(0.001f) + real(0.5f));
        const hn::Rebind<uint32_t, LaneTag> words;
        hn::StoreU(hn::BitCast(words, packed(whole(r), whole(g), whole(b))), words, colours + at);
        const hn::Rebind<uint8_t, LaneTag> narrow;
        hn::StoreU(hn::DemoteTo(narrow, whole(luma)), narrow, lumas + at);
    }
}

// Smooths edges of a lit picture, pixels side by side.
struct Edges {
    const FrameConstants& frame;
    Texels<uint32_t> colours;  // from the first pixel at hand on
    Texels<uint8_t> lumas;

    HWY_INLINE real luma_near(int x, int y) const {
        const hn::Rebind<uint8_t, LaneTag> narrow;
        const auto* from = lumas.first + (y * static_cast<ptrdiff_t>(lumas.stride) + x);
        return real(hn::ConvertTo(LaneTag(), hn::PromoteTo(WholeTag(), hn::LoadU(narrow, from))));
    }
    HWY_INLINE Whole colour_near(int x, int y) const {
        const auto* from = colours.first + (y * static_cast<ptrdiff_t>(colours.stride) + x);
        return hn::BitCast(WholeTag(), hn::LoadU(hn::Rebind<uint32_t, LaneTag>(), from));
    }

#include "shaders/light/smooth.h"

    // Pixels from x on.
    HWY_INLINE void smooth(size_t x, real column, real line, uint32_t* row) {
        const LaneTag lanes;
        const Smoothing taken = smoothing_at(column, line);
        const auto is_taking = (taken.share > real(0.0f)).m;
        if (hn::AllFalse(lanes, is_taking)) return;
        const auto pick = [&](truth m, Whole yes, Whole no)
                              HWY_ATTR { return hn::IfThenElse(hn::RebindMask(WholeTag(), m.m), yes, no); };
        const truth is_before = taken.to < real(0.0f);
        const Whole own = colour_near(0, 0);
        const Whole other = pick(taken.is_level, pick(is_before, colour_near(0, -1), colour_near(0, 1)),
                                 pick(is_before, colour_near(-1, 0), colour_near(1, 0)));
        auto mixed = [&](int shift) HWY_ATTR {
            const real mine = byte_of(own, shift);
            return whole(floor(mine + (byte_of(other, shift) - mine) * taken.share + real(0.5f)));
        };
        const Whole out = packed(mixed(0), mixed(8), mixed(16));
        const hn::Rebind<uint32_t, LaneTag> words;
        hn::StoreU(hn::BitCast(words, pick({is_taking}, out, own)), words, row + x);
    }
};

// Smooths a row's edges. The last pixels lie over those before, as in light_row().
void smooth_row(const FrameConstants& frame, Texels<uint32_t> colours, Texels<uint8_t> lumas, size_t y,
                size_t width, uint32_t* row) {
    const size_t lanes = lane_count();
    const real steps(hn::ConvertTo(LaneTag(), hn::Iota(WholeTag(), 0))), line(static_cast<float>(y));
    Edges edges{frame, colours, lumas};
    for (size_t x = 0; x < width; x += lanes) {
        const size_t at = std::min(x, width - lanes);
        edges.colours.first = colours.first + y * colours.stride + at;
        edges.lumas.first = lumas.first + y * lumas.stride + at;
        edges.smooth(at, real(static_cast<float>(at)) + steps, line, row);
    }
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flaneur {

HWY_EXPORT(light_row);
HWY_EXPORT(smooth_row);

namespace {

constexpr size_t k_rows = 8;          // that a thread takes at once
constexpr size_t k_least_width = 16;  // pixels, that lanes light together
constexpr size_t k_margin = 16;       // pixels about a lit picture, for those who look beyond its border
static_assert(k_margin > k_edge_reach);

// Copies of rows too short for lanes.
template <class T>
std::vector<T> widened(Texels<T>& texels, size_t each, size_t width, size_t rows, size_t least) {
    std::vector<T> out(each * least * rows);
    for (size_t y = 0; y < rows; ++y)
        std::copy_n(texels.first + each * y * texels.stride, each * width, &out[each * y * least]);
    texels = {out.data(), least};
    return out;
}

float channel(uint32_t colour, int number) { return static_cast<float>(colour >> 8 * number & 255); }

// What is laid over a row of pixels, the mean of a pixel's samples, over it.
void cover_row(const Unlit& unlit, size_t y, std::span<uint32_t> row) {
    const auto samples = static_cast<size_t>(unlit.frame->samples.x);
    const float each = 1 / static_cast<float>(samples * samples);
    for (size_t x = 0; x < row.size(); ++x) {
        float over[4] = {};
        for (size_t i = 0; i < samples * samples; ++i) {
            const size_t line = samples * y + i / samples, column = samples * x + i % samples;
            const auto texel =
                static_cast<uint32_t>(unlit.overlay.first[line * unlit.overlay.stride + column]);
            for (int k = 0; k < 4; ++k) over[k] += channel(texel, k) * each;
        }
        if (over[3] == 0) continue;
        const uint32_t below = std::exchange(row[x], 0);
        for (int k = 0; k < 3; ++k) {
            const float value = channel(below, k) * (1 - over[3] / 255) + over[k] + 0.5f;
            row[x] |= static_cast<uint32_t>(std::min(value, 255.0f)) << 8 * k;
        }
    }
}

// Opaque, with the bytes in the picture's order.
void hand_on(std::span<uint32_t> row, bool is_blue_first) {
    for (uint32_t& c : row)
        c = 0xff000000u | (is_blue_first ? (c & 0xff) << 16 | (c & 0xff00) | (c >> 16 & 0xff) : c);
}

}  // namespace

void light_picture(const Unlit& given, Workers& workers, LitPicture& lit, bool is_blue_first,
                   uint32_t* pixels) {
    Unlit unlit = given;
    const FrameConstants& frame = *given.frame;
    const auto width = static_cast<size_t>(frame.screen.x), height = static_cast<size_t>(frame.screen.y);
    const auto samples = static_cast<size_t>(frame.samples.x);
    const size_t span = std::max(width, k_least_width);
    std::vector<int32_t> colours, surfaces;
    std::vector<float> depths;
    if (width < span) {
        const size_t rows = samples * height;
        colours = widened(unlit.colours, 1, samples * width, rows, samples * span);
        surfaces = widened(unlit.surfaces, 2, samples * width, rows, samples * span);
        depths = widened(unlit.depths, 1, samples * width, rows, samples * span);
    }
    const size_t stride = span + 2 * k_margin, first = k_margin * stride + k_margin;
    lit.colours.resize(stride * (height + 2 * k_margin));
    lit.lumas.resize(lit.colours.size());
    auto light = [&](size_t y) {
        const size_t at = first + y * stride;
        return HWY_DYNAMIC_DISPATCH(light_row)(unlit, y, span, &lit.colours[at], &lit.lumas[at]);
    };
    parallel_for(workers, height, k_rows, [&](size_t begin, size_t end, int) {
        for (size_t y = begin; y < end; ++y) light(y);
    });
    const Texels<uint32_t> lit_colours{&lit.colours[first], stride};
    const Texels<uint8_t> lit_lumas{&lit.lumas[first], stride};
    auto smooth = [&](size_t y, uint32_t* row) {
        return HWY_DYNAMIC_DISPATCH(smooth_row)(frame, lit_colours, lit_lumas, y, span, row);
    };
    const bool is_smooth = given.smooths_edges && frame.backdrop.w == 0;
    parallel_for(workers, height, k_rows, [&](size_t begin, size_t end, int) {
        std::vector<uint32_t> wide(width < span ? span : 0);
        for (size_t y = begin; y < end; ++y) {
            const std::span<uint32_t> row(pixels + y * width, width);
            uint32_t* const smoothed = wide.empty() ? row.data() : wide.data();
            std::copy_n(lit_colours.first + y * stride, span, smoothed);
            if (is_smooth) smooth(y, smoothed);
            std::copy_n(smoothed, wide.empty() ? 0 : width, row.data());
            if (frame.way.w > 0) cover_row(given, y, row);
            hand_on(row, is_blue_first);
        }
    });
}

}  // namespace flaneur
#endif
