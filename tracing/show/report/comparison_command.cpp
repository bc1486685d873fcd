// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/report/comparison_command.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "tracing/model/compare/baseline_file.hpp"
#include "tracing/model/findings/quantity_text.hpp"
#include "tracing/show/export/output_file.hpp"
#include "tracing/show/page/comparison_page.hpp"
#include "tracing/show/report/compared_run.hpp"

namespace tracing {

namespace {

namespace fs = std::filesystem;

// "12.5", and what follows it without blanks: "ms", "%", "". nullopt without a number.
std::optional<std::pair<double, std::string>> number_and_unit(const std::string& text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || !std::isfinite(number) || number < 0) {
    return std::nullopt;
  }
  std::string unit(end, text.data() + text.size());
  unit.erase(0, unit.find_first_not_of(' '));
  return std::pair(number, unit);
}

// A directory is a trace, anything else a baseline.
compare::Runs read_side(const std::string& path, bool all) {
  if (!fs::exists(path)) {
    throw std::runtime_error(fmt::format(
        "{} does not exist: --diff takes the directory of a trace or the file of a baseline on each side", path));
  }
  if (!fs::is_directory(path)) {
    return compare::read_baseline(path);
  }
  const fs::path directory = fs::weakly_canonical(path);
  return {directory.native(), {read_run({directory}, all)}};
}

}  // namespace

bool set_least(compare::CompareOptions& options, const std::string& text) {
  const auto least = number_and_unit(text);
  if (!least) {
    return false;
  }
  const auto& [number, unit] = *least;
  if (unit == "%") {
    options.least_ratio = number / 100;
    return true;
  }
  static const std::map<std::string, double> kUnits{{"ns", 1}, {"us", 1e3}, {"ms", 1e6}, {"s", 1e9}};
  const auto found = kUnits.find(unit);
  if (found == kUnits.end()) {
    return false;
  }
  options.least_ns = std::llround(number * found->second);
  return true;
}

std::optional<double> confidence_of(const std::string& text) {
  const auto confidence = number_and_unit(text);
  if (!confidence || (confidence->second != "%" && !confidence->second.empty())) {
    return std::nullopt;
  }
  const double share = confidence->second == "%" ? confidence->first / 100 : confidence->first;
  return share > 0.5 && share < 1 ? std::optional(share) : std::nullopt;
}

namespace {

ComparisonReport compared(const ComparisonArguments& arguments, compare::Runs before, compare::Runs after) {
  ComparisonReport report{std::move(before), std::move(after), arguments.options, {}};
  report.comparison = compare::compare(report.before, report.after, report.options);
  if (report.comparison.compared == 0) {
    throw std::runtime_error(fmt::format("{} and {} have no callback, hop, chain or service in common",
                                         report.before.source, report.after.source));
  }
  if (report.comparison.tests == 0) {
    throw std::runtime_error(fmt::format(
        "{} and {} have too few samples to compare anything: a callback or message must occur 16 times in each run",
        report.before.source, report.after.source));
  }
  return report;
}

// The page has the timelines of both runs, so each must be a trace.
ComparisonOutcome compare_with_page(const ComparisonArguments& arguments, const ReportOptions& options) {
  PagedRun runs[2];
  compare::Runs sides[2];
  for (const std::size_t side : {0, 1}) {
    const fs::path directory = fs::weakly_canonical(arguments.diff[side]);
    if (!fs::is_directory(directory)) {
      throw std::runtime_error(fmt::format(
          "--html needs the traces of both runs, and {} is no directory: a baseline has no callbacks to show",
          arguments.diff[side]));
    }
    runs[side] = read_run_for_page(directory, arguments.chains, arguments.all);
    sides[side] = {directory.native(), {std::move(runs[side].summary)}};
  }
  const ComparisonReport report = compared(arguments, std::move(sides[0]), std::move(sides[1]));
  const std::vector<std::string> failed = failures(report, arguments.fail_on);
  OutputFile file(arguments.html);
  file.write(comparison_page({runs[0].page, runs[1].page}, comparison_json(report, failed)));
  file.finish();
  return {fmt::format("{}\n{}: {}\n", comparison_text(report, failed, options), arguments.html.native(),
                      format_size(fs::file_size(arguments.html))),
          !failed.empty()};
}

}  // namespace

ComparisonOutcome compare_runs(const ComparisonArguments& arguments, const std::vector<fs::path>& directories,
                               const ReportOptions& options) {
  if (!arguments.html.empty()) {
    return compare_with_page(arguments, options);
  }
  const bool is_diff = !arguments.diff.empty();
  compare::Runs before =
      is_diff ? read_side(arguments.diff[0], arguments.all) : compare::read_baseline(arguments.baseline);
  compare::Runs after = is_diff ? read_side(arguments.diff[1], arguments.all)
                                : compare::Runs{directories.front().native(), {read_run(directories, arguments.all)}};
  const ComparisonReport report = compared(arguments, std::move(before), std::move(after));
  const std::vector<std::string> failed = failures(report, arguments.fail_on);
  return {arguments.json ? comparison_json(report, failed) : comparison_text(report, failed, options), !failed.empty()};
}

SavedBaseline save_baseline(const ComparisonArguments& arguments, const std::vector<fs::path>& directories) {
  const fs::path& file = arguments.save_baseline;
  std::vector<compare::RunSummary> runs;
  if (arguments.append && fs::exists(file)) {
    runs = compare::read_baseline(file).runs;
  }
  runs.push_back(read_run(directories, arguments.all));
  std::string remark = runs.back().remark;
  OutputFile output(file);
  output.write(compare::baseline_text(runs));
  output.finish();
  return {fmt::format("{}: {}, {}", file.native(), format_size(fs::file_size(file)), format_count(runs.size(), "run")),
          std::move(remark)};
}

}  // namespace tracing
