// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/unit/report/example_reports.hpp"
#include "tracing/show/report/report.hpp"

namespace tracing {
namespace {

// The entry with the keys of `like` only.
nlohmann::json part(const nlohmann::json& entry, const nlohmann::json& like) {
  nlohmann::json kept;
  for (const auto& [key, value] : like.items()) {
    if (!entry.contains(key)) {
      continue;
    }
    kept[key] = value.is_object() ? part(entry[key], value) : entry[key];
  }
  return kept;
}

#define EXPECT_HOLDS(entry, text)                          \
  do {                                                     \
    const auto expected = nlohmann::json::parse(text);     \
    EXPECT_EQ(part(entry, expected), expected) << (entry); \
  } while (false)

TEST(JsonReport, HoldsEverything) {
  Report report = report_with_results();
  report.error = "damaged";
  report.results.overview.losses = {loss_of(37, 3, true)};
  const auto json = nlohmann::json::parse(json_report(report));
  EXPECT_EQ(json["version"], 1);
  EXPECT_EQ(json["directory"], "/traces/run");
  EXPECT_EQ(json["error"], "damaged");
  EXPECT_EQ(json["begin_ns"], kBegin);
  EXPECT_EQ(json["events"], 10);
  EXPECT_EQ(json["processes"],
            nlohmann::json::parse(
                R"json([{"vpid":71,"name":"ping","host":"","events":10,"folded":0,"doubtful":false}])json"));
  EXPECT_EQ(json["losses"], nlohmann::json::parse(R"json([{"stream":"/traces/run/ust/uid/0/64-bit/ros2_0","events":37,
      "packets":3,"uncounted":true,"begin_ns":1767225600500000000,"end_ns":1767225601500000000,
      "processes":[0]}])json"));
  EXPECT_HOLDS(json["callbacks"][0],
               R"json({"vpid":71,"process":0,"node":"","owner":"unknown","address":203,"symbol":"",
      "duration":{"count":0},"intra_process":0,"unfinished":1})json");
  EXPECT_HOLDS(json["callbacks"][1], R"json({"vpid":71,"process":0,"node":"/ns/node","owner":"subscription",
      "topic":"/camera/front/image_raw/compressed","address":203,"symbol":"Node::on_image(Image const&)",
      "duration":{"count":70000,"mean_ns":1500.0,"stddev_ns":250.0,"min_ns":1000,"p50_ns":1400,"p90_ns":2000,
      "p99_ns":3000,"max_ns":99000000,"percentiles_are_exact":false},"intra_process":5,"unfinished":0})json");
  EXPECT_HOLDS(json["starts"][0], R"json({"vpid":71,"process":"ping-1","file":"a.launch.xml","line":3,
      "exec_ns":1767225600000000000,"node_after_ns":12000000,"ready_after_ns":20000000,"spawn_ns":null})json");
  EXPECT_EQ(json["starts"][1]["ready_after_ns"], nullptr);
  EXPECT_EQ(json["callbacks"][2]["owner"], "client");
  EXPECT_EQ(json["callbacks"][2]["service"], "/add");
  EXPECT_HOLDS(json["calls"][0], R"json({"service":"/add","client_vpid":71,"client_process":0,"client":"/ns/node",
      "server_vpid":null,"server_process":null,"server":"","requests":2,"responses":1,"round_trip":{"count":1,"mean_ns":3000.0,
      "stddev_ns":0.0,"min_ns":3000,"p50_ns":3000,"p90_ns":3000,"p99_ns":3000,"max_ns":3000,
      "percentiles_are_exact":true},"request":{"count":0},"in_service":{"count":0},"response":{"count":0}})json");
  EXPECT_HOLDS(json["executions"][0], R"json({"vpid":71,"process":0,"node":"/ns/node","kind":"client",
      "service":"/add","count":2,"duration":{"count":1,"mean_ns":2000.0,"stddev_ns":0.0,"min_ns":2000,"p50_ns":2000,
      "p90_ns":2000,"p99_ns":2000,"max_ns":2000,"percentiles_are_exact":true}})json");
  EXPECT_EQ(
      json["executions"][1],
      nlohmann::json::parse(
          R"json({"vpid":71,"process":0,"node":"","kind":"waitable","address":2748,"count":7,"duration":{"count":0}})json"));
  EXPECT_EQ(json["topics"][0]["published_only"], 10);
  EXPECT_EQ(json["topics"][0]["latency"]["p50_ns"], 140'000);
  EXPECT_EQ(json["topics"][1]["latency"], nlohmann::json::parse(R"json({"count":0})json"));
  EXPECT_HOLDS(json["callbacks"][1], R"json({"short_symbol":"Node::on_image","rate_hz":0.0,"interval":{"count":0},
      "allocations":null,"allocated_bytes":0,"held_up_by":"","held_up":0,"held_up_ns":0,"doubtful":false})json");
  EXPECT_EQ(json["unknown_messages"], 4);
  EXPECT_EQ(json["warnings"][0], "ros2:rmw_publish has no field timestamp");
}

