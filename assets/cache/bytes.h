// Arrays as the bytes of a kept file, each after its length.
#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>

namespace flaneur {

template <class T>
void put(std::string& bytes, std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    uint64_t count = values.size();
    bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
}

// Takes what `put` put from the front of `bytes`; false if there is less, or not as much as a `values` of
// fixed size holds.
template <class T, class Values>
bool take(std::span<const char>& bytes, Values& values) {
    uint64_t count = 0;
    if (bytes.size() < sizeof count) return false;
    std::memcpy(&count, bytes.data(), sizeof count);
    bytes = bytes.subspan(sizeof count);
    if (count > bytes.size() / sizeof(T)) return false;
    if constexpr (requires { values.resize(count); }) {
        values.resize(count);
    } else if (count != std::size(values)) {
        return false;
    }
    if (count > 0) std::memcpy(values.data(), bytes.data(), count * sizeof(T));
    bytes = bytes.subspan(count * sizeof(T));
    return true;
}

}  // namespace flaneur
