// SPDX-License-Identifier: Apache-2.0
// What processes fire while a session is paused is not missing.
#include "tracing/record/account/counters/session_pauses.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "base/monotonic_clock.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using tracing::EventCounts;

std::uint64_t now() {
  return static_cast<std::uint64_t>(launch::monotonic_time());
}

TEST(SessionPauses, ForgiveWhatWasFiredInThem) {
  const test_support::Sandbox sandbox;
  const std::string counters = sandbox.directory();
  const std::uint64_t before = now();
  tracing::note_pause(counters, "run");
  const std::uint64_t meanwhile = now();
  tracing::note_resume(counters, "run");
  const std::uint64_t after = now();
  const std::vector<EventCounts> counts = {
      {.pid = 1, .begin = before - 9, .reached = before - 5, .missed = 10},  // late, and all before the pause
      {.pid = 2, .begin = before - 9, .reached = after, .missed = 20},
      {.pid = 3, .begin = meanwhile, .end = meanwhile, .missed = 30},  // lived in the pause
      {.pid = 4, .begin = meanwhile, .missed = 40},                    // never reached, and was killed
      {.pid = 5, .begin = after, .reached = after + 9, .missed = 50}};
  const auto missed = [&](const std::string& session) {
    std::vector<EventCounts> forgiven = counts;
    tracing::forgive_pauses(forgiven, counters, session);
    std::vector<std::uint64_t> left;
    for (const EventCounts& process : forgiven) {
      left.push_back(process.missed);
    }
    return left;
  };
  EXPECT_EQ(missed("run"), (std::vector<std::uint64_t>{10, 0, 0, 0, 50}));
  EXPECT_EQ(missed("other"), (std::vector<std::uint64_t>{10, 20, 30, 40, 50}));
  tracing::note_pause(counters, "run");
  EXPECT_EQ(missed("run"), (std::vector<std::uint64_t>{10, 0, 0, 0, 50})) << "process 5 was reached before";
}

}  // namespace
