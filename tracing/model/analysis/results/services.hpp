// SPDX-License-Identifier: Apache-2.0
// Calls of services, and the actions that consist of them.
#pragma once

#include "tracing/model/analysis/results/overview.hpp"

namespace tracing {

// The calls of one client to one service.
struct CallResult {
  std::string service;
  std::optional<ProcessIndex> client_process;
  std::string client;
  std::optional<ProcessIndex> server_process;
  std::string server;
  std::uint64_t requests = 0;
  std::uint64_t responses = 0;
  std::uint64_t in_flight = 0;
  std::uint64_t unanswered() const { return requests - responses - in_flight; }
  DurationSummary round_trip;
  DurationSummary request;
  DurationSummary in_service;
  DurationSummary response;

  static const Field<CallResult> kFields[];
};
inline constexpr Field<CallResult> CallResult::kFields[] = {
    {"service", &CallResult::service, "its name"},
    {"client_process", &CallResult::client_process, "index in `processes`; `null`: the client is not in the trace",
     trait::kProcess},
    {"client", &CallResult::client, "its node"},
    {"server_process", &CallResult::server_process,
     "likewise; `null`: the service is not in the trace, or never took a request", trait::kProcess},
    {"server", &CallResult::server, "its node"},
    {"requests", &CallResult::requests, ""},
    {"responses", &CallResult::responses, "taken by the client; sent, if the client is not in the trace"},
    {"in_flight", &CallResult::in_flight,
     "without a response when the trace or the client ended, and not late by then (`docs/report.md`). The rest of the "
     "requests is unanswered"},
    {"round_trip", &CallResult::round_trip, "from `rmw_send_request` to `rmw_take_response`; its parts follow"},
    {"request", &CallResult::request,
     "to `rmw_take_request`. `rmw_send_request` is recorded when the request is on its way already. If the service "
     "took "
     "the request before that, `request` is 0 and `round_trip` is too short"},
    {"in_service", &CallResult::in_service, "from there to `rmw_send_response`"},
    {"response", &CallResult::response, "from there to `rmw_take_response`"},
};

// What one client asks of one action.
struct ActionResult {
  std::string name;
  std::optional<ProcessIndex> client_process;  // as in CallResult
  std::string client;
  std::optional<ProcessIndex> server_process;
  std::string server;
  std::uint64_t goals = 0;
  std::uint64_t answers = 0;
  std::uint64_t results = 0;
  std::uint64_t cancels = 0;
  std::uint64_t feedback = 0;
  DurationSummary acceptance;
  DurationSummary execution;

  static const Field<ActionResult> kFields[];
};
inline constexpr Field<ActionResult> ActionResult::kFields[] = {
    {"name", &ActionResult::name, ""},
    {"client_process", &ActionResult::client_process, "as in `calls`", trait::kProcess},
    {"client", &ActionResult::client, "its node"},
    {"server_process", &ActionResult::server_process, "as in `calls`", trait::kProcess},
    {"server", &ActionResult::server, "its node"},
    {"goals", &ActionResult::goals, "sent"},
    {"answers", &ActionResult::answers, "whether they are accepted"},
    {"results", &ActionResult::results, "received"},
    {"cancels", &ActionResult::cancels, "asked for"},
    {"feedback", &ActionResult::feedback, "messages that the server published, for all clients"},
    {"acceptance", &ActionResult::acceptance, "from a goal to the answer"},
    {"execution", &ActionResult::execution, "from the request for a result to the result"},
};

}  // namespace tracing
