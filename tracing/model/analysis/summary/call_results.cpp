// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>
#include <tuple>

#include "tracing/model/analysis/summary/summary.hpp"

namespace tracing {

namespace {

CallResult call_result(const Subjects& subjects, const ServiceMatcher::Pair& pair, const CallRecord& record) {
  const ObjectModel& model = subjects.model();
  CallResult result;
  const auto& [client, service] = pair;
  const auto fill = [&subjects, &model](ObjectId node, std::optional<ProcessIndex>& process, std::string& name) {
    if (node == kNoObject) {
      return;
    }
    process = subjects.place_of(model.nodes()[node].process);
    name = model.nodes()[node].name;
  };
  if (service != kNoObject) {
    result.service = model.services()[service].name;
    fill(model.services()[service].node, result.server_process, result.server);
  }
  if (client != kNoObject) {
    result.service = model.clients()[client].name;
    fill(model.clients()[client].node, result.client_process, result.client);
  }
  result.requests = record.requests;
  result.responses = record.responses;
  result.in_flight = record.in_flight;
  result.round_trip = record.round_trip.summary();
  result.request = record.request.summary();
  result.in_service = record.service.summary();
  result.response = record.response.summary();
  return result;
}

}  // namespace

std::vector<CallResult> call_results(const Subjects& subjects, const ServiceMatcher& calls) {
  std::vector<CallResult> results;
  for (const auto& [pair, record] : calls.records()) {
    results.push_back(call_result(subjects, pair, record));
  }
  std::sort(results.begin(), results.end(), [](const CallResult& left, const CallResult& right) {
    return std::tie(left.service, left.client, left.client_process, left.server, left.server_process) <
           std::tie(right.service, right.client, right.client_process, right.server, right.server_process);
  });
  return results;
}

}  // namespace tracing
