// SPDX-License-Identifier: Apache-2.0
// The options of `launch test` about seeds and faults, and what they make of the tests.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "launcher/testing/test_files.hpp"

namespace launch {

// A mistake in the command line.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A number from 1. `option` is named in the error. Throws UsageError.
std::size_t whole_number(const std::string& text, const char* option);

struct SeedOptions {
  std::string seed;    // --seed N
  std::string seeds;   // --seeds N: each test runs with the seeds from 1 to N
  std::string faults;  // --faults 1,3, or none: only these are applied
};

// Each may be empty. Throws UsageError.
void apply_seeds(const SeedOptions& options, std::vector<TestCase>& tests);

// The command that runs the test again as it was: "launch test a.launch.xml --name 'one' --seed 7 --faults 1,3".
std::string command_of(const TestCase& test, const LaunchArguments& arguments);

}  // namespace launch
