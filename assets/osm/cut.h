// Cutting a window out of a map, in a file or in memory. Private to assets/osm.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "assets/osm/map.h"
#include "assets/osm/window.h"

namespace flaneur {

// Ids to ask for many others: most of those that are not there are told by a bit.
struct IdSet {
    static constexpr uint64_t k_bits = uint64_t{1} << 24;
    std::vector<int64_t> ids;  // sorted
    std::vector<uint64_t> bits;

    explicit IdSet(std::vector<int64_t> all) : ids(std::move(all)), bits(k_bits / 64) {
        std::sort(ids.begin(), ids.end());
        ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
        for (int64_t id : ids) bits[place(id) / 64] |= uint64_t{1} << place(id) % 64;
    }
    bool has(int64_t id) const {
        return (bits[place(id) / 64] >> place(id) % 64 & 1) != 0 &&
               std::binary_search(ids.begin(), ids.end(), id);
    }

  private:
    static uint64_t place(int64_t id) { return static_cast<uint64_t>(id) & (k_bits - 1); }
};

template <class Object>
IdSet ids_of(const std::vector<Object>& objects) {
    std::vector<int64_t> ids;
    ids.reserve(objects.size());
    for (const Object& object : objects) ids.push_back(object.id);
    return IdSet(std::move(ids));
}

// Of several versions of an object the one that comes last stays.
template <class T>
void sort_by_id(std::vector<T>& items) {
    std::stable_sort(items.begin(), items.end(), [](const T& a, const T& b) { return a.id < b.id; });
    std::reverse(items.begin(), items.end());
    items.erase(std::unique(items.begin(), items.end(), [](const T& a, const T& b) { return a.id == b.id; }),
                items.end());
    std::reverse(items.begin(), items.end());
}

// Nodes about a window, for ways that cross it between two of them: as many as fit, those nearest to it.
struct Belt {
    static constexpr float k_width = 4000;             // metres
    static constexpr size_t k_most = size_t{1} << 20;  // 16 MiB
    struct Place {
        int64_t id;
        Vec2 at;
    };
    const OsmWindow& window;
    float width = k_width;
    size_t most = k_most;
    std::vector<Place> places{};

    // Whether it narrows hangs on how many there are, and not on their order.
    void add(int64_t id, double longitude, double latitude) {
        Vec2 p = window.project.at(near_longitude(longitude, window.project.longitude), latitude);
        auto away = [&](Vec2 q) { return std::max(std::fabs(q.x), std::fabs(q.z)) - window.half; };
        if (away(p) > width) return;
        places.push_back({id, p});
        while (places.size() > most) {
            width *= 0.5f;
            std::erase_if(places, [&](const Place& place) { return away(place.at) > width; });
        }
    }
    void sort() {
        std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.id < b.id; });
    }
    const Vec2* find(int64_t id) const {
        auto at = std::lower_bound(places.begin(), places.end(), id,
                                   [](const Place& place, int64_t i) { return place.id < i; });
        return at != places.end() && at->id == id ? &at->at : nullptr;
    }
};

// Whether a straight line comes into the square of `half` metres to each side about the origin.
inline bool touches_square(Vec2 a, Vec2 b, float half) {
    float from = 0, to = 1;
    for (auto [begin, end] : {std::pair(a.x, b.x), std::pair(a.z, b.z)}) {
        float way = end - begin;
        if (way == 0 && std::fabs(begin) > half) return false;
        if (way == 0) continue;
        float in = (-half - begin) / way, out = (half - begin) / way;
        from = std::max(from, std::min(in, out)), to = std::min(to, std::max(in, out));
    }
    return from <= to;
}

// Ways and multipolygons with a node in the window or near it, or that cross it from one node to the next,
// whole, and the nodes in it. Nothing else is taken. The source is gone through several times, as its objects
// may stand in any order:
//   nodes(visit): visit(id, longitude, latitude, take) of each, where take() is the OsmNode
//   ways(visit): visit(id, count, ref, take), where ref(i) is the id of its i-th node, and take() the OsmWay
//   relations(visit): visit(count, ref, take), where ref(i) is the id of its i-th way, and take() the
//     OsmRelation
template <class Source>
OsmMap cut_to(const OsmWindow& window, Source& source) {
    constexpr float k_beyond = 100;  // how long a piece of a way may be that only crosses a corner, metres
    OsmMap cut;
    Belt belt{window};
    source.nodes([&](int64_t id, double longitude, double latitude, auto take) {
        is_within(window, longitude, latitude, k_beyond) ? cut.nodes.push_back(take())
                                                         : belt.add(id, longitude, latitude);
    });
    belt.sort();
    const IdSet about = ids_of(belt.places);
    auto any_of = [](const IdSet& set, size_t count, auto ref) {
        for (size_t i = 0; i < count; ++i)
            if (set.has(ref(i))) return true;
        return false;
    };
    auto crosses = [&](size_t count, auto ref) {
        const Vec2* before = nullptr;
        for (size_t i = 0; i < count; ++i) {
            const Vec2* here = about.has(ref(i)) ? belt.find(ref(i)) : nullptr;
            if (before && here && touches_square(*before, *here, window.half + k_beyond)) return true;
            before = here;
        }
        return false;
    };
    const IdSet near = ids_of(cut.nodes);
    source.ways([&](int64_t, size_t count, auto ref, auto take) {
        if (any_of(near, count, ref) || crosses(count, ref)) cut.ways.push_back(take());
    });
    const IdSet touching = ids_of(cut.ways);
    source.relations([&](size_t count, auto ref, auto take) {
        if (any_of(touching, count, ref)) cut.relations.push_back(take());
    });
    std::vector<int64_t> members, refs;
    for (const OsmRelation& relation : cut.relations) {
        for (const OsmRelation::Member& member : relation.ways)
            if (!touching.has(member.way)) members.push_back(member.way);
    }
    if (!members.empty()) {
        const IdSet others(std::move(members));
        source.ways([&](int64_t id, size_t, auto, auto take) {
            if (others.has(id)) cut.ways.push_back(take());
        });
    }
    for (const OsmWay& way : cut.ways) refs.insert(refs.end(), way.nodes.begin(), way.nodes.end());
    const IdSet used(std::move(refs));
    std::erase_if(cut.nodes, [&](const OsmNode& node) {
        return !is_within(window, node.longitude, node.latitude) && !used.has(node.id);
    });
    source.nodes([&](int64_t id, double, double, auto take) {
        if (used.has(id) && !near.has(id)) cut.nodes.push_back(take());
    });
    for (OsmNode& node : cut.nodes) node.longitude = near_longitude(node.longitude, window.project.longitude);
    sort_by_id(cut.nodes);
    sort_by_id(cut.ways);
    sort_by_id(cut.relations);
    cut.window = window;
    return cut;
}

}  // namespace flaneur
