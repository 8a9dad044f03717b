// Texts with values in them.
#pragma once

#include <cstdio>
#include <string>

namespace flaneur {

// As printf has it; 255 characters at most.
template <class... Values>
std::string put_values(const char* pattern, Values... values) {
    char text[256];
    std::snprintf(text, sizeof text, pattern, values...);
    return text;
}

}  // namespace flaneur
