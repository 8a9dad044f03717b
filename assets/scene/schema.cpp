// The JSON schema of scene files, from the tables that read them.
#include <cmath>
#include <nlohmann/json.hpp>

#include "assets/scene/reading.h"

namespace flaneur {

using OrderedJson = nlohmann::ordered_json;

OrderedJson schema_bound(double value) {
    if (value >= 0x1p64) return ~uint64_t{0};
    return value == std::floor(value) ? OrderedJson(static_cast<int64_t>(value)) : OrderedJson(value);
}

namespace {

template <class Of>
OrderedJson object_schema(const std::vector<SceneKey<Of>>& keys);

// Views that go one at a time, as pairs that a list has not both.
OrderedJson rivals_schema() {
    auto pairs = OrderedJson::array();
    for (int a = 0; a < k_work_views; ++a) {
        for (int b = a + 1; b < k_work_views; ++b) {
            if (!(rivals_of(static_cast<WorkView>(a)) >> b & 1)) continue;
            OrderedJson both = {{{"contains", {{"const", k_work_view_names[a]}}}},
                                {{"contains", {{"const", k_work_view_names[b]}}}}};
            pairs.push_back({{"not", {{"allOf", both}}}});
        }
    }
    return pairs;
}

template <class Of>
OrderedJson key_schema(const SceneKey<Of>& key) {
    OrderedJson one;
    OrderedJson text = {{"type", "string"}};
    if (!key.rule.pattern.empty()) {
        text["pattern"] = "^(" + key.rule.pattern + ")$";
    } else if (!key.rule.words.empty()) {
        text["enum"] = key.rule.words;
    } else {
        text["pattern"] = "^[^\\u0000]+$";
    }
    switch (key.rule.kind) {
        case KeyKind::flag:
            one["type"] = "boolean";
            break;
        case KeyKind::whole:
        case KeyKind::number:
            one["type"] = key.rule.kind == KeyKind::whole ? "integer" : "number";
            one["minimum"] = schema_bound(key.rule.low);
            one["maximum"] = schema_bound(key.rule.high);
            break;
        case KeyKind::text:
            one = text;
            break;
        case KeyKind::texts:
            one = {{"type", "array"}, {"items", text}};
            if (!key.rule.words.empty()) one["allOf"] = rivals_schema();
            break;
        case KeyKind::people:
            one = {{"type", "array"}, {"items", object_schema(people_keys())}};
            one["items"]["oneOf"] = OrderedJson::parse(
                R"([{"required": ["character"], "properties": {"builtin": {"const": false}}},
                    {"required": ["builtin"], "properties": {"builtin": {"const": true}, "character": false}}])");
            break;
        case KeyKind::added:
            one = {{"type", "array"}, {"items", object_schema(added_keys())}};
            one["items"]["oneOf"] = OrderedJson::parse(
                R"([{"required": ["what", "at", "to"], "properties": {"what": {"enum": ["wall", "barrier"]}, "turn": false}},
                {"required": ["what", "at"], "properties": {"what": {"const": "entrance"}, "to": false, "turn": false}},
                {"required": ["what", "at"], "properties": {"what": {"enum": ["planter", "car", "tree", "bench", "lamp"]},
                                                            "to": false}}])");
            break;
        case KeyKind::groups:
            one = object_schema(group_keys());
            break;
        case KeyKind::recorded: {
            OrderedJson object = object_schema(recorded_keys());
            object["required"] = {"file"};
            one["oneOf"] = OrderedJson::array({text, object});
            break;
        }
    }
    one["description"] = key.meaning;
    if (key.usual) one["default"] = OrderedJson::parse(key.usual);
    one["examples"] = OrderedJson::array({OrderedJson::parse(key.example)});
    return one;
}

template <class Of>
OrderedJson object_schema(const std::vector<SceneKey<Of>>& keys) {
    OrderedJson schema = {{"type", "object"}, {"additionalProperties", false}};
    for (const SceneKey<Of>& key : keys) schema["properties"][key.name] = key_schema(key);
    return schema;
}

}  // namespace

std::string scene_schema() {
    OrderedJson schema = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                          {"title", "A scene of flaneur"},
                          {"description", "What to simulate and from where to look."}};
    schema.update(object_schema(scene_keys()));
    for (const SceneClash& clash : scene_clashes())
        schema["allOf"].push_back({{"not", clash.schema(clash.key)}});
    return schema.dump(4) + "\n";
}

}  // namespace flaneur
