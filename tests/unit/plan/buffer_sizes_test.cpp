// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/plan/buffer_sizes.hpp"

#include <gtest/gtest.h>

#include "tracing/record/plan/trace_config.hpp"

namespace {

using tracing::buffer_warning;
using tracing::sufficient_subbuffer_size;
using tracing::TraceConfig;

TraceConfig small_buffers() {
  TraceConfig config;
  config.ust.subbuffer_size = 32768;
  config.ust.subbuffer_count = 2;
  config.ust.read_timer = 200;
  return config;
}

TEST(BufferEstimate, DefaultsHoldAHundredNodesOnTwoProcessors) {
  EXPECT_EQ(buffer_warning(TraceConfig(), 100, 2), "");
  EXPECT_EQ(sufficient_subbuffer_size(TraceConfig(), 100, 2), TraceConfig().ust.subbuffer_size);
}

TEST(BufferEstimate, TheBuffersOfRos2TracingHoldAFewNodes) {
  EXPECT_EQ(buffer_warning(small_buffers(), 2, 2), "");
  EXPECT_EQ(buffer_warning(small_buffers(), 10, 2),
            "10 processes may fire 20000 events a second, more than 2 sub-buffers of 32768 bytes for each of 2 "
            "processors hold on a busy machine: events may be lost; subbuffers=\"auto\" sizes them");
}

TEST(BufferEstimate, ASufficientSizeIsNotWarnedOf) {
  for (const std::size_t nodes : {1u, 50u, 500u, 2000u}) {
    for (const std::size_t processors : {1u, 4u, 64u}) {
      TraceConfig config;
      config.ust.subbuffer_size = sufficient_subbuffer_size(config, nodes, processors);
      EXPECT_EQ(buffer_warning(config, nodes, processors), "") << nodes << " nodes, " << processors << " processors";
    }
  }
}

TEST(BufferEstimate, SnapshotSessionsAreMeantToLoseTheirOldestEvents) {
  TraceConfig config = small_buffers();
  config.snapshot_mode = true;
  EXPECT_EQ(buffer_warning(config, 1000, 1), "");
}

}  // namespace
