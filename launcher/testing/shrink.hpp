// SPDX-License-Identifier: Apache-2.0
// Finds a smallest set of faults with which a test still fails, by running it with ever smaller sets.
#pragma once

#include <cstddef>
#include <functional>
#include <set>
#include <vector>

#include "launcher/testing/test_files.hpp"
#include "launcher/testing/test_queue.hpp"
#include "launcher/testing/test_result.hpp"

namespace launch {

struct ShrunkSet {
  std::set<std::size_t> faults;  // none of them can be left out
  std::size_t runs = 0;
};

// Delta debugging (Zeller and Hildebrandt, "Simplifying and Isolating Failure-Inducing Input", 2002). The test fails
// with `faults`; `fails` runs it with a part of them.
ShrunkSet shrink(const std::set<std::size_t>& faults,
                 const std::function<bool(const std::set<std::size_t>& part)>& fails);

// Shrinks each result that has failed, and had faults: sets TestResult::shrunk and tells it. A run counts as failed if
// its first failure has the place of the one before. Other arguments as for run_tests(). Ctrl-C sets `interrupted`.
void shrink_failures(std::vector<TestResult>& results, const std::vector<TestCase>& tests, const Registry& registry,
                     const Environment& environment, const LaunchArguments& arguments, const QueueOptions& options,
                     const std::function<void(const TestResult&)>& tell, bool& interrupted);

}  // namespace launch
