// XML from outside, element by element. Private to assets/trajectories.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "sim/base/result.h"

namespace flaneur {

// Of the element that has just begun; what they give is gone when it ends.
struct XmlAttributes {
    const char* const* pairs = nullptr;
    // Empty where there is none.
    std::string_view operator[](std::string_view name) const;
    bool has(std::string_view name) const;
};

// Elements' names come without what stands before a colon. A sentence that is returned, "a row without x",
// ends the reading: "has in line 7 a row without x".
struct XmlHandlers {
    std::function<std::string(std::string_view name, XmlAttributes attributes)> begin;
    std::function<std::string(std::string_view name, std::string_view text)> end;  // text within, if kept
    bool keeps_text = false;
};

// Refuses entities, elements more than 200 deep and texts of more than a megabyte. Errors' sentences have no
// subject.
Result<void> walk_xml(std::string_view text, const XmlHandlers& handlers);

}  // namespace flaneur
