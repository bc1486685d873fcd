// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/export/analysis_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "tests/support/trace_writer/example_system.hpp"
#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/trace_writer/trace_writer.hpp"
#include "tracing/decode/reader/trace_reader.hpp"

namespace tracing {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using testing::TemporaryDirectory;
using testing::Thread;
using testing::TraceWriter;

class AnalysisModel : public ::testing::Test {
 protected:
  std::vector<std::string> lines_of(const std::string& table) {
    std::ifstream file(directory_.path() / "model" / (table + ".csv"));
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) {
      lines.push_back(line);
    }
    return lines;
  }
  void export_model(std::function<AnalysisModelWriter::Window(std::int64_t)> window = nullptr) {
    AnalysisModelWriter writer(directory_.path() / "model", std::move(window));
    TraceReader(directory_.path() / "trace").read(writer);
    writer.finish();
  }
  TemporaryDirectory directory_;
};

TEST_F(AnalysisModel, HasTheTablesOfTracetoolsAnalysis) {
  testing::write_example_system(directory_.path() / "trace", 2);
  export_model();
  std::set<std::string> files;
  for (const auto& entry : fs::directory_iterator(directory_.path() / "model")) {
    files.insert(entry.path().stem());
  }
  EXPECT_THAT(files,
              ElementsAre("callback_instances", "callback_objects", "callback_symbols", "clients", "contexts",
                          "lifecycle_state_machines", "lifecycle_transitions", "nodes", "rcl_publish_instances",
                          "rcl_publishers", "rcl_subscriptions", "rcl_take_instances", "rclcpp_publish_instances",
                          "rclcpp_take_instances", "rmw_publish_instances", "rmw_publishers", "rmw_subscriptions",
                          "rmw_take_instances", "services", "subscription_objects", "timer_node_links", "timers"));
  EXPECT_EQ(lines_of("contexts").at(1), "256,1767225600000000000,101,8.10.1");
  EXPECT_EQ(lines_of("nodes").at(1), "257,1767225600000010000,101,258,sensor,/,101");
  EXPECT_EQ(lines_of("rcl_publishers").at(1), "259,1767225600000110000,257,260,/scan,10,101");
  EXPECT_EQ(lines_of("rmw_publishers").at(1),
            "260,1767225600000100000,\"[0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]\",101");
  EXPECT_EQ(lines_of("timers").at(1), "264,1767225600000200000,10000000,101,101");
  EXPECT_EQ(lines_of("callback_objects").at(2), "263,1767225600001230000,265,102") << "refers to rclcpp's object";
  EXPECT_EQ(lines_of("callback_symbols").at(1), "265,1767225600000220000,Sensor::on_timer(),101");
  EXPECT_THAT(lines_of("callback_instances"),
              ElementsAre("callback_object,timestamp,duration,intra_process,vpid",
                          "265,1767225600020000000,200000,False,101", "265,1767225600020300000,400000,False,102",
                          "265,1767225600020800000,50000,False,103", "265,1767225600030000000,200000,False,101",
                          "265,1767225600030300000,400000,False,102", "265,1767225600030800000,50000,False,103"));
  EXPECT_EQ(lines_of("rmw_take_instances").at(1), "262,1767225600020250000,267,1767225600020100000,True,102");
  EXPECT_EQ(lines_of("lifecycle_transitions").at(1), "266,unconfigured,configuring,1767225600005000000,103");
}

TEST_F(AnalysisModel, OfAPartHasAllObjects) {
  testing::write_example_system(directory_.path() / "trace", 2);
  export_model([](std::int64_t first_ns) {
    return AnalysisModelWriter::Window{first_ns + 30'000'000, first_ns + 30'300'000};
  });
  EXPECT_EQ(lines_of("nodes").size(), 4u);
  EXPECT_THAT(lines_of("callback_instances"), ElementsAre("callback_object,timestamp,duration,intra_process,vpid",
                                                          "265,1767225600030000000,200000,False,101"));
}

TEST_F(AnalysisModel, QuotesListsAndTexts) {
  constexpr Thread kThread{71, 72, "node"};
  TraceWriter writer(directory_.path() / "trace");
  ros2::Gid gid;
  gid.size = 16;
  gid.bytes[1] = 15;
  writer.write(0, 1'000, kThread, ros2::RmwPublisherInit{1, gid});
  writer.write(0, 1'100, kThread, ros2::RclcppCallbackRegister{2, "f(int, \"x\")"});
  writer.finish();
  export_model();
  EXPECT_EQ(lines_of("rmw_publishers").at(1), "1,1000,\"[0, 15, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]\",71");
  EXPECT_EQ(lines_of("callback_symbols").at(1), "2,1100,\"f(int, \"\"x\"\")\",71");
}

TEST_F(AnalysisModel, LeavesNoFilesWhenTheTraceCannotBeRead) {
  fs::create_directories(directory_.path() / "trace");
  EXPECT_THROW(export_model(), TraceReadError);
  EXPECT_TRUE(fs::is_empty(directory_.path() / "model"));
}

}  // namespace
}  // namespace tracing
