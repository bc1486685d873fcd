// SPDX-License-Identifier: Apache-2.0
// write_example_trace DIRECTORY CYCLES [scheduler]: for tests in Python, and for measurements.
#include <cstdlib>
#include <string>

#include "tests/support/trace_writer/example_system.hpp"

int main(int argc, char** argv) {
  using tracing::testing::ExampleEvents;
  if (argc != 3 && (argc != 4 || argv[3] != std::string("scheduler"))) {
    return 2;
  }
  const ExampleEvents events = argc == 4 ? ExampleEvents::kRosAndScheduler : ExampleEvents::kRos;
  tracing::testing::write_example_system(argv[1], std::strtoull(argv[2], nullptr, 10), events);
}
