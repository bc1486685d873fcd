// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/report/report_keys.hpp"
#include "tracing/show/report/result_json.hpp"

namespace tracing {

std::string json_report(const Report& report) {
  ResultJson json(&report.results.overview);
  visit_report(report, json);
  return json.text();
}

}  // namespace tracing
