// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/unit/report/example_reports.hpp"
#include "tracing/show/report/report.hpp"

namespace tracing {
namespace {

TEST(SummaryLine, SaysWhetherEventsWereLost) {
  TraceOverview overview = overview_of(412, {{71, "ping", 200, false}, {72, "pong", 212, false}});
  EXPECT_EQ(summary_line(overview), "412 events, 2 processes, none lost");
  overview.losses = {loss_of(37, 0, false)};
  EXPECT_EQ(summary_line(overview), "412 events, 2 processes, 37 events lost; doubtful: ping [71]");
  overview.losses = {loss_of(0, 3, false)};
  EXPECT_EQ(summary_line(overview), "412 events, 2 processes, 3 packets lost; doubtful: ping [71]");
  overview.losses = {loss_of(37, 0, false), loss_of(0, 1, true)};
  EXPECT_EQ(summary_line(overview),
            "412 events, 2 processes, at least 37 events and 1 packet lost; doubtful: ping [71]");
  overview.losses = {loss_of(0, 0, true)};
  EXPECT_EQ(summary_line(overview), "412 events, 2 processes, some events lost; doubtful: ping [71]");
}

TEST(SummaryLine, SaysWhatTheVerdictKnowsBeyondTheTrace) {
  TraceOverview overview = overview_of(412, {{71, "ping", 200, false}});
  RecordedVerdict verdict{.overwritten = {"900 events overwritten, as asked"}};
  EXPECT_EQ(summary_line(overview, verdict), "412 events, 1 process, none lost, 900 events overwritten, as asked");
  verdict.discarded_events = 12;
  EXPECT_EQ(summary_line(overview, verdict), "412 events, 1 process, 12 events lost, 900 events overwritten, as asked");
  overview.losses = {loss_of(37, 0, false)};
  EXPECT_EQ(summary_line(overview, verdict),
            "412 events, 1 process, 37 events lost, 900 events overwritten, as asked; doubtful: ping [71]");
}

TEST(SummaryLine, KnowsOneAndNone) {
  EXPECT_EQ(summary_line(overview_of(1, {{71, "ping", 1, false}})), "1 event, 1 process, none lost");
  EXPECT_EQ(summary_line(TraceOverview()), "no events");
}

}  // namespace
}  // namespace tracing
