// SPDX-License-Identifier: Apache-2.0
// Judges what tests expect of traces that are there already, whoever has recorded them. Nothing is started.
#pragma once

#include <filesystem>
#include <vector>

#include "launcher/language/registry.hpp"
#include "launcher/substitution/scope.hpp"
#include "launcher/testing/test_files.hpp"
#include "launcher/testing/test_queue.hpp"
#include "launcher/testing/test_result.hpp"

namespace launch {

struct FinishedTrace {
  std::vector<std::filesystem::path> directories;  // they are read as one trace
  bool skips_others = false;                       // what a trace does not tell is left out; else it is a failure
};

// One result for each test, in their order, which the observer is told.
std::vector<TestResult> judge_finished_trace(const std::vector<TestCase>& tests, const Registry& registry,
                                             const Environment& environment, const LaunchArguments& arguments,
                                             const FinishedTrace& trace, QueueObserver& observer);

}  // namespace launch
