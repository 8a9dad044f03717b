#include "tools/flaneur/load/sent.h"

#include <cstdio>
#include <optional>
#include <utility>

namespace flaneur {

namespace {

constexpr size_t k_named = 5;

std::string told(Vec2 p) {
    char text[48];
    std::snprintf(text, sizeof text, "[%.1f, %.1f]", static_cast<double>(p.x), static_cast<double>(p.z));
    return text;
}

std::string told(const Sending& sending, Unwalkable why) {
    const std::string from = told(sending.from.corners[0]), to = told(sending.to.corners[0]);
    if (why == Unwalkable::way) return "no way leads from " + from + " to " + to;
    const bool is_from = why == Unwalkable::from;
    const size_t corners = (is_from ? sending.from : sending.to).corners.size();
    return std::string("nobody walks within 2 m of its \"") + (is_from ? "from\", " : "to\", ") +
           (corners > 1 ? "the area about " : "") + (is_from ? from : to);
}

Result<void> check_heights(const Sending& sending, const std::string& name, const Navmesh& mesh) {
    for (const auto& [end, place] : {std::pair("from", &sending.from), std::pair("to", &sending.to)}) {
        const std::optional<float> there = other_height(*place, mesh);
        if (!there) continue;
        char text[160];
        std::snprintf(text, sizeof text,
                      " whose \"%s\" has the height %.1f, where nobody can walk: the ground there is at "
                      "%.1f. Say that, or leave \"height\" out.",
                      end, static_cast<double>(*place->height), static_cast<double>(*there));
        return Error{"has " + name + text};
    }
    return {};
}

}  // namespace

Result<std::vector<std::string>> check_sent(const std::vector<Sending>& sendings,
                                            const std::vector<std::string>& names, const Navmesh& mesh) {
    std::vector<std::string> notes;
    size_t unwalkable = 0;
    for (size_t i = 0; i < sendings.size(); ++i) {
        if (Result<void> sound = check_heights(sendings[i], names[i], mesh); !sound) return sound.error();
        const Unwalkable why = why_unwalkable(sendings[i], mesh);
        if (why == Unwalkable::no) continue;
        ++unwalkable;
        if (notes.size() < k_named) notes.push_back(names[i] + " cannot be sent: " + told(sendings[i], why));
    }
    if (unwalkable > 0 && unwalkable == sendings.size())
        return Error{"sends nobody who could walk: " + notes[0] +
                     ". Places are [X, Z] in metres from the middle of the city, x to the east, z to the "
                     "south."};
    if (unwalkable > notes.size())
        notes.push_back("nor can " + std::to_string(unwalkable - notes.size()) + " more entries");
    return notes;
}

}  // namespace flaneur
