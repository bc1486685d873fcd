// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/page/page.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/traced_example/traced_example.hpp"
#include "tracing/model/findings/finding.hpp"
#include "tracing/show/page/comparison_page.hpp"

namespace tracing {
namespace {

// The content of the element with this id.
std::string content(const std::string& page, const std::string& id) {
  const std::size_t begin = page.find('>', page.find("id=\"" + id + "\"")) + 1;
  return page.substr(begin, page.find("</script>", begin) - begin);
}

TEST(Page, HoldsTheFacts) {
  const std::string page = html_page(testing::traced_example(100));
  const nlohmann::json facts = nlohmann::json::parse(content(page, "facts"));
  EXPECT_EQ(facts["version"], 1);
  EXPECT_EQ(facts["directory"], "/traces/example");
  EXPECT_EQ(facts["begin_ms"], 1'767'225'600'000);
  EXPECT_EQ(facts["instances"], 298);
  EXPECT_EQ(facts["messages"], 200);
  EXPECT_EQ(facts["nodes"][0], nlohmann::json::parse(R"json({"process":1,"name":"/sensor"})json"));
  EXPECT_EQ(
      facts["processes"][1],
      nlohmann::json::parse(R"json({"vpid":101,"name":"sensor","host":"box","events":809,"doubtful":false})json"));
  EXPECT_EQ(facts["topics"], nlohmann::json::parse(R"json(["/scan","/points"])json"));
  EXPECT_EQ(facts["callbacks"][0], nlohmann::json::parse(R"json({"process":1,"node":0,"kind":"timer","topic":null,
      "service":"","period":10000000,"symbol":"Sensor::on_timer()"
})json"));
  EXPECT_EQ(facts["lifecycle"][1], nlohmann::json::parse(R"json({"node":2,"state":"configuring","begin":5000000,
      "end":8000000})json"));
  EXPECT_EQ(facts["starts"][0]["file"], "/examples/system.launch.xml");
  EXPECT_EQ(facts["starts"][0]["process"], 1) << "index in processes";
  EXPECT_EQ(facts["is_open"], false);
  EXPECT_EQ(facts["overview"]["lost_events"], 0);
}

TEST(Page, HasTheFindingsAndChainsOfTheReport) {
  const TracedSystem system = testing::traced_example(100);
  const nlohmann::json facts = nlohmann::json::parse(content(html_page(system), "facts"));
  const std::vector<Finding> findings = find_worth_a_look(system.results);
  ASSERT_EQ(facts["findings"].size(), findings.size());
  for (std::size_t i = 0; i < findings.size(); ++i) {
    EXPECT_EQ(facts["findings"][i]["subject"], findings[i].subject);
    EXPECT_EQ(facts["findings"][i]["figures"], findings[i].figures);
  }
  ASSERT_EQ(facts["chains"].size(), system.results.ros2.chains.size());
  const nlohmann::json& chain = facts["chains"][0];
  ASSERT_EQ(chain["steps"].size(), 3u);
  EXPECT_EQ(facts["callbacks"][chain["steps"][2]["callback"].get<int>()]["symbol"],
            "Display::on_points(sensor_msgs::msg::PointCloud2 const&)");
  EXPECT_EQ(facts["topics"][chain["steps"][1]["topic"].get<int>()], "/scan");
  EXPECT_EQ(chain["response"]["max"], system.results.ros2.chains[0].response.max_ns);
}

TEST(Page, HasThePercentilesOfEachPartOfAChain) {
  const TracedSystem system = testing::traced_example(100);
  const nlohmann::json facts = nlohmann::json::parse(content(html_page(system), "facts"));
  const ChainResult::Step& step = system.results.ros2.chains[0].steps[1];
  const nlohmann::json& shown = facts["chains"][0]["steps"][1];
  for (const auto& [key, times] : {std::pair{"until_publish", step.until_publish},
                                   {"transport", step.transport},
                                   {"executor", step.executor},
                                   {"take", step.take}}) {
    EXPECT_EQ(shown[key]["p50"], times.p50_ns) << key;
    EXPECT_EQ(shown[key]["p90"], times.p90_ns) << key;
    EXPECT_EQ(shown[key]["p99"], times.p99_ns) << key;
    EXPECT_EQ(shown[key]["max"], times.max_ns) << key;
  }
  // Of the first message it is not known how long it waited for the executor.
  const auto sum_of = [](const DurationSummary& times) { return times.mean_ns * static_cast<double>(times.count); };
  EXPECT_EQ(step.executor.count, step.transport.count - 1);
  EXPECT_NEAR(sum_of(step.transport) + sum_of(step.executor) + sum_of(step.take), sum_of(step.transfer), 1);
}

TEST(Page, CountsProcessesOfTheKernelAloneByTheirNames) {
  TracedSystem system;
  ProcessResult sensor{.vpid = 101, .name = "sensor", .events = 5};
  ProcessResult others{.name = "kworker", .events = 900};
  others.folded = 300;
  system.results.overview.processes = {sensor, others};
  system.timeline.processes = {{.vpid = 101, .name = "sensor", .place = 0}};
  for (std::int64_t pid = 1; pid <= 300; ++pid) {
    system.timeline.processes.push_back({.vpid = pid, .name = "kworker", .place = 1});
  }
  const std::string text = content(html_page(system), "facts");
  const nlohmann::json facts = nlohmann::json::parse(text);
  ASSERT_EQ(facts["processes"].size(), 301u);
  EXPECT_EQ(facts["processes"][0]["name"], "sensor");
  EXPECT_EQ(facts["processes"][300], 0);
  EXPECT_EQ(facts["folded"],
            nlohmann::json::parse(R"json([{"name":"kworker","host":"","count":300,"events":900}])json"));
  EXPECT_LT(text.size(), 3'000u) << "not a row for each of them";
}

TEST(Page, OfTwoRunsHasTheDataOfBothAndTheComparison) {
  const TracedSystem system = testing::traced_example(10);
  PageRun before{page_facts(system),
                 page_columns(system.timeline),
                 {{"/a, timer 1 s"}, {"/a (timer 1 s)"}, {"</script>"}, {"/a (timer 1 s) -> /b (/c)"}}};
  PageRun after{page_facts(testing::traced_example(20)), page_columns(testing::traced_example(20).timeline), {}};
  const std::string page = comparison_page({before, after}, R"json({"version":1,"changes":[]})json");
  EXPECT_EQ(nlohmann::json::parse(content(page, "facts-before"))["instances"], 30);
  EXPECT_EQ(nlohmann::json::parse(content(page, "facts"))["instances"], 60);
  EXPECT_EQ(content(page, "columns-before"), before.columns);
  EXPECT_EQ(content(page, "columns"), after.columns);
  const nlohmann::json comparison = nlohmann::json::parse(content(page, "comparison"));
  EXPECT_EQ(comparison["version"], 1);
  EXPECT_EQ(comparison["names"][0]["callbacks"][0], "/a, timer 1 s");
  EXPECT_EQ(comparison["names"][0]["subscriptions"][0], "</script>");
  EXPECT_EQ(comparison["names"][0]["chains"][0], "/a (timer 1 s) -> /b (/c)");
  EXPECT_EQ(comparison["names"][1]["steps"].size(), 0u);
}

TEST(Page, SaysThatTheTraceWasStillBeingWritten) {
  TracedSystem system;
  system.open = {"/traces/run"};
  EXPECT_EQ(nlohmann::json::parse(content(html_page(system), "facts"))["is_open"], true);
}

TEST(Page, NeedsNothingElse) {
  const std::string page = html_page({});
  for (const char* text : {"src=", "@import", "url(http", "stylesheet"}) {
    EXPECT_EQ(page.find(text), std::string::npos) << text;
  }
  EXPECT_NE(page.find("Copyright (c) 2022 Leon Sorokin"), std::string::npos) << "the licence of the library in it";
  EXPECT_LT(page.size(), 250'000u);
}

TEST(Page, TextsCannotEndAnElement) {
  TracedSystem system;
  system.directory = "/traces/</script><script>alert(1)</script><!--";
  const std::string page = html_page(system);
  EXPECT_EQ(nlohmann::json::parse(content(page, "facts"))["directory"], system.directory.string());
  EXPECT_EQ(page.find("alert(1)</script>"), std::string::npos);
}

}  // namespace
}  // namespace tracing
