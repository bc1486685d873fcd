// SPDX-License-Identifier: Apache-2.0
// write_example_trace DIRECTORY CYCLES [scheduler] [writes] [slow] [older] [without_source_timestamps]: for tests in
// Python, and for measurements.
#include <cstdlib>
#include <string>

#include "tests/support/trace_writer/example_system.hpp"

int main(int argc, char** argv) {
  using tracing::testing::ExampleEvents;
  ExampleEvents events = ExampleEvents::kRos;
  tracing::testing::ExampleVariant variant;
  for (int i = 3; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "scheduler") {
      events = ExampleEvents::kRosAndScheduler;
    } else if (word == "writes") {
      variant.has_writes = true;
    } else if (word == "slow") {
      variant.usual_us = 1'400;
    } else if (word == "older") {
      variant.is_older = true;
    } else if (word == "without_source_timestamps") {
      variant.has_source_timestamps = false;
    } else {
      return 2;
    }
  }
  if (argc < 3) {
    return 2;
  }
  tracing::testing::write_example_system(argv[1], std::strtoull(argv[2], nullptr, 10), events, variant);
}
