// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/analysis/derived_results.hpp"

#include <map>
#include <string_view>
#include <tuple>

namespace tracing {

namespace {

constexpr std::string_view kMark = "/_action/";

}  // namespace

bool is_of_action(const std::string& service) {
  return service.find(kMark) != std::string::npos;
}

std::vector<ActionResult> action_results(const Ros2Results& results) {
  std::map<std::tuple<std::string, std::string, std::optional<ProcessIndex>>, ActionResult> actions;
  for (const CallResult& call : results.calls) {
    const std::size_t mark = call.service.find(kMark);
    if (mark == std::string::npos) {
      continue;
    }
    const std::string name = call.service.substr(0, mark);
    ActionResult& action = actions[{name, call.client, call.client_process}];
    action.name = name;
    action.client = call.client;
    action.client_process = call.client_process;
    if (!call.server.empty()) {
      action.server = call.server;
    }
    if (call.server_process) {
      action.server_process = call.server_process;
    }
    const std::string_view kind = std::string_view(call.service).substr(mark + kMark.size());
    if (kind == "send_goal") {
      action.goals += call.requests;
      action.answers += call.responses;
      action.acceptance = call.round_trip;
    } else if (kind == "get_result") {
      action.results += call.responses;
      action.execution = call.round_trip;
    } else if (kind == "cancel_goal") {
      action.cancels += call.requests;
    }
  }
  std::vector<ActionResult> list;
  for (auto& [key, action] : actions) {
    for (const TopicResult& topic : results.topics) {
      if (topic.name == action.name + "/_action/feedback") {
        action.feedback = topic.published + topic.intra_process_published;
      }
    }
    list.push_back(std::move(action));
  }
  return list;
}

}  // namespace tracing
