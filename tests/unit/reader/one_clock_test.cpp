// SPDX-License-Identifier: Apache-2.0
// Traces of one session, recorded while the wall clock of the machine was set.
#include "tracing/decode/reader/direct/one_clock.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "tracing/decode/ctf/trace_class.hpp"
#include "tracing/decode/reader/recording.hpp"

namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using tracing::put_on_one_clock;
using tracing::Recording;

const Recording kRun{.host = "robot", .machine = "boot-1", .session = "run 1"};

tracing::ctf::TraceClass trace_at(std::int64_t seconds, std::int64_t nanoseconds = 0) {
  tracing::ctf::TraceClass trace;
  trace.clocks["monotonic"] = {.name = "monotonic", .uuid = "boot-1", .offset_s = seconds, .offset = nanoseconds};
  return trace;
}

std::int64_t epoch(const tracing::ctf::TraceClass& trace) {
  return trace.clocks.at("monotonic").nanoseconds(0);
}

TEST(OneClock, TracesFromBeforeTheClockWasSetAreMoved) {
  tracing::ctf::TraceClass before = trace_at(5, 7);
  tracing::ctf::TraceClass after = trace_at(3605, 8);
  EXPECT_THAT(
      put_on_one_clock({{kRun, before}, {kRun, after}}),
      ElementsAre("the wall clock of robot was set while it was recorded, by 3600.000 s: the times of 1 of 2 traces "
                  "were moved, so that all are on one clock"));
  EXPECT_EQ(epoch(before), 3'605'000'000'008);
  EXPECT_EQ(epoch(after), 3'605'000'000'008);
}

TEST(OneClock, WhatMeasurementsDifferByIsLeftAlone) {
  tracing::ctf::TraceClass first = trace_at(5, 900);
  tracing::ctf::TraceClass second = trace_at(5, 1'000'900);
  EXPECT_THAT(put_on_one_clock({{kRun, first}, {kRun, second}}), IsEmpty());
  EXPECT_EQ(epoch(second) - epoch(first), 1'000'000);
}

TEST(OneClock, OtherSessionsAndMachinesKeepTheirTimes) {
  const Recording other_session{.host = "robot", .machine = "boot-1", .session = "run 2"};
  const Recording other_boot{.host = "robot", .machine = "boot-2", .session = "run 1"};
  const Recording unknown{.host = "robot", .machine = "", .session = "run 1"};
  std::vector<tracing::ctf::TraceClass> traces{trace_at(1), trace_at(2), trace_at(3), trace_at(4)};
  EXPECT_THAT(
      put_on_one_clock({{kRun, traces[0]}, {other_session, traces[1]}, {other_boot, traces[2]}, {unknown, traces[3]}}),
      IsEmpty());
  for (std::size_t i = 0; i < traces.size(); ++i) {
    EXPECT_EQ(epoch(traces[i]), static_cast<std::int64_t>(i + 1) * 1'000'000'000);
  }
}

TEST(OneClock, AClockWithAnotherFrequencyIsLeftAlone) {
  tracing::ctf::TraceClass slow = trace_at(1);
  slow.clocks["monotonic"].frequency = 1000;
  tracing::ctf::TraceClass usual = trace_at(9);
  EXPECT_THAT(put_on_one_clock({{kRun, slow}, {kRun, usual}}), IsEmpty());
  EXPECT_EQ(epoch(slow), 1'000'000'000);
}

}  // namespace
