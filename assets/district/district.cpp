#include "assets/district/district.h"

#include <algorithm>

#include "assets/cities.h"

namespace flaneur {

namespace {

constexpr float k_belt = 60;  // from the outermost streets to the edge of the map, metres

// The block with its fronts, and the way that each looks onto.
Block block_of(const District& d, const BlockPlan& plan, uint32_t number, uint64_t seed) {
    Block block;
    block.outline = plan.outline;
    block.ring = plan.ring;
    block.dice = {{seed, number, 6, Purpose::city}};
    for (size_t k = 0; k < plan.ring.size(); ++k) {
        Front front{to_metres(plan.ring[k]), to_metres(plan.ring[(k + 1) % plan.ring.size()])};
        Vec2 at = lerp(front.a, front.b, 0.5f);
        float nearest = 1e9f;
        for (uint32_t w : plan.ways) {
            const std::vector<Vec2>& line = d.streets.ways[w].line;
            for (size_t i = 0; i + 1 < line.size(); ++i) {
                Vec2 u = normalize_or(line[i + 1] - line[i], {1, 0});
                float s = clamp(dot(at - line[i], u), 0, length(line[i + 1] - line[i]));
                float away = std::fabs(length(at - line[i] - u * s) - d.streets.ways[w].half());
                if (away < nearest) nearest = away, front.way = w;
            }
        }
        front.busy = d.streets.ways[front.way].kind == WayKind::avenue;
        block.fronts.push_back(front);
    }
    return block;
}

void fill_blocks(District& d, uint64_t seed) {
    const std::vector<BlockPlan>& plots = d.streets.plots;
    std::vector<uint8_t> at_square(d.streets.ways.size(), 0);
    for (const BlockPlan& plot : plots) {
        if (plot.use != BlockUse::square) continue;
        for (uint32_t w : plot.ways) at_square[w] = 1;
    }
    for (uint32_t number = 0; number < plots.size(); ++number) {
        const BlockPlan& plot = plots[number];
        Block block = block_of(d, plot, number, seed);
        bool has_arcade = block.dice.chance(0.75f);
        for (Front& front : block.fronts) {
            front.busy |= at_square[front.way] != 0;
            front.arcade = has_arcade && plot.use == BlockUse::houses && at_square[front.way] != 0;
        }
        switch (plot.use) {
            case BlockUse::houses:
                fill_houses(d, block);
                break;
            case BlockUse::villas:
                fill_villas(d, block);
                break;
            case BlockUse::slabs:
                fill_slabs(d, block);
                break;
            case BlockUse::park:
                fill_park(d, block);
                break;
            case BlockUse::square:
                fill_square(d, block);
                break;
        }
    }
}

}  // namespace

void settle(City& city) {
    auto ground_under = [&](Vec3 p) { return ground_at(city.ground, at_height(on_ground(p), 0), 60, 60); };
    std::erase_if(city.props, [&](Prop& prop) {
        std::optional<GroundHit> hit = ground_under(prop.position);
        if (hit) prop.position.y = hit->height;
        if (!hit || hit->kind == Surface::crossing) return true;
        if ((hit->kind == Surface::water) != (prop.kind == PropKind::fountain)) return true;
        return (hit->kind == Surface::road) != (prop.kind == PropKind::car);
    });
    std::erase_if(city.destinations, [&](Destination& place) {
        std::optional<GroundHit> hit = ground_under(place.position);
        if (hit) place.position.y = hit->height;
        return !hit || hit->kind == Surface::road || hit->kind == Surface::water;
    });
}

City generate_district(const DistrictOptions& options) {
    District d;
    d.plan.cell = 12;
    d.streets = plan_streets(options.seed, options.blocks, k_belt, d.plan.cell, options.trams);
    d.city.ground.name = "district";
    d.plan.low = d.streets.low;
    d.plan.high = d.streets.high;
    d.plan.terrain = [&](Vec2 p) { return terrain_at(d, p); };
    lend_colours(d);
    lay_streets(d, options.seed);
    fill_blocks(d, options.seed);
    for (uint32_t way : d.streets.outer) fill_belt(d, way, options.seed);
    add_area(d, k_rank_rest, Surface::grass, flat(k_kerb),
             {rectangle(to_point(d.plan.low), to_point(d.plan.high))});
    lay_ground(d.plan, d.city);
    index_city(d.city);
    settle(d.city);
    settle_crossings(d.city);
    list_obstacles(d.city);
    lay_lanes(d);
    add_horizon(d, options.seed);
    return std::move(d.city);
}

}  // namespace flaneur
