// SPDX-License-Identifier: Apache-2.0
// The command line of `launch report`.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tracing/show/report/comparison_command.hpp"
#include "tracing/show/report/output_files.hpp"
#include "tracing/show/report/report.hpp"

namespace report {

enum ExitCode { kSuccess = 0, kFailure = 1, kUsage = 2, kFailedOn = 3 };

struct Arguments {
  std::vector<std::string> directories;
  std::vector<std::filesystem::path> paths;  // of these, each one once; not set by parse_arguments
  bool json = false;
  tracing::ReportOptions text;
  std::optional<std::size_t> top;
  std::vector<std::string> chain;
  bool summary = false;
  bool recorded = false;
  bool live = false;
  double interval_s = 1;
  tracing::OutputFiles files;
  tracing::ComparisonArguments comparison;
};

// Returns the exit code when there is nothing more to do: after --help, or for wrong arguments, which it has told of.
std::optional<int> parse_arguments(int argc, char** argv, Arguments& arguments);

}  // namespace report
