#include "tools/rendercheck/suite/reading.h"

#include <algorithm>
#include <cstdio>

#include "tools/flaneur/options/spelling.h"

namespace flaneur {
namespace {

using Json = nlohmann::json;

const char* told_type(Json::value_t type) {
    switch (type) {
        case Json::value_t::object:
            return "must be an object, {...}";
        case Json::value_t::array:
            return "must be a list, [...]";
        case Json::value_t::boolean:
            return "must be true or false";
        default:
            return "must be a string";
    }
}

}  // namespace

JsonReading::JsonReading(std::string& first_fault, std::string at, const Json& object)
    : fault(first_fault), where(std::move(at)), value(object) {
    if (!object.is_object() && fault.empty())
        fault = (where.empty() ? "it " : where.substr(0, where.find_last_not_of(".: ") + 1) + " ") +
                "must be an object, {...}";
}

void JsonReading::fail(const std::string& key, const std::string& why) {
    if (fault.empty()) fault = where + "\"" + key + "\" " + why;
}

const Json* JsonReading::any(const std::string& key) {
    known.push_back(key);
    if (!value.is_object()) return nullptr;
    const auto found = value.find(key);
    return found == value.end() ? nullptr : &*found;
}

const Json* JsonReading::member(const std::string& key, Json::value_t type) {
    const Json* found = any(key);
    if (!found || found->type() == type) return found;
    fail(key, told_type(type));
    return nullptr;
}

bool JsonReading::text(const std::string& key, std::string& to) {
    const Json* found = member(key, Json::value_t::string);
    if (!found) return false;
    to = found->get<std::string>();
    if (to.find('\0') != std::string::npos) fail(key, "has a zero byte");
    return true;
}

bool JsonReading::texts(const std::string& key, std::vector<std::string>& to) {
    const Json* found = list(key);
    if (!found) return false;
    to.clear();
    for (const Json& one : *found) {
        if (!one.is_string()) {
            fail(key, "must be a list of strings");
            return false;
        }
        to.push_back(one.get<std::string>());
    }
    return true;
}

bool JsonReading::number(const std::string& key, double& to, double least, double most) {
    const Json* found = any(key);
    if (!found) return false;
    if (!found->is_number() || !(found->get<double>() >= least && found->get<double>() <= most)) {
        char range[80];
        std::snprintf(range, sizeof range, "must be a number from %g to %g", least, most);
        fail(key, range);
        return false;
    }
    to = found->get<double>();
    return true;
}

bool JsonReading::flag(const std::string& key, bool& to) {
    const Json* found = member(key, Json::value_t::boolean);
    if (found) to = found->get<bool>();
    return found != nullptr;
}

void JsonReading::object(const std::string& key, const std::function<void(JsonReading&)>& read) {
    const Json* found = member(key, Json::value_t::object);
    if (!found) return;
    JsonReading inner(fault, where + key + ".", *found);
    read(inner);
    inner.finish();
}

void JsonReading::finish() {
    if (!value.is_object()) return;
    for (const auto& [key, ignored] : value.items()) {
        // "//" is for those who want to say something.
        if (key == "//" || std::find(known.begin(), known.end(), key) != known.end()) continue;
        fail(key, "is no key that is known here." + did_you_mean(key, known));
        while (fault.ends_with('.') || fault.ends_with('?')) fault.pop_back();
    }
}

}  // namespace flaneur
