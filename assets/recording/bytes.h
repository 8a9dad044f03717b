// Numbers as bytes, little-endian as the machines that this runs on, and back. Private to assets/recording.
#pragma once

#include <bit>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

namespace flaneur {

static_assert(std::endian::native == std::endian::little);

template <class T>
void put_number(std::string& bytes, T value) {
    static_assert(std::is_arithmetic_v<T>);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// Takes one from the front of `bytes`; false where there are too few.
template <class T>
bool take_number(std::string_view& bytes, T& value) {
    static_assert(std::is_arithmetic_v<T>);
    if (bytes.size() < sizeof value) return false;
    std::memcpy(&value, bytes.data(), sizeof value);
    bytes.remove_prefix(sizeof value);
    return true;
}

}  // namespace flaneur
