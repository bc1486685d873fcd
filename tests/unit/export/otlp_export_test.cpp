// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/traced_example/traced_example.hpp"
#include "tracing/show/export/export.hpp"

namespace tracing {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;

json otlp_of(const TracedSystem& system) {
  const testing::TemporaryDirectory directory;
  export_otlp(system, directory.path() / "chains.json");
  std::ifstream file(directory.path() / "chains.json");
  return json::parse(file);
}

std::string attribute(const json& of, const std::string& key) {
  for (const json& one : of["attributes"]) {
    if (one["key"] == key) {
      return one["value"].begin()->is_string() ? one["value"].begin()->get<std::string>()
                                               : one["value"].begin()->dump();
    }
  }
  return "";
}

// "PROCESS: NAME", each below the one that it comes from.
std::vector<std::string> tree_of(const json& request, const std::string& trace) {
  std::map<std::string, std::pair<std::string, json>> below;  // by parent
  for (const json& resource : request["resourceSpans"]) {
    for (const json& span : resource["scopeSpans"][0]["spans"]) {
      if (span["traceId"] == trace) {
        below[span.value("parentSpanId", "")] = {attribute(resource["resource"], "service.name"), span};
      }
    }
  }
  std::vector<std::string> lines;
  for (auto next = below.find(""); next != below.end();) {
    const auto& [process, span] = next->second;
    lines.push_back(process + ": " + span["name"].get<std::string>());
    next = below.find(span["spanId"].get<std::string>());
  }
  return lines;
}

std::vector<json> roots_of(const json& request) {
  std::vector<json> roots;
  for (const json& resource : request["resourceSpans"]) {
    for (const json& span : resource["scopeSpans"][0]["spans"]) {
      if (!span.contains("parentSpanId")) {
        roots.push_back(span);
      }
    }
  }
  return roots;
}

TEST(OtlpExport, APassageOfAChainIsATrace) {
  const TracedSystem system = testing::traced_example(3);
  const json request = otlp_of(system);
  const std::vector<json> roots = roots_of(request);
  ASSERT_EQ(roots.size(), system.timeline.details.passages.size());
  ASSERT_FALSE(roots.empty());
  const timeline::ChainPassage& passage = system.timeline.details.passages.front();
  EXPECT_EQ(roots[0]["startTimeUnixNano"], std::to_string(passage.input_ns));
  EXPECT_EQ(roots[0]["endTimeUnixNano"], std::to_string(passage.output_ns));
  EXPECT_THAT(tree_of(request, roots[0]["traceId"]),
              ElementsAre("sensor: /sensor to /display", "sensor: timer 10 ms", "sensor: send /scan",
                          "filter: process /scan", "filter: send /points", "display: process /points"));
}

TEST(OtlpExport, IdsAreOfTheirLengthAndTheSameEachTime) {
  const json request = otlp_of(testing::traced_example(3));
  EXPECT_EQ(otlp_of(testing::traced_example(3)), request);
  std::set<std::pair<std::string, std::string>> ids;
  for (const json& resource : request["resourceSpans"]) {
    for (const json& span : resource["scopeSpans"][0]["spans"]) {
      EXPECT_EQ(span["traceId"].get<std::string>().size(), 32u);
      EXPECT_EQ(span["spanId"].get<std::string>().size(), 16u);
      EXPECT_TRUE(ids.emplace(span["traceId"], span["spanId"]).second) << "two spans have one id";
    }
  }
}

TEST(OtlpExport, SpansTellWhatTheyAre) {
  const json request = otlp_of(testing::traced_example(1));
  for (const json& resource : request["resourceSpans"]) {
    for (const json& span : resource["scopeSpans"][0]["spans"]) {
      if (span["name"] == "process /scan") {
        EXPECT_EQ(span["kind"], 5) << "a consumer";
        EXPECT_EQ(attribute(span, "messaging.system"), "ros2");
        EXPECT_EQ(attribute(span, "messaging.destination.name"), "/scan");
        EXPECT_EQ(attribute(span, "ros2.node"), "/filter");
      } else if (span["name"] == "send /scan") {
        EXPECT_EQ(span["kind"], 4) << "a producer";
      } else if (span["name"] == "timer 10 ms") {
        EXPECT_EQ(attribute(span, "code.function.name"), "Sensor::on_timer()");
        EXPECT_EQ(attribute(resource["resource"], "process.pid"), "101");
      }
    }
  }
}

}  // namespace
}  // namespace tracing
