#include "sim/fields.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <type_traits>

#include "sim/alongside/alongside.h"
#include "sim/base/hash.h"
#include "sim/crowd/values-inl.h"
#include "sim/pastimes/pastimes.h"
#include "sim/row_names-inl.h"
#include "sim/stepping.h"

namespace flaneur {
namespace {

// The arrays of the state besides the crowd's, in the order in which they are hashed: each(name, array).
template <class Each>
void for_each_array(const World& w, const Each& each) {
    const FieldName k_surface{"surface"}, k_idle{"idle"};
    if (w.roam) {
        const SurfaceWalkers& s = w.roam->walkers;
        auto add = [&](std::string_view name, const auto& array) {
            each(FieldName{name, &k_surface}, array);
        };
        add("frame", w.roam->frames);
        add("position", s.position), add("up", s.up), add("ahead", s.ahead), add("speed", s.speed);
        add("pace", s.pace), add("turn_rate", s.turn_rate), add("moved", s.moved);
        if (w.roam->gravity.bodies > 1) add("leap", s.leaps);
    }
    each(FieldName{"gait"}, w.gait.blocks);
    each(FieldName{"person"}, w.gait.people);
    each(FieldName{"pose"}, w.poses);
    each(FieldName{"cane"}, w.gait.canes);
    each(FieldName{"pram"}, w.gait.prams);
    each(FieldName{"wanted", &k_idle}, w.idles.wanted);
    each(FieldName{"playing", &k_idle}, w.idles.playing);
    each(FieldName{"stood", &k_idle}, w.idles.stood);
    each(FieldName{"play", &k_idle}, w.idles.plays);
}

// Items that only some walkers have say whose they are.
template <class Item>
constexpr bool has_walker = requires(Item item) {
    item.walker;
};
template <class Item>
constexpr bool is_block =
    std::is_same_v<Item, GaitBlock> || std::is_same_v<Item, PersonBlock> || std::is_same_v<Item, PoseBlock>;

// Takes a value apart into words: each(name, kind, word).
template <class T, class Each>
void for_each_word(const FieldName& name, const T& value, const Each& each) {
    auto parts = [&](const auto& list) {
        for (const auto& [part, number] : list) for_each_word(FieldName{part, &name}, number, each);
    };
    struct Named {
        std::string_view part;
        float number;
    };
    if constexpr (std::is_same_v<T, float>) {
        each(name, 'f', std::bit_cast<uint32_t>(value));
    } else if constexpr (std::is_enum_v<T> || std::is_integral_v<T>) {
        static_assert(sizeof value <= 4);
        each(name, std::is_same_v<T, int32_t> ? 'i' : 'u', static_cast<uint32_t>(value));
    } else if constexpr (std::is_same_v<T, Vec2>) {
        parts(std::initializer_list<Named>{{"x", value.x}, {"z", value.z}});
    } else if constexpr (std::is_same_v<T, Vec3>) {
        parts(std::initializer_list<Named>{{"x", value.x}, {"y", value.y}, {"z", value.z}});
    } else if constexpr (std::is_same_v<T, Quat>) {
        parts(std::initializer_list<Named>{{"x", value.x}, {"y", value.y}, {"z", value.z}, {"w", value.w}});
    } else if constexpr (std::is_same_v<T, Stay>) {
        parts(std::initializer_list<Named>{{"least", value.least}, {"most", value.most}});
    } else if constexpr (std::is_same_v<T, Footwork>) {
        parts(std::initializer_list<Named>{{"lands", value.lands}, {"swings", value.swings}});
        for_each_word(FieldName{"beside", &name}, value.beside, each);
    } else if constexpr (std::is_same_v<T, NavPoint>) {
        for_each_word(FieldName{"position", &name}, value.position, each);
        for_each_word(FieldName{"polygon", &name}, value.polygon, each);
    } else if constexpr (std::is_same_v<T, Door>) {
        for_each_word(FieldName{"at", &name}, value.at, each);
        for_each_word(FieldName{"way", &name}, value.way, each);
    } else if constexpr (std::is_same_v<T, WalkerId>) {
        for_each_word(FieldName{"index", &name}, value.index, each);
        for_each_word(FieldName{"generation", &name}, value.generation, each);
    } else if constexpr (std::is_same_v<T, Stride>) {
        for_each_word(FieldName{"centre", &name}, value.centre, each);
        parts(std::initializer_list<Named>{
            {"radius", value.radius}, {"side", value.side}, {"left", value.left}});
        for_each_word(FieldName{"circles", &name}, value.circles, each);
    } else if constexpr (std::is_same_v<T, Platform>) {
        each(name, 'h', static_cast<uint32_t>(hash_bytes(1, &value, sizeof value)));
    } else if constexpr (std::is_same_v<T, Claim>) {
        for_each_word(FieldName{"since", &name}, value.since, each);
        for_each_word(FieldName{"owner", &name}, value.owner, each);
        for_each_word(FieldName{"heirs", &name}, value.heirs, each);
    } else if constexpr (std::is_same_v<T, Roam::Frame>) {
        for_each_word(FieldName{"position", &name}, value.position, each);
        for_each_word(FieldName{"rotation", &name}, value.rotation, each);
    } else if constexpr (std::is_same_v<T, Leap>) {
        for_each_word(FieldName{"stage", &name}, value.stage, each);
        for_each_word(FieldName{"is_asked", &name}, value.is_asked, each);
        for_each_word(FieldName{"to", &name}, value.to, each);
        for_each_word(FieldName{"velocity", &name}, value.velocity, each);
        for_each_word(FieldName{"place", &name}, value.place, each);
        for_each_word(FieldName{"normal", &name}, value.normal, each);
        parts(std::initializer_list<Named>{{"seconds", value.seconds},
                                           {"lasts", value.lasts},
                                           {"turn", value.turn},
                                           {"landing", value.landing}});
    } else if constexpr (std::is_same_v<T, std::span<const Vec3>>) {
        each(name, 'h', static_cast<uint32_t>(hash_bytes(1, value.data(), value.size_bytes())));
    } else {
        static_assert(has_walker<T>);
        for_each_value(value, &name, [&](const FieldName& n, const auto& v) { for_each_word(n, v, each); });
    }
}
// Of one who does not have it, nothing, by the same names.
template <class T, class Each>
void for_each_word(const FieldName& name, const T* value, const Each& each) {
    const T nothing{};
    for_each_word(name, value ? *value : nothing, [&](const FieldName& n, char kind, uint32_t word) {
        each(n, static_cast<char>(kind - 'a' + 'A'), value ? word : k_absent);
    });
}

// One lane of a row, or of rows of rows.
template <class Each>
void for_each_lane_word(const FieldName& name, const float (&row)[k_block], size_t lane, const Each& each) {
    for_each_word(name, row[lane], each);
}
template <class Each>
void for_each_lane_word(const FieldName& name, const int32_t (&row)[k_block], size_t lane, const Each& each) {
    for_each_word(name, row[lane], each);
}
template <class Row, size_t rows, class Each>
requires std::is_array_v<Row>
void for_each_lane_word(const FieldName& name, const Row (&row)[rows], size_t lane, const Each& each) {
    constexpr std::string_view k_axes[] = {"x", "y", "z", "w"}, k_sides[] = {"left", "right"};
    constexpr std::string_view k_numbers[] = {"0", "1", "2", "3", "4"};
    for (size_t i = 0; i < rows; ++i) {
        std::string_view part;
        if constexpr (rows == k_joint_count)
            part = k_joint_names[i];
        else if constexpr (rows == k_posture_count)
            part = k_posture_names[i];
        else if constexpr (rows == 2)
            part = k_sides[i];
        else
            part = name.part == "girth" ? k_numbers[i] : k_axes[i];
        for_each_lane_word(FieldName{part, &name}, row[i], lane, each);
    }
}

// The item of a walker; null: it has none. Canes and prams lie by walker.
template <class Item>
const Item* item_of(const World&, const std::vector<Item>& items, uint32_t walker) {
    const auto found = std::ranges::lower_bound(items, walker, {}, &Item::walker);
    return found == items.end() || found->walker != walker ? nullptr : &*found;
}
const ClipPlay* item_of(const World& w, const std::vector<ClipPlay>& plays, uint32_t walker) {
    return w.idles.playing[walker] ? &*std::ranges::find(plays, walker, &ClipPlay::walker) : nullptr;
}

// All numbers of one walker: each(name, kind, word), by the same names for everybody.
template <class Each>
void for_each_word(const World& w, uint32_t walker, const Each& each) {
    for_each_value(w.crowd, walker,
                   [&](const FieldName& name, const auto& value) { for_each_word(name, value, each); });
    for_each_word(FieldName{"generation"}, w.crowd.slots.generation[walker], each);
    for_each_array(w, [&]<class Item>(const FieldName& name, const std::vector<Item>& items) {
        if constexpr (is_block<Item>) {
            const size_t lane = walker % k_block;
            for_each_row(items[walker / k_block], &name, [&](const FieldName& n, const auto& row) {
                for_each_lane_word(n, row, lane, each);
            });
        } else if constexpr (has_walker<Item>) {
            for_each_word(name, item_of(w, items, walker), each);
        } else {
            for_each_word(name, items[walker], each);
        }
    });
}

// And of the crowd as a whole.
template <class Each>
void for_each_crowd_word(const World& w, const Each& each) {
    const Crowd& c = w.crowd;
    const FieldName k_crowd{"crowd"};
    auto add = [&](std::string_view name, char kind, uint32_t word) {
        each(FieldName{name, &k_crowd}, kind, word);
    };
    auto hash = [](const auto& list) {
        return static_cast<uint32_t>(hash_bytes(1, list.data(), list.size() * sizeof(list[0])));
    };
    add("count", 'u', c.count);
    add("next_path", 'u', c.next_path);
    add("living", 'h', hash(c.slots.living));
    add("left", 'h', hash(c.slots.left));
    const Coming& coming = w.coming;
    add("came", 'u', coming.came);
    add("gone", 'u', coming.left);
    add("successors", 'h', hash(coming.successors.entrants));
    add("sent", 'h', hash(coming.sent.entrants));
    add("slow", 'h', hash(c.traffic.slow));
    add("getting_slow", 'h', hash(c.traffic.coming));
    add("traffic_done", 'u', c.traffic.done);
    add("linkages", 'h', hash(w.linkages.places));
    add("deeds", 'h', hash(w.deeds.doers));
    add("bipeds", 'h', w.stepping ? static_cast<uint32_t>(hash_bipeds(*w.stepping)) : 0);
    add("movers", 'h', hash(w.movers.places));
    add("vehicles", 'h', hash(w.vehicles.all));
    add("balls", 'h', static_cast<uint32_t>(hash_balls(w.balls)));
    add("falls", 'h', static_cast<uint32_t>(hash_falls(w)));
    add("alongside", 'h', w.alongside ? static_cast<uint32_t>(hash_alongside(*w.alongside)) : 0);
    add("bystanders", 'h', static_cast<uint32_t>(hash_bystanders(w)));
    add("company", 'h', is_on(w.company) ? static_cast<uint32_t>(hash_company(w.company)) : 0);
    add("pastimes", 'h', static_cast<uint32_t>(hash_pastimes(*w.pastimes)));
    const bool marches = is_on(c.march);
    add("march", 'h', marches ? static_cast<uint32_t>(hash_bytes(1, &c.march.how, sizeof c.march.how)) : 0);
    add("march_pace", 'h', marches ? hash(c.march.pace) : 0);
    add("march_turns", 'h', marches ? hash(c.march.turns) : 0);
    add("driven", 'U', c.driven.walker);
    for_each_word(FieldName{"driven_wish", &k_crowd}, c.driven.walker == k_nobody ? nullptr : &c.driven.wish,
                  each);
}

}  // namespace

uint64_t hash_world(const World& world) {
    uint64_t hash = mix(world.seed) ^ world.tick;
    hash = mix(hash ^ hash_crowd(world.crowd));
    if (comes_and_goes(world.coming, world.crowd)) hash = mix(hash ^ hash_coming(world.coming));
    if (!world.balls.all.empty()) hash = mix(hash ^ hash_balls(world.balls));
    if (has_traffic(world.vehicles)) hash = mix(hash ^ hash_vehicles(world.vehicles));
    if (!world.falls.all.empty()) hash = mix(hash ^ hash_falls(world));
    if (is_on(world.company)) hash = mix(hash ^ hash_company(world.company));
    if (!world.bystanders.all.empty()) hash = mix(hash ^ hash_bystanders(world));
    if (world.alongside) hash = mix(hash ^ hash_alongside(*world.alongside));
    if (!world.pastimes->all.empty()) hash = mix(hash ^ hash_pastimes(*world.pastimes));
    const std::vector<Vec3>& linkages = world.linkages.places;
    if (!linkages.empty()) hash = hash_bytes(hash, linkages.data(), linkages.size() * sizeof linkages[0]);
    const std::vector<Doer>& doers = world.deeds.doers;
    if (!doers.empty()) hash = hash_bytes(hash, doers.data(), doers.size() * sizeof doers[0]);
    if (is_on(world.traced)) {
        const Traced& t = world.traced;
        hash = mix(hash ^ t.next);
        hash = hash_bytes(hash, t.way_of.data(), t.way_of.size() * sizeof t.way_of[0]);
    }
    if (world.stepping) hash = mix(hash ^ hash_bipeds(*world.stepping));
    const std::vector<Placement>& movers = world.movers.places;
    if (!movers.empty()) hash = hash_bytes(hash, movers.data(), movers.size() * sizeof movers[0]);
    for_each_array(world, [&]<class Item>(const FieldName&, const std::vector<Item>& items) {
        if constexpr (std::is_same_v<Item, ClipPlay>) {  // which has padding
            for (const Item& play : items)
                for_each_word({}, play,
                              [&](const FieldName&, char, uint32_t word) { hash = mix(hash ^ word); });
        } else {
            static_assert(std::is_trivially_copyable_v<Item>);
            const bool is_list = has_walker<Item>;
            if (is_list && items.empty()) return;
            hash = hash_bytes(hash, items.data(), items.size() * sizeof(Item));
        }
    });
    return hash;
}

StateFields state_fields(const World& world) {
    StateFields fields;
    auto into = [](std::vector<StateField>& list) {
        return [&list](const FieldName& name, char kind, uint32_t) {
            list.push_back({full_name(name), kind});
        };
    };
    if (world.crowd.capacity > 0) for_each_word(world, 0, into(fields.walkers));
    for_each_crowd_word(world, into(fields.crowd));
    return fields;
}

void digest_state(const World& world, StateDigest& digest) {
    constexpr uint64_t k_odd = 0x9e3779b97f4a7c15;
    auto last = [](uint64_t hash) { return static_cast<uint16_t>(mix(hash)); };
    digest.hash = hash_world(world);
    digest.walkers.assign(world.crowd.capacity, 0);
    std::vector<uint64_t> sums;  // of each field
    for (uint32_t i = 0; i < world.crowd.count; ++i) {
        if (!is_there(world.crowd, i)) continue;
        size_t field = 0;
        uint64_t sum = 0;
        for_each_word(world, i, [&](const FieldName&, char, uint32_t word) {
            const uint64_t mixed = mix(word | uint64_t{i} << 32);
            if (field == sums.size()) sums.push_back(0);
            sums[field++] += mixed;
            sum = sum * k_odd + mixed;
        });
        digest.walkers[i] = last(sum);
    }
    digest.fields.clear();
    for (uint64_t sum : sums) digest.fields.push_back(last(sum));
    for_each_crowd_word(world,
                        [&](const FieldName&, char, uint32_t word) { digest.fields.push_back(last(word)); });
}

std::vector<uint32_t> state_words(const World& world) {
    std::vector<uint32_t> words;
    for (uint32_t i = 0; i < world.crowd.capacity; ++i) {
        const bool is_empty = !is_there(world.crowd, i);
        for_each_word(world, i, [&](const FieldName&, char, uint32_t word) {
            words.push_back(is_empty ? k_absent : word);
        });
    }
    for_each_crowd_word(world, [&](const FieldName&, char, uint32_t word) { words.push_back(word); });
    return words;
}

std::string told_word(const StateField& field, uint32_t word) {
    const bool is_optional = std::isupper(static_cast<unsigned char>(field.kind)) != 0;
    if (is_optional && word == k_absent) return "none";
    char text[32];
    char* const end = text + sizeof text;
    std::to_chars_result told{text, {}};
    switch (std::tolower(static_cast<unsigned char>(field.kind))) {
        case 'f':
            told = std::to_chars(text, end, std::bit_cast<float>(word));
            break;
        case 'i':
            told = std::to_chars(text, end, static_cast<int32_t>(word));
            break;
        case 'h':
            told = std::to_chars(text, end, word, 16);
            break;
        default:
            told = std::to_chars(text, end, word);
    }
    return {text, told.ptr};
}

}  // namespace flaneur
