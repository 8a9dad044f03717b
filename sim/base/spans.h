// Things that a few walkers have, in lists by walker.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace flaneur {

// Indices [begin, end) of such a list.
struct Span {
    size_t begin, end;
};

// Those of walkers [begin, end).
template <class Item>
Span span_of(const std::vector<Item>& items, size_t begin, size_t end) {
    auto before = [](const Item& item, size_t walker) { return item.walker < walker; };
    auto first = std::lower_bound(items.begin(), items.end(), begin, before);
    auto last = std::lower_bound(first, items.end(), end, before);
    return {static_cast<size_t>(first - items.begin()), static_cast<size_t>(last - items.begin())};
}

// What a walker has; null: nothing. `items` is such a list, const or not.
template <class List>
auto own_of(List& items, size_t walker) -> decltype(items.data()) {
    const Span own = span_of(items, walker, walker + 1);
    return own.begin < own.end ? &items[own.begin] : nullptr;
}

// Takes away what a walker had; where its next one goes.
template <class Item>
typename std::vector<Item>::iterator take_away(std::vector<Item>& items, size_t walker) {
    const Span own = span_of(items, walker, walker + 1);
    auto at = items.begin() + static_cast<std::ptrdiff_t>(own.begin);
    return own.begin < own.end ? items.erase(at) : at;
}

// What a walker has, alone in `to`, as if it were walker `as`.
template <class Item>
void copy_own(const std::vector<Item>& items, size_t walker, size_t as, std::vector<Item>& to) {
    to.clear();
    const Span own = span_of(items, walker, walker + 1);
    for (size_t i = own.begin; i < own.end; ++i) {
        to.push_back(items[i]);
        to.back().walker = static_cast<uint32_t>(as);
    }
}

}  // namespace flaneur
