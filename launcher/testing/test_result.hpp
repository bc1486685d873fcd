// SPDX-License-Identifier: Apache-2.0
// The result of a test.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "launcher/testing/failure.hpp"
#include "launcher/testing/fault_log.hpp"

namespace launch {

// What --shrink has found.
struct Shrunk {
  std::size_t of = 0;                    // faults of the run that has failed
  std::size_t runs = 0;                  // that it took
  std::vector<FaultResult> faults = {};  // those that are needed; none: the test fails without any
  std::string again = {};                // the command that runs the test with these faults
};

struct TestResult {
  std::string file;  // the launch file, as it was given
  std::string name;
  unsigned line = 0;  // of the <test>
  double seconds = 0;
  std::size_t met = 0;                // expectations that hold
  std::size_t not_judged = 0;         // because another one failed before, or a finished trace does not tell them
  std::vector<TestFailure> failures;  // none: the test has passed
  std::string directory;              // its files; empty: they were removed
  std::size_t round = 0;              // of --repeat, from 1; 0: there is only one
  std::size_t attempts = 1;           // with --retries: how often it has run
  std::string earlier = {};           // the message of the first attempt, if it failed

  std::optional<std::uint64_t> seed = {};  // of its faults, or of the command line
  bool seed_in_name = false;               // it ran with several
  std::vector<FaultResult> faults = {};
  std::string again = {};  // the command that repeats it; empty without a seed
  std::optional<Shrunk> shrunk = {};

  bool passed() const { return failures.empty(); }
  // "system.launch.xml: speaks", with "[seed 7]" and, in the third round, "#3" behind it.
  std::string title() const { return file + ": " + full_name(); }
  std::string full_name() const;
};

// "2 of 3 faults"; empty if the test has none.
std::string fault_count_text(const TestResult& result);
// The seed, each fault with its time, and how to repeat the test, as lines below a failure; empty without a seed.
std::string seed_text(const TestResult& result);

// What --shrink has found, as lines; empty without it.
std::string shrunk_text(const TestResult& result);

// As one line of JSON, and back; nullopt for another text.
std::string to_json(const TestResult& result);
std::optional<TestResult> from_json(const std::string& text);

}  // namespace launch
