#include "assets/trajectories/formats/xml.h"

#include <expat.h>

#include <memory>

namespace flaneur {
namespace {

constexpr int k_deepest_xml = 200;
constexpr size_t k_longest_xml_text = size_t{1} << 20, k_xml_piece = size_t{1} << 26;

struct XmlWalk {
    const XmlHandlers& handlers;
    XML_Parser parser = nullptr;
    std::string refused, text;
    int depth = 0;
};

void refuse_xml_walk(XmlWalk& walk, const std::string& what) {
    if (what.empty() || !walk.refused.empty()) return;
    walk.refused = "has in line " + std::to_string(XML_GetCurrentLineNumber(walk.parser)) + " " + what;
    XML_StopParser(walk.parser, XML_FALSE);
}

std::string_view local_name(std::string_view name) {
    const size_t colon = name.find(':');
    return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

void walk_begin(void* user, const XML_Char* name, const XML_Char** pairs) {
    XmlWalk& walk = *static_cast<XmlWalk*>(user);
    if (!walk.refused.empty()) return;
    walk.text.clear();
    if (++walk.depth > k_deepest_xml) return refuse_xml_walk(walk, "elements more than 200 deep");
    refuse_xml_walk(walk, walk.handlers.begin(local_name(name), {pairs}));
}

void walk_end(void* user, const XML_Char* name) {
    XmlWalk& walk = *static_cast<XmlWalk*>(user);
    if (!walk.refused.empty()) return;
    --walk.depth;
    if (walk.handlers.end) refuse_xml_walk(walk, walk.handlers.end(local_name(name), walk.text));
    walk.text.clear();
}

void walk_text(void* user, const XML_Char* text, int length) {
    XmlWalk& walk = *static_cast<XmlWalk*>(user);
    if (!walk.refused.empty()) return;
    walk.text.append(text, static_cast<size_t>(length));
    if (walk.text.size() > k_longest_xml_text) refuse_xml_walk(walk, "a text of more than a megabyte");
}

// Entities may grow without bounds, and none of these formats has any.
void refuse_xml_entity(void* user, const XML_Char*, int, const XML_Char*, int, const XML_Char*,
                       const XML_Char*, const XML_Char*, const XML_Char*) {
    refuse_xml_walk(*static_cast<XmlWalk*>(user), "an entity, which files of this kind have none of");
}

}  // namespace

std::string_view XmlAttributes::operator[](std::string_view name) const {
    for (const char* const* pair = pairs; pair && *pair; pair += 2)
        if (name == *pair) return pair[1];
    return {};
}

bool XmlAttributes::has(std::string_view name) const {
    for (const char* const* pair = pairs; pair && *pair; pair += 2)
        if (name == *pair) return true;
    return false;
}

Result<void> walk_xml(std::string_view text, const XmlHandlers& handlers) {
    XmlWalk walk{.handlers = handlers, .refused = {}, .text = {}};
    const std::unique_ptr<XML_ParserStruct, void (*)(XML_Parser)> parser(XML_ParserCreate(nullptr),
                                                                         XML_ParserFree);
    walk.parser = parser.get();
    XML_SetUserData(walk.parser, &walk);
    XML_SetElementHandler(walk.parser, walk_begin, walk_end);
    if (handlers.keeps_text) XML_SetCharacterDataHandler(walk.parser, walk_text);
    XML_SetEntityDeclHandler(walk.parser, refuse_xml_entity);
    bool is_read = true;
    for (bool is_last = false; is_read && !is_last;) {
        const std::string_view piece = text.substr(0, k_xml_piece);
        text.remove_prefix(piece.size());
        is_last = text.empty();
        is_read =
            XML_Parse(walk.parser, piece.data(), static_cast<int>(piece.size()), is_last) == XML_STATUS_OK;
    }
    if (!walk.refused.empty()) return Error{walk.refused};
    if (!is_read)
        return Error{"is no sound XML in line " + std::to_string(XML_GetCurrentLineNumber(walk.parser)) +
                     ": " + XML_ErrorString(XML_GetErrorCode(walk.parser))};
    return {};
}

}  // namespace flaneur
