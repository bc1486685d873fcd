// SPDX-License-Identifier: Apache-2.0
#include "launcher/testing/engine_task.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <vector>

#include "base/diagnostics/command_error.hpp"
#include "base/environment/own_environment.hpp"
#include "launcher/testing/engine.hpp"
#include "launcher/testing/test_queue.hpp"

namespace launch {

namespace {

class Silent final : public QueueObserver {
 public:
  void on_progress(std::size_t, std::size_t, const std::vector<std::string>&) override {}
  void on_result(const TestResult&) override {}
};

}  // namespace

int run_task(const std::string& word, const Registry& registry) {
  try {
    const EngineTask task = task_of(word);
    const Environment environment = own_environment();
    std::vector<TestCase> tests = {find_test(task.file, registry, environment, task.arguments, task.number, task.name)};
    tests.front().seed = task.seed;
    tests.front().faults = task.faults;
    QueueOptions options;
    options.directory = task.directory;
    options.keep = true;
    Silent silent;
    bool interrupted = false;
    const std::vector<TestResult> results =
        run_tests(tests, registry, environment, task.arguments, options, silent, interrupted);
    for (const TestResult& result : results) {
      fmt::print("{}\n", to_json(result));
    }
    return results.size() == 1 ? 0 : 1;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}", command_error("launch test", error.what()));
    return 1;
  }
}

}  // namespace launch
