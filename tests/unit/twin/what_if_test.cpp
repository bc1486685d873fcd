// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/what_if.hpp"

#include <gtest/gtest.h>

#include "base/diagnostics/diagnostic.hpp"
#include "tests/unit/twin/small_system.hpp"

namespace tracing::twin {
namespace {

using testing::kMs;
using testing::SmallSystem;

// /one and /camera have a timer each.
struct TwoNodes : SmallSystem {
  TwoNodes() {
    add_timer("/one, timer 10 ms", 10 * kMs, 2 * kMs);
    add_timer("/camera, timer 50 ms", 50 * kMs, 4 * kMs, add_process("/camera"));
  }
};

System changed(const std::string& text) {
  TwoNodes small;
  apply_what_if(text, small.system);
  return small.system;
}

std::string error(const std::string& text) {
  TwoNodes small;
  try {
    apply_what_if(text, small.system);
  } catch (const launch::LaunchError& error) {
    return launch::render(error.diagnostics());
  }
  return "";
}

TEST(WhatIf, ChangesTheExecutorOfANode) {
  EXPECT_EQ(changed("executor=/camera:multi:4").executors[1], (Executor{1, Executor::Kind::kMulti, 4, 0}));
  EXPECT_EQ(changed("executor=/camera:multi:4").executors[0], (Executor{0, Executor::Kind::kSingle, 1, 0}));
  EXPECT_EQ(changed("executor=/camera:events").executors[1], (Executor{1, Executor::Kind::kEvents, 1, 0}));
  EXPECT_EQ(changed("executor=/*:multi").executors[0], (Executor{0, Executor::Kind::kMulti, 2, 0}));
}

TEST(WhatIf, ChangesProcessorsAndPriorities) {
  EXPECT_EQ(changed("cpus=4").cpus, 4u);
  EXPECT_EQ(changed("priority=/one:50").executors[0].priority, 50);
  EXPECT_EQ(changed("priority=/one:50,priority=/one:other").executors[0].priority, 0);
}

TEST(WhatIf, ChangesRates) {
  EXPECT_EQ(changed("rate=/camera:40Hz").callbacks[1].period_ns, 25 * kMs);
  EXPECT_EQ(changed("rate=/camera:40").callbacks[1].period_ns, 25 * kMs);
  EXPECT_EQ(changed("rate(/camera)*2").callbacks[1].period_ns, 25 * kMs);
  EXPECT_EQ(changed("rate(/camera)*2").callbacks[0].period_ns, 10 * kMs);
}

TEST(WhatIf, ChangesDurations) {
  EXPECT_EQ(changed("duration(/camera)*0.5").callbacks[1].run_times.values, std::vector<std::int64_t>{2 * kMs});
  EXPECT_EQ(changed("duration=/camera:5ms").callbacks[1].run_times.values, std::vector<std::int64_t>{5 * kMs});
  EXPECT_EQ(changed("duration=/camera:5us").callbacks[1].run_times.values, std::vector<std::int64_t>{5'000});
}

TEST(WhatIf, ChangesGroups) {
  TwoNodes small;
  small.add_timer("/one, timer 20 ms", 20 * kMs, kMs);
  System system = small.system;
  apply_what_if("groups=/one:separate", system);
  EXPECT_NE(system.callbacks[0].group, system.callbacks[2].group);
  apply_what_if("groups=/one:reentrant", system);
  EXPECT_EQ(system.callbacks[0].group, system.callbacks[2].group);
  EXPECT_TRUE(system.groups[system.callbacks[0].group].reentrant);
  apply_what_if("groups=/one:one", system);
  EXPECT_FALSE(system.groups[system.callbacks[2].group].reentrant);
}

TEST(WhatIf, TakesSeveralChanges) {
  const System system = changed("cpus=4, duration(/camera)*0.5, executor=/one:multi:3");
  EXPECT_EQ(system.cpus, 4u);
  EXPECT_EQ(system.callbacks[1].run_times.values, std::vector<std::int64_t>{2 * kMs});
  EXPECT_EQ(system.executors[0].threads, 3u);
}

TEST(WhatIf, PointsAtAMistake) {
  EXPECT_EQ(error("executr=/one:multi:4"),
            "--what-if:1:1: error: 'executr' is no change\n"
            "    1 | executr=/one:multi:4\n"
            "      | ^~~~~~~\n"
            "      = help: did you mean 'executor'?\n");
  EXPECT_EQ(error("cpus=2,executor=/camra:multi:4"),
            "--what-if:1:17: error: the twin has no node '/camra'\n"
            "    1 | cpus=2,executor=/camra:multi:4\n"
            "      |                 ^~~~~~\n"
            "      = help: did you mean '/camera'?\n");
  EXPECT_EQ(error("executor=/one:mutli:4"),
            "--what-if:1:15: error: 'mutli' is no kind of executor\n"
            "    1 | executor=/one:mutli:4\n"
            "      |               ^~~~~\n"
            "      = help: did you mean 'multi'?\n");
}

TEST(WhatIf, SaysWhatIsWrong) {
  const std::pair<const char*, const char*> cases[] = {
      {"", "change is missing"},
      {"cpus", "expected '='"},
      {"cpus=", "number of processors is missing"},
      {"cpus=two", "'two' is no number of processors"},
      {"cpus=0", "'0' is no number of processors"},
      {"cpus=1.5", "'1.5' is no number of processors"},
      {"cpus=4 executor=/one:multi", "'4 executor=/one:multi' is no number of processors"},
      {"executor=/one", "expected ':'"},
      {"executor=/one:", "kind of executor is missing"},
      {"executor=/one:single:2", "has one thread"},
      {"executor=/one:multi:0", "'0' is no number of threads"},
      {"executor=:multi", "the name of a node is missing"},
      {"priority=/one:100", "'100' is no priority"},
      {"rate=/one:fast", "'fast' is no rate"},
      {"rate(/one)", "expected '*'"},
      {"rate(/one*2", "no node '/one*2'"},
      {"duration(/one)*-1", "'-1' is no factor"},
      {"duration=/one:5", "'5' is no duration"},
      {"groups=/one:many", "'many' is no way to group callbacks"},
      {"cpus=4,", "change is missing"},
  };
  for (const auto& [text, message] : cases) {
    EXPECT_NE(error(text).find(message), std::string::npos) << text << "\n" << error(text);
  }
}

TEST(WhatIf, ANodeWithoutATimerHasNoRate) {
  TwoNodes small;
  small.system.callbacks.pop_back();
  try {
    apply_what_if("rate(/camera)*2", small.system);
    FAIL();
  } catch (const launch::LaunchError& error) {
    EXPECT_NE(std::string(error.what()).find("has no timer"), std::string::npos);
  }
}

}  // namespace
}  // namespace tracing::twin
