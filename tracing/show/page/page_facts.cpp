// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <nlohmann/json.hpp>

#include "tracing/model/findings/finding.hpp"
#include "tracing/show/page/page_parts.hpp"
#include "tracing/show/page/result_facts.hpp"

namespace tracing {

namespace {

using Json = PageJson;
using timeline::Timeline;

Json json_reference(timeline::Index index) {
  return index == timeline::kNone ? Json(nullptr) : Json(index);
}

Json endpoints(const std::vector<timeline::Endpoint>& ends) {
  Json list = Json::array();
  for (const timeline::Endpoint& end : ends) {
    list.push_back({{"node", json_reference(end.node)}, {"topic", end.topic}});
  }
  return list;
}

Json objects(const Timeline& timeline) {
  Json threads = Json::array();
  for (const timeline::Thread& thread : timeline.threads) {
    threads.push_back({{"process", thread.process}, {"vtid", thread.vtid}});
  }
  Json nodes = Json::array();
  for (const timeline::Node& node : timeline.nodes) {
    nodes.push_back({{"process", node.process}, {"name", node.name}});
  }
  Json callbacks = Json::array();
  for (const timeline::Callback& callback : timeline.callbacks) {
    callbacks.push_back({{"process", callback.process},
                         {"node", json_reference(callback.node)},
                         {"kind", owner_name(callback.owner)},
                         {"topic", json_reference(callback.topic)},
                         {"service", callback.service},
                         {"period", callback.period_ns},
                         {"symbol", callback.symbol}});
  }
  Json others = Json::array();
  for (const timeline::OtherThread& other : timeline.other_threads) {
    others.push_back({{"tid", other.tid}, {"name", other.name}});
  }
  Json lifecycle = Json::array();
  for (const timeline::LifecycleState& interval : timeline.lifecycle) {
    lifecycle.push_back({{"node", interval.node},
                         {"state", interval.state},
                         {"begin", interval.begin_ns - timeline.begin_ns},
                         {"end", interval.end_ns - timeline.begin_ns}});
  }
  return {{"threads", threads},
          {"nodes", nodes},
          {"topics", timeline.topics},
          {"publishers", endpoints(timeline.publishers)},
          {"subscriptions", endpoints(timeline.subscriptions)},
          {"callbacks", callbacks},
          {"other_threads", others},
          {"lifecycle", lifecycle}};
}

Json overview(const TracedSystem& system, std::int64_t begin_ns) {
  const TraceOverview& overview = system.results.overview;
  const ResultFacts facts(begin_ns);
  return {{"events", overview.events},
          {"lost_events", std::max(overview.lost_events(), system.verdict.discarded_events)},
          {"lost_packets", std::max(overview.lost_packets(), system.verdict.lost_packets)},
          {"lost_uncounted", overview.lost_uncounted()},
          {"event_counts", facts.of(overview.event_counts)},
          {"losses", facts.of(overview.losses)}};
}

Json processes(const Timeline& timeline, const TraceOverview& overview) {
  Json list = Json::array();
  for (const timeline::Process& process : timeline.processes) {
    ProcessResult result = process.place ? overview.processes[*process.place] : ProcessResult{};
    result.vpid = process.vpid;
    result.name = process.name;
    result.host = process.host;
    list.push_back(ResultFacts(timeline.begin_ns).with({}, result));
  }
  return list;
}

// Null if the timeline is that of the whole trace.
Json whole_trace(const TracedSystem& system) {
  const Timeline& timeline = system.timeline;
  const std::int64_t begin_ns = system.results.overview.begin_ns.value_or(timeline.begin_ns);
  const std::int64_t end_ns = system.results.overview.end_ns.value_or(timeline.end_ns);
  if (begin_ns == timeline.begin_ns && end_ns == timeline.end_ns) {
    return nullptr;
  }
  return {{"begin", begin_ns - timeline.begin_ns}, {"end", end_ns - timeline.begin_ns}};
}

Json topic_at(const Timeline& timeline, const std::string& name) {
  const auto found = std::find(timeline.topics.begin(), timeline.topics.end(), name);
  return name.empty() || found == timeline.topics.end() ? Json(nullptr) : Json(found - timeline.topics.begin());
}

Json findings(const TracedSystem& system) {
  const ResultFacts facts(system.timeline.begin_ns);
  Json list = Json::array();
  for (const Finding& finding : find_worth_a_look(system.results)) {
    list.push_back(facts.with({{"kind", finding.name()}, {"title", finding.title()}}, finding));
    list.back()["callback"] = facts.of(finding.callback);
    list.back()["topic"] = topic_at(system.timeline, finding.topic);
  }
  return list;
}

Json chains(const TracedSystem& system) {
  const ResultFacts facts(system.timeline.begin_ns);
  Json list = Json::array();
  for (const ChainResult& chain : system.results.ros2.chains) {
    Json steps = Json::array();
    for (const ChainResult::Step& step : chain.steps) {
      Json fact{{"callback", step.callback_id}};
      if (step.has_message()) {
        fact["topic"] = topic_at(system.timeline, step.topic);
      }
      steps.push_back(facts.with(std::move(fact), step));
    }
    const Json begin{{"name", nullptr}, {"budget", nullptr}, {"over_budget", nullptr}, {"steps", std::move(steps)}};
    list.push_back(facts.with(begin, chain));
  }
  return list;
}

}  // namespace

std::string page_facts(const TracedSystem& system) {
  const Timeline& timeline = system.timeline;
  Json facts{{"version", 1},
             {"directory", system.directory.native()},
             {"error", system.error},
             {"is_open", !system.open.empty()},
             // JavaScript's numbers hold milliseconds since the epoch, but not nanoseconds.
             {"begin_ms", timeline.begin_ns / 1'000'000},
             {"duration", timeline.end_ns - timeline.begin_ns},
             {"whole", whole_trace(system)},
             {"instances", timeline.instances.size()},
             {"messages", timeline.messages.size()},
             {"states", timeline.states.size()},
             {"processes", processes(timeline, system.results.overview)},
             {"overview", overview(system, timeline.begin_ns)},
             {"findings", findings(system)},
             {"chains", chains(system)},
             {"unseen_chains", system.results.ros2.unseen_chains},
             {"has_all_chains", system.results.ros2.has_all_chains},
             {"warnings", system.results.warnings}};
  facts.update(objects(timeline));
  facts.update(result_facts(system));
  std::string text = facts.dump(-1, ' ', false, Json::error_handler_t::replace);
  // No text in it may end the script element, or begin a comment.
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at)) {
    text.replace(at, 1, "\\u003c");
  }
  return text;
}

}  // namespace tracing
