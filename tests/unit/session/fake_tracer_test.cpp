// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/session/fake/fake_tracer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "tracing/record/plan/trace_config.hpp"
#include "tracing/record/plan/trace_error.hpp"

namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using tracing::FakeTracer;
using tracing::TraceConfig;
using tracing::TraceError;

TraceConfig config_named(const std::string& name) {
  TraceConfig config;
  config.session_name = name;
  config.base_path = "/traces";
  return config;
}

bool never() {
  return false;
}

TEST(FakeTracer, RecordsCallsAndOpenSessions) {
  FakeTracer tracer;
  EXPECT_EQ(tracer.start(config_named("a")).trace_directory, "/traces/a");
  tracer.start(config_named("b"));
  tracer.finish(config_named("a"), never);
  EXPECT_THAT(tracer.calls(), ElementsAre("start a", "start b", "finish a"));
  EXPECT_THAT(tracer.open_sessions(), ElementsAre("b"));
}

TEST(FakeTracer, FailsWhereItIsTold) {
  FakeTracer tracer;
  tracer.start_error = TraceError("no start");
  EXPECT_THROW(tracer.start(config_named("a")), TraceError);
  EXPECT_THAT(tracer.open_sessions(), IsEmpty());
  tracer.finish_error = TraceError("no finish");
  EXPECT_THROW(tracer.finish(config_named("a"), never), TraceError);
}

TEST(FakeTracer, BlockedFinishReturnsWhenItIsReleased) {
  FakeTracer tracer;
  tracer.block_finish();
  std::atomic<bool> finished = false;
  std::thread thread([&] {
    tracer.finish(config_named("a"), never);
    finished = true;
  });
  tracer.wait_until_finishing();
  EXPECT_FALSE(finished);
  tracer.release();
  thread.join();
  EXPECT_THAT(tracer.calls(), ElementsAre("finish a"));
}

TEST(FakeTracer, BlockedFinishReturnsWhenItIsToldToGiveUp) {
  FakeTracer tracer;
  tracer.block_finish();
  tracer.finish(config_named("a"), [] { return true; });
  EXPECT_THAT(tracer.calls(), ElementsAre("finish a", "give up a"));
}

}  // namespace
