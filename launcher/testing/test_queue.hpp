// SPDX-License-Identifier: Apache-2.0
// Runs tests side by side, each in a process of its own.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "launcher/language/registry.hpp"
#include "launcher/substitution/scope.hpp"
#include "launcher/testing/test_files.hpp"
#include "launcher/testing/test_result.hpp"

namespace launch {

struct QueueOptions {
  std::size_t jobs = 1;                  // tests at the same time
  std::string directory;                 // gets a directory for each test
  bool keep = false;                     // also the files of tests that have passed
  std::size_t rounds = 1;                // how often all tests run; 0: no limit
  bool stop_at_failure = false;          // no test begins after one has failed
  std::size_t retries = 0;               // how often a test that has failed runs again
  std::vector<std::string> engine = {};  // the command that each test is handed to (engine.hpp); empty: none
};

class QueueObserver {
 public:
  virtual ~QueueObserver() = default;
  // Which tests run has changed. `ended` of `all` tests have ended.
  virtual void on_progress(std::size_t ended, std::size_t all, const std::vector<std::string>& running) = 0;
  virtual void on_result(const TestResult& result) = 0;
};

// Returns the results in the order of the rounds and tests; fewer if Ctrl-C has ended the run, which sets
// `interrupted`. The process must have one thread. Throws std::system_error.
std::vector<TestResult> run_tests(const std::vector<TestCase>& tests, const Registry& registry,
                                  const Environment& environment, const LaunchArguments& arguments,
                                  const QueueOptions& options, QueueObserver& observer, bool& interrupted);

}  // namespace launch
