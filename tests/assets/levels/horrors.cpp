#include "tests/assets/levels/horrors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numeric>

#include "sim/base/levels.h"
#include "sim/base/math.h"

namespace flaneur {

namespace {

using Place = std::array<float, 3>;

Place place_of(const CharacterVertex& v) { return {v.position.x, v.position.y, v.position.z}; }

std::array<int, 3> shown(const Character& c, const CharacterVertex& v, float u, float w) {
    std::array<int, 3> colour;
    for (size_t n = 0; n < 3; ++n) colour[n] = int(v.colour >> (8 * n) & 0xff);
    if (v.texture == CharacterVertex::k_no_texture) return colour;
    const Texture& t = c.textures[v.texture];
    auto at = [](float x, int size) { return std::min(int((x - std::floor(x)) * float(size)), size - 1); };
    const uint8_t* rgba = &t.rgba[4 * size_t(at(w, t.height) * t.width + at(u, t.width))];
    for (size_t n = 0; n < 3; ++n) colour[n] = colour[n] * rgba[n] / 255;
    return colour;
}

struct PartSeen {
    Vec3 low{1e9f, 1e9f, 1e9f}, high{-1e9f, -1e9f, -1e9f};
    float area = 0;
    std::vector<std::array<int, 3>> colours;
};

std::map<size_t, PartSeen> seen_parts(const Character& c, size_t level) {
    std::map<size_t, PartSeen> seen;
    for (size_t t = 0; t + 2 < c.lods[level].size(); t += 3) {
        std::array<const CharacterVertex*, 3> v;
        for (size_t i = 0; i < 3; ++i) v[i] = &c.vertices[c.lods[level][t + i]];
        const size_t number = v[0]->spare;
        PartSeen& part = seen[number];
        for (const CharacterVertex* corner : v) {
            EXPECT_EQ(size_t{corner->spare}, number) << "a triangle joins two parts";
            const Vec3 p = corner->position;
            part.low = {std::min(part.low.x, p.x), std::min(part.low.y, p.y), std::min(part.low.z, p.z)};
            part.high = {std::max(part.high.x, p.x), std::max(part.high.y, p.y), std::max(part.high.z, p.z)};
        }
        part.area += 0.5f * length(cross(v[1]->position - v[0]->position, v[2]->position - v[0]->position));
        for (float a : {0.34f, 0.8f, 0.1f})
            for (float b : {0.33f, 0.1f}) {
                const float d = 1 - a - b;
                auto colour = shown(c, *v[0], v[0]->u * a + v[1]->u * b + v[2]->u * d,
                                    v[0]->v * a + v[1]->v * b + v[2]->v * d);
                if (v[0]->texture == CharacterVertex::k_no_texture)
                    for (size_t n = 0; n < 3; ++n) {
                        auto channel = [&](size_t i) { return float(v[i]->colour >> (8 * n) & 0xff); };
                        colour[n] = int(channel(0) * a + channel(1) * b + channel(2) * d + 0.5f);
                    }
                part.colours.push_back(colour);
            }
    }
    return seen;
}

}  // namespace

Character bare_body() {
    Character c;
    c.body = standard_body(1.7f);
    c.bind_joints = c.body.joints;
    c.bind_to_canonical.fill({});
    c.lods.resize(1);
    return c;
}

void add_ball(Character& c, Joint joint, Vec3 from, Vec3 to, float radius, int rows, int columns,
              const BallLook& look) {
    const Vec3 middle = (from + to) * 0.5f, axis = normalize_or(to - from, {0, 1, 0});
    const Quat turn = rotation_between({0, 1, 0}, axis);
    const float half = std::max(0.5f * length(to - from), radius);
    auto vertex = [&](int row, int column, int band) {
        const SinCos up = sin_cos(k_pi * (float(row) / float(rows) - 0.5f));
        const SinCos round = sin_cos(2 * k_pi * float(column % columns) / float(columns));
        const bool tip = row == 0 || row == rows;
        const float ring = tip ? 0 : up.cosine;
        CharacterVertex v;
        v.normal = rotate(turn, {ring * round.cosine, up.sine, -ring * round.sine});
        v.position = middle + rotate(turn, {radius * ring * round.cosine, half * up.sine,
                                            -radius * ring * round.sine});
        v.colour = look.colours[size_t(band) % look.colours.size()];
        v.texture = look.texture;
        if (!look.swatches.empty()) v.u = look.swatches[size_t(band) % look.swatches.size()], v.v = 0.5f;
        if (look.is_mapped) v.u = float(column) / float(columns), v.v = 1 - float(row) / float(rows);
        v.joints[0] = joint;
        return v;
    };
    const bool one = look.colours.size() == 1 && look.swatches.size() <= 1;
    for (int row = 0; row < rows; ++row) {
        const auto first = uint32_t(c.vertices.size());
        const bool shares = one && row > 0;
        const uint32_t low = shares ? first - uint32_t(columns + 1) : first;
        if (!shares)
            for (int column = 0; column <= columns; ++column) c.vertices.push_back(vertex(row, column, row));
        const auto high = uint32_t(c.vertices.size());
        for (int column = 0; column <= columns; ++column) c.vertices.push_back(vertex(row + 1, column, row));
        for (uint32_t n = 0; n < uint32_t(columns); ++n) {
            if (row > 0) c.lods[0].insert(c.lods[0].end(), {low + n, low + n + 1, high + n + 1});
            if (row + 1 < rows) c.lods[0].insert(c.lods[0].end(), {low + n, high + n + 1, high + n});
        }
    }
}

Vec3 end_of(const Character& c, Joint joint) {
    const Vec3 place = c.body.joints[joint];
    for (size_t child = size_t(joint) + 1; child < k_joint_count; ++child)
        if (k_joint_parents[child] == joint && child != left_shoulder && child != right_shoulder &&
            child != left_upper_leg && child != right_upper_leg)
            return c.body.joints[child];
    if (joint == left_toes || joint == right_toes) return place + Vec3{0, 0, c.body.toe};
    return place + Vec3{0, joint == head ? 0.2f : -0.17f, 0};
}

Character ball_man(int each, int rows, int columns, const std::vector<BallLook>& looks) {
    Character c = bare_body();
    size_t count = 0;
    for (int j = 0; j < k_joint_count; ++j) {
        const Vec3 from = c.body.joints[size_t(j)], way = end_of(c, Joint(j)) - from;
        const float girth = j <= neck ? 0.13f : j == head ? 0.1f : 0.05f;
        for (int n = 0; n < each; ++n)
            add_ball(c, Joint(j), from + way * ((float(n) + 0.02f) / float(each)),
                     from + way * ((float(n) + 0.98f) / float(each)), girth, rows, columns,
                     looks[count++ % looks.size()]);
    }
    return c;
}

Texture palette_texture() {
    Texture t{256, 1, {}};
    for (uint32_t n = 0; n < 256; ++n) {
        // Four levels of each channel, scattered so that neighbours share next to nothing.
        const uint32_t code = n * 37 % 64;
        for (int shift : {0, 2, 4}) t.rgba.push_back(uint8_t((code >> shift & 3) * 85));
        t.rgba.push_back(255);
    }
    return t;
}

void number_parts(Character& c) {
    std::map<Place, size_t> number;
    for (uint32_t v : c.lods[0]) number.try_emplace(place_of(c.vertices[v]), number.size());
    std::vector<size_t> above(number.size());
    std::iota(above.begin(), above.end(), size_t{0});
    auto root = [&](size_t n) {
        while (above[n] != n) n = above[n] = above[above[n]];
        return n;
    };
    for (size_t t = 0; t + 2 < c.lods[0].size(); t += 3)
        for (size_t i : {1, 2})
            above[root(number[place_of(c.vertices[c.lods[0][t]])])] =
                root(number[place_of(c.vertices[c.lods[0][t + i]])]);
    std::map<size_t, size_t> parts;
    for (uint32_t v : c.lods[0]) {
        const size_t part = root(number[place_of(c.vertices[v])]);
        c.vertices[v].spare = uint8_t(parts.try_emplace(part, parts.size()).first->second % 256);
    }
}

void expect_whole(const Character& c, int colour_tolerance) {
    const std::map<size_t, PartSeen> finest = seen_parts(c, 0);
    for (size_t level = 1; level < c.lods.size(); ++level) {
        SCOPED_TRACE("level " + std::to_string(level) + ", " + std::to_string(c.lods[level].size() / 3) +
                     " triangles");
        const float pixels = k_level_pixels[level - 1] / (2 * k_body_sphere);
        const float least = 2 * c.body.height / pixels;  // metres that two pixels are
        const std::map<size_t, PartSeen> now = seen_parts(c, level);
        size_t gone = 0, shrunk = 0, faded = 0, miscoloured = 0;
        for (const auto& [number, was] : finest) {
            const Vec3 size = was.high - was.low;
            if (std::max({size.x, size.y, size.z}) < least) continue;
            auto found = now.find(number);
            if (found == now.end()) {
                ++gone;
                continue;
            }
            const Vec3 left = found->second.high - found->second.low;
            auto short_of = [&](float is, float should) { return should >= least && is < 0.6f * should; };
            shrunk += short_of(left.x, size.x) || short_of(left.y, size.y) || short_of(left.z, size.z);
            faded += found->second.area < 0.4f * was.area;
            if (colour_tolerance < 0) continue;
            for (const auto& colour : found->second.colours)
                miscoloured += std::none_of(was.colours.begin(), was.colours.end(), [&](const auto& known) {
                    for (size_t n = 0; n < 3; ++n)
                        if (std::abs(known[n] - colour[n]) > colour_tolerance) return false;
                    return true;
                });
        }
        EXPECT_EQ(gone, 0u) << "of " << finest.size() << " parts";
        EXPECT_EQ(shrunk, 0u);
        EXPECT_EQ(faded, 0u);
        EXPECT_EQ(miscoloured, 0u);
    }
}

}  // namespace flaneur
