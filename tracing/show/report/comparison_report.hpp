// SPDX-License-Identifier: Apache-2.0
// Renders a comparison of runs, and decides whether it fails a test.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "tracing/model/compare/comparison.hpp"
#include "tracing/show/report/report.hpp"

namespace tracing {

struct ComparisonReport {
  compare::Runs before;
  compare::Runs after;
  compare::CompareOptions options;
  compare::Comparison comparison;
};

// What a comparison can fail on: "slower", "faster", "changed" (both), "overall", "gone", "new", "incomplete".
const std::vector<std::string>& fail_words();

// The words of `fail_on` that apply, in the order of fail_words().
std::vector<std::string> failures(const ComparisonReport& report, const std::set<std::string>& fail_on);

// Both end with a newline. `failed`: the result of failures(). The options give width and colour; with `top`, so many
// subjects of each kind, 0: all.
std::string comparison_text(const ComparisonReport& report, const std::vector<std::string>& failed,
                            const ReportOptions& options);
// docs/comparing_runs.md and docs/schema/comparison.schema.json describe it.
std::string comparison_json(const ComparisonReport& report, const std::vector<std::string>& failed);

}  // namespace tracing