TEST(JsonReport, HoldsWaysChainsExecutorsAndStates) {
  const auto json = nlohmann::json::parse(json_report(busy_report()));
  EXPECT_HOLDS(json["callbacks"][0], R"json({"owner":"timer","rate_hz":9.5,"missed":1,"jitter":{"count":19,
      "p50_ns":10000000,"p999_ns":0,"max_ns":120000000},"interval":{"count":0}})json");
  EXPECT_HOLDS(json["subscriptions"][0], R"json({"vpid":72,"process":1,"node":"/often","topic":"/scan",
      "queue_depth":0,"received":2002,"intra_process":0,"delivered":2000,"not_executed":2,"overwritten":30,
      "overwritten_in_buffer":0,"lost":8,"lost_by_publisher":8,"lost_in_transport":0,"before_first":0,"after_last":0,"latency":{"p99_ns":3000000},
      "rclcpp":{"count":0},"rcl":{"count":0},"transport":{"count":0},"executor":{"p99_ns":2000000},
      "take":{"count":0},"doubtful":false})json");
  EXPECT_HOLDS(json["executors"][0], R"json({"vpid":71,"process":0,"vtid":71,"span_ns":2000000000,"callbacks":20,
      "callback_ns":0,"waited_ns":null,"utilisation":0.95,"longest_busy_ns":80000000,"longest_busy_begin_ns":0,
      "longest_callback":"/slow, timer 100 ms","doubtful":false})json");
  EXPECT_HOLDS(json["chains"][0], R"json({"response":{"count":20},"reaction":{"max_ns":255000000},
      "age":{"count":20},"is_loop":false,"doubtful":false})json");
  EXPECT_HOLDS(json["chains"][0]["steps"][1], R"json({"vpid":71,"process":0,"node":"/often",
      "callback":"subscription /scan","topic":"/scan","until_publish":{"count":20},"transfer":{"count":20}})json");
  EXPECT_FALSE(json["chains"][0]["steps"][0].contains("topic"));
  EXPECT_HOLDS(json["lifecycle"][1], R"json({"vpid":72,"process":1,"node":"/rare","state":"active",
      "begin_ns":1767225600100000000,"end_ns":1767225602000000000,"ended":false,"allocations":null})json");
  EXPECT_EQ(json["has_all_chains"], true);
  EXPECT_HOLDS(json["findings"][0], R"json({"kind":"busiest_executor","subject":"/slow [71]",
      "figures":"95 % busy, once for 80.0 ms in /slow, timer 100 ms",
      "next":"give some of its nodes an executor of their own, or it several threads"})json");
}

TEST(JsonReport, SurvivesNamesThatAreNoUtf8) {
  Report report{"/traces/run", {}, ""};
  report.results.overview = overview_of(1, {{71, "\xff\xfe", 1, false}});
  EXPECT_EQ(nlohmann::json::parse(json_report(report))["processes"][0]["events"], 1);
}

}  // namespace
}  // namespace tracing
