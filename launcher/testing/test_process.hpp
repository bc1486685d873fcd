// SPDX-License-Identifier: Apache-2.0
// Runs one test in a process of its own.
#pragma once

#include <sys/types.h>

#include <string>

#include "launcher/language/registry.hpp"
#include "launcher/substitution/scope.hpp"
#include "launcher/testing/test_files.hpp"

namespace launch {

// What belongs to one run of a test, and to nothing else: its directory, and with it logs and generated files.
struct TestRun {
  const TestCase& test;
  const Registry& registry;
  const Environment& environment;
  const LaunchArguments& arguments;
  std::string directory;  // exists; gets output.txt, log/, ros/ and result.json
  int result;             // a descriptor that gets the result (test_result.hpp); a full disk can't take it away
};

// Starts the test with fork(2), which is cheap, and returns the number of the process. This process must have one
// thread. The test ends when this process does. SIGINT ends it as Ctrl-C ends a launch.
pid_t start_test(const TestRun& run);

}  // namespace launch
