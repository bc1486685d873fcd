// SPDX-License-Identifier: Apache-2.0
// Questions of the tests in this folder to babeltrace2 and lttng, which know nothing about our code.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tests/support/command.hpp"

namespace trace_test {

struct ReadTrace {
  std::map<std::string, int> events;  // count by name
  std::uint64_t discarded = 0;        // events, as the reader's warnings say
  std::uint64_t lost_packets = 0;     // likewise
  int unknown_losses = 0;             // warnings that events may have been discarded, without a number
  std::vector<std::string> lines;
  std::string complaints;  // the reader's stderr except those warnings; must be empty
};

// Reads a trace directory with babeltrace2. A failure is in `complaints`.
ReadTrace read_trace(const std::string& directory);

// The sessions that `lttng list` shows, as it prints them; "" when there are none.
std::string listed_sessions();

// Starts the traced program and waits until it has fired.
class TracedApp {
 public:
  TracedApp(int count, int bytes);
  void fire_again();  // the same number of events as at first
  void end();

 private:
  test_support::RunningCommand process_;
  int fired_ = 1;
};

}  // namespace trace_test
