// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/page/page.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/traced_example/traced_example.hpp"
#include "tracing/model/findings/finding.hpp"

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
