// SPDX-License-Identifier: Apache-2.0
#include "launcher/crash/late_processes.hpp"

#include <gmock/gmock.h>

#include <sstream>

namespace launch {
namespace {

using testing::IsEmpty;
using testing::UnorderedElementsAre;

TEST(LateProcesses, AreThoseOfTheEventsWithTheTimeOfTheLastOne) {
  std::istringstream csv(
      "time_ns,event,cpu_id,vpid,vtid,procname,callback,duration\n"
      "17000000000000000001,ros2_deadline:callback,0,,,\n"
      "1700000000000000002,ros2_deadline:callback,0,4711,4712,planner,2,30\n"
      "1700000000000000009,ros2_deadline:callback,1,4711,4711,planner,2,30\n"
      "1700000000000000005,ros2_deadline:callback,1,815,815,\"cam,era\",2,30\n"
      "launch trace read: warning: 3 events of ros2_0 were lost\n");
  EXPECT_THAT(late_processes_of(csv),
              UnorderedElementsAre(std::pair<const pid_t, std::int64_t>(4711, 1700000000000000009),
                                   std::pair<const pid_t, std::int64_t>(815, 1700000000000000005)));
}

TEST(LateProcesses, AreUnknownWithoutEventsOrProcessNumbers) {
  std::istringstream csv("time_ns,event,cpu_id,vpid,vtid,procname\n1,ros2_deadline:callback,0,,,\n");
  EXPECT_THAT(late_processes_of(csv), IsEmpty());
  std::istringstream empty;
  EXPECT_THAT(late_processes_of(empty), IsEmpty());
}

}  // namespace
}  // namespace launch
