// A JSON object read key by key; the first fault is kept, with where it stands.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

namespace flaneur {

struct JsonReading {
    std::string& fault;  // "" while there is none
    std::string where;   // goes before the key in a fault: "case street: "
    const nlohmann::json& value;
    std::vector<std::string> known;  // keys that were asked for

    JsonReading(std::string& first_fault, std::string at, const nlohmann::json& object);

    // "where KEY why"
    void fail(const std::string& key, const std::string& why);

    // Each is null, or false, where the key is not there or holds something else, which is a fault.
    const nlohmann::json* any(const std::string& key);
    const nlohmann::json* member(const std::string& key, nlohmann::json::value_t type);
    const nlohmann::json* list(const std::string& key) { return member(key, nlohmann::json::value_t::array); }
    bool text(const std::string& key, std::string& to);
    bool texts(const std::string& key, std::vector<std::string>& to);
    bool number(const std::string& key, double& to, double least, double most);
    bool flag(const std::string& key, bool& to);
    // Reads what is in it, and refuses what is not known there.
    void object(const std::string& key, const std::function<void(JsonReading&)>& read);

    // Refuses keys that nobody asked for.
    void finish();
};

}  // namespace flaneur
