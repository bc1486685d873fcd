// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/report/comparison_report.hpp"
#include "tracing/show/report/result_json.hpp"

namespace tracing {

std::string comparison_json(const ComparisonReport& report, const std::vector<std::string>& failed) {
  const compare::Comparison& comparison = report.comparison;
  ResultJson json;
  const auto side = [&json](const compare::Runs& runs) {
    return ResultJson::Json{{"source", runs.source}, {"runs", json.of(runs.runs)}};
  };
  json("version", 1);
  json("before", side(report.before));
  json("after", side(report.after));
  json("confidence", report.options.confidence);
  json("least_ratio", report.options.least_ratio);
  json("least_ns", report.options.least_ns);
  json("compared", comparison.compared);
  json("tests", comparison.tests);
  json("too_few_samples", comparison.too_few_samples);
  json("changes", comparison.changes);
  json("overall", comparison.overall);
  json("gone", comparison.gone);
  json("new", comparison.added);
  json("failed_on", failed);
  return json.text();
}

}  // namespace tracing
