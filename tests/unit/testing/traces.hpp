// SPDX-License-Identifier: Apache-2.0
// Traces with known events, in memory.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "launch_trace_testing/expectations.hpp"
#include "launch_trace_testing/trace.hpp"
#include "tests/support/trace_writer/example_system.hpp"
#include "tests/support/trace_writer/ping_pong_sequence.hpp"
#include "tests/support/trace_writer/temporary_directory.hpp"

namespace launch_trace_testing {

template <class Write>
Trace written(Write write, const ReadOptions& options = {}) {
  const tracing::testing::TemporaryDirectory directory;
  tracing::testing::TraceWriter writer(directory.path() / "trace");
  write(writer);
  writer.finish();
  return Trace(directory.path(), options);
}

// Processes ping (71) and pong (72), as ping_pong_sequence.hpp has them.
inline Trace ping_pong_trace(const ReadOptions& options = {}) {
  return written(
      [](tracing::testing::TraceWriter& writer) {
        for (const tracing::testing::SequenceEvent& event : tracing::testing::ping_pong_sequence()) {
          writer.write(0, event.time_ns, event.thread, event.event);
        }
      },
      options);
}

// Nodes /sensor, /filter and /display, as example_system.hpp has them.
inline Trace example_trace(std::uint64_t cycles, const tracing::testing::ExampleVariant& variant = {}) {
  const tracing::testing::TemporaryDirectory directory;
  tracing::testing::write_example_system(directory.path() / "trace", cycles, tracing::testing::ExampleEvents::kRos,
                                         variant);
  return Trace(directory.path());
}

// The text of a verdict that is expected to fail.
inline std::string failure(const Verdict& verdict) {
  EXPECT_FALSE(verdict.holds);
  return verdict.text;
}

}  // namespace launch_trace_testing
