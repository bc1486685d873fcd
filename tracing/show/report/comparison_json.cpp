// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "tracing/show/report/comparison_report.hpp"

namespace tracing {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const compare::Runs& side) {
  Json runs = Json::array();
  for (const compare::RunSummary& run : side.runs) {
    runs.push_back({{"directory", run.directory},
                    {"begin_ns", run.begin_ns},
                    {"duration_ns", run.duration_ns},
                    {"events", run.events},
                    {"remark", run.remark}});
  }
  return {{"source", side.source}, {"runs", runs}};
}

Json json_of(const compare::Change& change) {
  return {{"kind", kind_name(change.kind)},     {"subject", change.subject},
          {"quantity", change.quantity},        {"statistic", statistic_name(change.statistic)},
          {"before_ns", change.before_ns},      {"after_ns", change.after_ns},
          {"shift_ns", change.shift.estimate},  {"shift_low_ns", change.shift.low},
          {"shift_high_ns", change.shift.high}, {"probability", change.probability},
          {"doubtful", change.doubtful},        {"changed_steps", change.changed_steps}};
}

Json json_of(const compare::Overall& overall) {
  return {{"callbacks", overall.callbacks}, {"slower", overall.slower}, {"ratio", overall.ratio}};
}

Json json_of(const std::vector<compare::Lone>& lone) {
  Json list = Json::array();
  for (const compare::Lone& one : lone) {
    list.push_back({{"kind", kind_name(one.kind)}, {"subject", one.subject}});
  }
  return list;
}

}  // namespace

std::string comparison_json(const ComparisonReport& report, const std::vector<std::string>& failed) {
  const compare::Comparison& comparison = report.comparison;
  Json changes = Json::array();
  for (const compare::Change& change : comparison.changes) {
    changes.push_back(json_of(change));
  }
  const Json json{{"version", 1},
                  {"before", json_of(report.before)},
                  {"after", json_of(report.after)},
                  {"confidence", report.options.confidence},
                  {"least_ratio", report.options.least_ratio},
                  {"least_ns", report.options.least_ns},
                  {"compared", comparison.compared},
                  {"tests", comparison.tests},
                  {"too_few_samples", comparison.too_few_samples},
                  {"changes", changes},
                  {"overall", comparison.overall ? json_of(*comparison.overall) : Json(nullptr)},
                  {"gone", json_of(comparison.gone)},
                  {"new", json_of(comparison.added)},
                  {"failed_on", failed}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace tracing
