// SPDX-License-Identifier: Apache-2.0
// Runs a command to its end and keeps what it writes.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "launcher/substitution/scope.hpp"

namespace launch {

// A command that writes more is ended.
constexpr std::size_t kLargestCommandOutput = 64UL << 20U;

struct CommandOutput {
  enum class GivenUp { kNot, kTookTooLong, kWroteTooMuch };

  std::string text;   // standard output, and standard error if that was asked for
  std::string error;  // standard error otherwise
  int status = 0;     // as waitpid() gives it
  GivenUp given_up = GivenUp::kNot;
};

struct CommandRules {
  bool merge_error = false;                   // standard error counts as standard output
  std::optional<std::chrono::seconds> limit;  // a command that takes longer is ended; nullopt: it may
};

// Blocks until the program has ended. `program` is a path; its standard input is empty. Throws std::runtime_error when
// it can't be started, and when a signal asks this process to end.
CommandOutput capture_command(const std::string& program, const std::vector<std::string>& argv,
                              const Environment& environment, const CommandRules& rules);

// "exit code 2", "killed by signal 9".
std::string describe_status(int status);

}  // namespace launch
