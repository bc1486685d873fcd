// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/launch_file.hpp"

#include <gtest/gtest.h>

#include "tests/unit/twin/small_system.hpp"

namespace tracing::twin {
namespace {

using testing::SmallSystem;

TEST(LaunchFile, StartsAStandInForEachProcess) {
  SmallSystem small;
  small.add_process("/two");
  small.system.processes[0].name = "a--b<c>";
  small.system.executors[1].priority = 50;
  small.system.duration_ns = 12'340'000'000;
  const std::string text = launch_file_of(small.system, {.ext_events = true, .cpus = 2});
  EXPECT_NE(text.find("<arg name=\"duration\" default=\"12.3\""), std::string::npos) << text;
  EXPECT_NE(text.find("events-ust=\"ros2:* ros2_ext:*\""), std::string::npos);
  EXPECT_NE(text.find("<!-- a- -b&lt;c&gt;: /one -->"), std::string::npos);
  EXPECT_NE(text.find("args=\"$(dirname)/twin.json 0\" cpus=\"0-1\"/>"), std::string::npos);
  EXPECT_NE(text.find("args=\"$(dirname)/twin.json 1\" cpus=\"0-1\" sched_policy=\"fifo\" sched_priority=\"50\"/>"),
            std::string::npos);
}

}  // namespace
}  // namespace tracing::twin
