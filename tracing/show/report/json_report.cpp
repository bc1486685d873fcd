// SPDX-License-Identifier: Apache-2.0
#include <functional>
#include <nlohmann/json.hpp>

#include "tracing/show/report/comparison_report.hpp"
#include "tracing/show/report/report_keys.hpp"

namespace tracing {

namespace {

// One object, made from the rows of the results.
class ResultJson {
 public:
  using Json = nlohmann::ordered_json;

  // Results that name processes need the overview.
  explicit ResultJson(const TraceOverview* overview = nullptr) : overview_(overview) {}

  template <class Value>
  void operator()(const char* key, const Value& value) {
    json_[key] = of(value);
  }

  template <class Value>
  Json of(const Value& value) const {
    return value;
  }
  template <class Value>
  Json of(const std::optional<Value>& value) const {
    return value ? of(*value) : Json(nullptr);
  }
  template <class Value>
  Json of(const std::vector<Value>& values) const {
    Json list = Json::array();
    for (const Value& value : values) {
      list.push_back(of(value));
    }
    return list;
  }
  template <HasFields Result>
  Json of(const Result& result) const {
    return with_fields(Json::object(), result, Result::kFields);
  }
  Json of(const DurationSummary& summary) const {
    return summary.count == 0 ? Json{{"count", 0}} : with_fields(Json::object(), summary, kDurationFields);
  }
  Json of(const ChainResult& chain) const {
    return with_fields(Json{{"name", chain.name}, {"steps", of(chain.steps)}}, chain, ChainResult::kFields);
  }
  Json of(const StartupResult& startup) const {
    return {
        {"begin_ns", startup.begin_ns}, {"ready_ns", startup.ready_ns}, {"critical_path", of(startup.critical_path)}};
  }
  Json of(const RecordedVerdict& verdict) const {
    return verdict.ns_per_event ? Json{{"ns_per_event", *verdict.ns_per_event}, {"processes", of(verdict.processes)}}
                                : Json(nullptr);
  }

  // Ends with a newline. Names in a trace are bytes from the traced program. Bytes that are not UTF-8 must not make the
  // output fail.
  std::string text() const { return json_.dump(2, ' ', false, Json::error_handler_t::replace) + '\n'; }

 private:
  template <class Result, std::size_t kCount>
  Json with_fields(Json json, const Result& result, const Field<Result> (&fields)[kCount]) const {
    for (const Field<Result>& field : fields) {
      if (!field.is_in(result)) {
        continue;
      }
      field.member.visit([&](auto member) {
        const auto& value = std::invoke(member, result);
        if (field.has(trait::kProcess)) {
          json[vpid_key(field.name)] = vpid(value);
        }
        json[field.name] = of(value);
      });
    }
    return json;
  }

  Json vpid(ProcessIndex process) const {
    const std::vector<ProcessResult>& processes = overview_->processes;
    return process < processes.size() ? Json(processes[process].vpid.value_or(0)) : Json(nullptr);
  }
  Json vpid(const std::optional<ProcessIndex>& process) const { return process ? vpid(*process) : Json(nullptr); }
  template <class Other>
  Json vpid(const Other&) const {
    return nullptr;
  }

  const TraceOverview* overview_;
  Json json_ = Json::object();
};

}  // namespace

std::string json_report(const Report& report) {
  ResultJson json(&report.results.overview);
  visit_report(report, json);
  return json.text();
}

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
  json("undecided", comparison.undecided);
  json("changes", comparison.changes);
  json("likely", comparison.likely);
  json("overall", comparison.overall);
  json("gone", comparison.gone);
  json("new", comparison.added);
  json("failed_on", failed);
  return json.text();
}

}  // namespace tracing
