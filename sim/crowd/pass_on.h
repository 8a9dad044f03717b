#pragma once

#include <cstdint>

namespace flaneur {

// On which side people pass those who come the other way.
enum class PassOn : uint8_t { right, left };

}  // namespace flaneur
