// SPDX-License-Identifier: Apache-2.0
// `launch report --diff A B`, `launch report DIR --baseline FILE` and `launch report DIR --save-baseline FILE`.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tracing/model/chains/chain_definition.hpp"
#include "tracing/show/report/comparison_report.hpp"

namespace tracing {

struct ComparisonArguments {
  std::vector<std::string> diff;  // two: directories of traces, or baselines
  std::filesystem::path baseline;
  std::filesystem::path save_baseline;
  bool append = false;  // to the runs in save_baseline
  compare::CompareOptions options;
  std::set<std::string> fail_on;
  bool json = false;
  bool all = false;                     // also what is of processes that do not belong to the launch
  std::filesystem::path html;           // with `diff` of two traces: also a page with both
  std::vector<ChainDefinition> chains;  // those that the user has named, for the page

  bool compares() const { return !diff.empty() || !baseline.empty(); }
};

// "5%", "50us", "1.5 ms": changes one member of the options. Returns false if it is neither a share nor a duration.
bool set_least(compare::CompareOptions& options, const std::string& text);
// "99%", "0.99"; nullopt if it is not more than a half and less than the whole.
std::optional<double> confidence_of(const std::string& text);

// What is to be printed, and whether the comparison failed a word of `fail_on`. `directories`: of the trace after, or
// of the run to keep; empty with `diff`. Throws TraceReadError, BaselineError and OutputError, and std::runtime_error
// if the sides have nothing in common.
struct ComparisonOutcome {
  std::string text;
  bool failed = false;
};
ComparisonOutcome compare_runs(const ComparisonArguments& arguments,
                               const std::vector<std::filesystem::path>& directories, const ReportOptions& options);
struct SavedBaseline {
  std::string text;        // for people: "base.json: 120 kB, 3 runs"
  std::string incomplete;  // why the run that was added is; empty if it is complete
};
SavedBaseline save_baseline(const ComparisonArguments& arguments,
                            const std::vector<std::filesystem::path>& directories);

}  // namespace tracing
