// Traces as text; tests/program/trace.py looks at whole ones.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "tools/flaneur/output/trace.h"

namespace flaneur {
namespace {

TEST(Trace, HasARowForEachThreadAndOneForTheDevice) {
    TraceThread worker{"worker 1", {}, 3}, main{"main", {}, 0};
    main.events = {{"tick", 2'000'000'001, 2'000'500'002, 0, TraceKind::zone},
                   {"light", 2'000'600'000, 2'000'700'000, 0, TraceKind::device_zone},
                   // By a later look at both clocks it began before the one before it had ended.
                   {"copy", 2'000'699'000, 2'000'699'500, 0, TraceKind::device_zone},
                   {"draws", 2'000'000'000, 0, 12, TraceKind::counter}};
    worker.events = {{"wait for \"work\"", 2'000'000'000, 2'000'000'000, 0, TraceKind::zone}};
    const std::vector<TraceThread> threads = {worker, main};
    const nlohmann::json json = nlohmann::json::parse(trace_json(threads));
    EXPECT_EQ(json["otherData"]["lost"], 3);
    std::map<int, std::string> rows;
    std::map<std::string, nlohmann::json> events;
    for (const nlohmann::json& event : json["traceEvents"]) {
        if (event["ph"] == "M" && event["name"] == "thread_name")
            rows[event["tid"].get<int>()] = event["args"]["name"].get<std::string>();
        if (event["ph"] != "M") events[event["name"].get<std::string>()] = event;
    }
    auto row_of = [&](const char* name) { return rows[events[name]["tid"].get<int>()]; };
    EXPECT_EQ(row_of("tick"), "main");
    EXPECT_EQ(row_of("wait for \"work\""), "worker 1");
    EXPECT_EQ(row_of("light"), "device");
    EXPECT_NEAR(events["tick"]["ts"], 0.001, 1e-9);
    EXPECT_NEAR(events["tick"]["dur"], 500.001, 1e-9);
    EXPECT_EQ(events["draws"]["args"]["value"], 12);
    EXPECT_NEAR(events["copy"]["ts"], 700, 1e-9);
    EXPECT_NEAR(events["copy"]["dur"], 0, 1e-9);
}

TEST(Trace, OfNothingIsATraceAllTheSame) {
    EXPECT_TRUE(nlohmann::json::parse(trace_json({}))["traceEvents"].empty());
}

}  // namespace
}  // namespace flaneur
