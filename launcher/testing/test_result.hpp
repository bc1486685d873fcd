// SPDX-License-Identifier: Apache-2.0
// The result of a test.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "launcher/testing/failure.hpp"

namespace launch {

struct TestResult {
  std::string file;  // the launch file, as it was given
  std::string name;
  unsigned line = 0;  // of the <test>
  double seconds = 0;
  std::size_t met = 0;                // expectations that hold
  std::size_t not_judged = 0;         // because another one failed before
  std::vector<TestFailure> failures;  // none: the test has passed
  std::string directory;              // its files; empty: they were removed

  bool passed() const { return failures.empty(); }
  std::string title() const { return file + ": " + name; }
};

// As one line of JSON, and back; nullopt for another text.
std::string to_json(const TestResult& result);
std::optional<TestResult> from_json(const std::string& text);

}  // namespace launch
