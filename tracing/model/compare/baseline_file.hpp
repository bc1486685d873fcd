// SPDX-License-Identifier: Apache-2.0
// Baselines: files that hold what is kept of one or several runs. docs/comparing_runs.md and
// docs/schema/baseline.schema.json describe them.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "tracing/model/compare/run_summary.hpp"

namespace tracing::compare {

inline constexpr int kBaselineVersion = 1;

class BaselineError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// One JSON object that ends with a newline.
std::string baseline_text(const std::vector<RunSummary>& runs);

// Throws BaselineError if the file can't be read, is no baseline, has another version, or has no run.
Runs read_baseline(const std::filesystem::path& file);

}  // namespace tracing::compare
