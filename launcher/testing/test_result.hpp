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
  std::size_t round = 0;              // of --repeat, from 1; 0: there is only one
  std::size_t attempts = 1;           // with --retries: how often it has run
  std::string earlier = {};           // the message of the first attempt, if it failed

  bool passed() const { return failures.empty(); }
  // "system.launch.xml: speaks", with "#3" behind it in the third round.
  std::string title() const { return file + ": " + full_name(); }
  std::string full_name() const { return round == 0 ? name : name + " #" + std::to_string(round); }
};

// As one line of JSON, and back; nullopt for another text.
std::string to_json(const TestResult& result);
std::optional<TestResult> from_json(const std::string& text);

}  // namespace launch
