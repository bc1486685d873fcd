// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/traced_example/traced_example.hpp"
#include "tracing/show/export/export.hpp"
#include "tracing/show/export/output_file.hpp"
#include "tracing/show/tables/tables.hpp"

namespace tracing {
namespace {

namespace fs = std::filesystem;
using testing::TemporaryDirectory;

std::vector<std::string> lines_of(const fs::path& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    lines.push_back(line);
  }
  return lines;
}

TEST(CsvExport, WritesAFileForEachTable) {
  const TemporaryDirectory directory;
  const fs::path tables = directory.path() / "a/b";
  export_csv(testing::traced_example(1), tables);
  std::set<std::string> files;
  for (const auto& entry : fs::directory_iterator(tables)) {
    files.insert(entry.path().filename());
  }
  std::set<std::string> tables_of_system;
  for (const Table& table : tables_of({})) {
    tables_of_system.insert(table.name + ".csv");
  }
  EXPECT_EQ(files, tables_of_system);
  EXPECT_THAT(lines_of(tables / "schema_version.csv"), ::testing::ElementsAre("version", "1"));
  EXPECT_THAT(lines_of(tables / "callback_instances.csv"),
              ::testing::ElementsAre("id,callback,thread,start_ns,duration_ns,intra_process,message",
                                     "0,0,0,1767225600020000000,200000,0,", "1,1,1,1767225600020300000,400000,0,0",
                                     "2,2,2,1767225600020800000,50000,0,1"));
  EXPECT_EQ(lines_of(tables / "messages.csv")[1],
            "0,0,0,0,0,1767225600020095000,1767225600020100000,0,1767225600020250000,1,1767225600020300000,0,"
            "1767225600020095000,1767225600020097000,,0,0,,");
  EXPECT_EQ(lines_of(tables / "callbacks.csv")[2],
            "1,2,1,subscription,0,,,265,Filter::on_scan(sensor_msgs::msg::LaserScan const&),0,");
  EXPECT_THAT(
      lines_of(tables / "starts.csv"),
      ::testing::Contains("0,101,sensor-1,/examples/"
                          "system.launch.xml,3,1767225599970000000,30010000,40000000,,30000000,50000000,50100000"));
}

TEST(CsvExport, HasTheStatesOfThreads) {
  const TemporaryDirectory directory;
  export_csv(testing::traced_example(20, testing::ExampleEvents::kRosAndScheduler), directory.path());
  const std::vector<std::string> lines = lines_of(directory.path() / "thread_states.csv");
  EXPECT_EQ(lines[0], "id,thread,state,begin_ns,end_ns,cpu,other_tid,other_name");
  // The last callback is one of 4 ms, which another program interrupts.
  EXPECT_THAT(lines, ::testing::Contains(
                         ::testing::EndsWith(",1,runnable,1767225600211600000,1767225600215100000,1,90,stress")));
  EXPECT_THAT(lines, ::testing::Contains(::testing::HasSubstr(",1,blocked,")));
}

TEST(CsvExport, QuotesWhatWouldBreakALine) {
  TracedSystem system;
  system.timeline.topics = {"/plain", "a,b", "say \"x\"", "two\nlines"};
  const TemporaryDirectory directory;
  export_csv(system, directory.path());
  std::ifstream file(directory.path() / "topics.csv");
  const std::string text(std::istreambuf_iterator<char>(file), {});
  EXPECT_EQ(text, "id,name\n0,/plain\n1,\"a,b\"\n2,\"say \"\"x\"\"\"\n3,\"two\nlines\"\n");
}

TEST(CsvExport, NeedsADirectory) {
  const TemporaryDirectory directory;
  std::ofstream(directory.path() / "file") << "x";
  try {
    export_csv({}, directory.path() / "file");
    FAIL();
  } catch (const OutputError& error) {
    EXPECT_EQ(error.what(), "cannot write " + (directory.path() / "file").string() + ": Not a directory");
  }
}

}  // namespace
}  // namespace tracing
