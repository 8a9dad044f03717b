// What a field of the state is called: "gait.left.from.x", as parts that lie on the stack, so that who walks
// over all fields without asking for their names pays nothing for them.
#pragma once

#include <string>
#include <string_view>

namespace flaneur {

struct FieldName {
    std::string_view part;
    const FieldName* before = nullptr;
};

inline std::string full_name(const FieldName& name) {
    return name.before ? full_name(*name.before) + "." + std::string(name.part) : std::string(name.part);
}

}  // namespace flaneur
