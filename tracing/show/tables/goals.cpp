// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/tables/goals.hpp"

#include <algorithm>
#include <map>
#include <string_view>
#include <tuple>

namespace tracing {

namespace {

using timeline::Call;
using timeline::Index;
using timeline::kNone;
using timeline::Timeline;

constexpr std::string_view kMark = "/_action/";

std::string_view service_of(const Timeline& timeline, const Call& call) {
  if (call.client != kNone) {
    return timeline.clients[call.client].name;
  }
  return call.service != kNone ? std::string_view(timeline.services[call.service].name) : std::string_view();
}

}  // namespace

std::vector<Goal> goals_of(const Timeline& timeline) {
  std::vector<Goal> goals;
  std::map<std::pair<Index, std::string_view>, std::vector<std::size_t>> answered;  // goals of a client, as they come
  const std::vector<Call>& calls = timeline.details.calls;
  for (std::size_t id = 0; id < calls.size(); ++id) {
    const std::string_view service = service_of(timeline, calls[id]);
    const std::size_t mark = service.rfind(kMark);
    if (mark == std::string_view::npos || service.substr(mark + kMark.size()) != "send_goal") {
      continue;
    }
    const Call& call = calls[id];
    Goal goal;
    goal.action = service.substr(0, mark);
    goal.client = call.client == kNone ? kNone : timeline.clients[call.client].node;
    goal.server = call.service == kNone ? kNone : timeline.services[call.service].node;
    goal.sent_ns = call.begin_ns();
    goal.answered_ns = call.received_ns;
    goal.goal_call = static_cast<Index>(id);
    answered[{goal.client, service.substr(0, mark)}].push_back(goals.size());
    goals.push_back(std::move(goal));
  }
  for (auto& [client, places] : answered) {
    std::erase_if(places, [&](std::size_t place) { return goals[place].answered_ns == 0; });
    std::sort(places.begin(), places.end(),
              [&](std::size_t a, std::size_t b) { return goals[a].answered_ns < goals[b].answered_ns; });
  }
  for (std::size_t id = 0; id < calls.size(); ++id) {
    const std::string_view service = service_of(timeline, calls[id]);
    const std::size_t mark = service.rfind(kMark);
    if (mark == std::string_view::npos || service.substr(mark + kMark.size()) != "get_result") {
      continue;
    }
    const Call& call = calls[id];
    const Index client = call.client == kNone ? kNone : timeline.clients[call.client].node;
    const auto known = answered.find({client, service.substr(0, mark)});
    if (known == answered.end() || call.sent_ns == 0) {
      continue;
    }
    const std::vector<std::size_t>& places = known->second;
    const auto after =
        std::upper_bound(places.begin(), places.end(), call.sent_ns,
                         [&](std::int64_t sent, std::size_t place) { return sent < goals[place].answered_ns; });
    if (after == places.begin() || goals[*(after - 1)].result_call != kNone) {
      continue;
    }
    Goal& goal = goals[*(after - 1)];
    goal.result_call = static_cast<Index>(id);
    goal.asked_ns = call.sent_ns;
    goal.result_ns = call.received_ns;
  }
  return goals;
}

}  // namespace tracing
