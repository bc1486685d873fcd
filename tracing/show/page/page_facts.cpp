// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "tracing/model/analysis/results.hpp"
#include "tracing/model/findings/finding.hpp"
#include "tracing/model/timeline/traced_system.hpp"
#include "tracing/show/page/page.hpp"

namespace tracing {

namespace {

using Json = nlohmann::ordered_json;
using timeline::Timeline;

// Results of the whole trace that the page shows as they are, made from the rows of their fields. Keys are the names
// of fields without _ns. Points in time count from `begin_ns`.
class ResultFacts {
 public:
  explicit ResultFacts(std::int64_t begin_ns) : begin_ns_(begin_ns) {}

  template <class Value>
  Json of(const Value& value) const {
    return value;
  }
  template <class Value>
  Json of(const std::optional<Value>& value) const {
    return value ? of(*value) : Json(nullptr);
  }
  // Null if nothing was measured.
  Json of(const DurationSummary& summary) const {
    if (summary.count == 0) {
      return nullptr;
    }
    Json durations = with_fields(Json::object(), summary, kDurationFields);
    durations["mean"] = std::llround(summary.mean_ns);  // a page has thousands of them
    return durations;
  }
  template <HasFields Result>
  Json of(const std::vector<Result>& results) const {
    Json list = Json::array();
    for (const Result& result : results) {
      list.push_back(with(Json::object(), result));
    }
    return list;
  }
  // The object with the fields of the result. A key that it has keeps its place.
  template <HasFields Result>
  Json with(Json object, const Result& result) const {
    return with_fields(std::move(object), result, Result::kFields);
  }

 private:
  template <class Result, std::size_t kCount>
  Json with_fields(Json object, const Result& result, const Field<Result> (&fields)[kCount]) const {
    for (const Field<Result>& field : fields) {
      if (field.has(trait::kProcess | trait::kNotOnPage) || field.member.is_list() || !field.is_in(result)) {
        continue;
      }
      const std::string name = field.name;
      Json& value = object[name.ends_with("_ns") ? name.substr(0, name.size() - 3) : name];
      field.member.visit([&](auto member) { value = of(std::invoke(member, result)); });
      if (field.has(trait::kTime) && !value.is_null()) {
        value = value.template get<std::int64_t>() - begin_ns_;
      }
    }
    return object;
  }

  std::int64_t begin_ns_;
};

// The process at a place in the overview; null if there is none.
Json process_at(const timeline::Timeline& timeline, const std::optional<ProcessIndex>& place) {
  for (std::size_t id = 0; place && id < timeline.processes.size(); ++id) {
    if (timeline.processes[id].place == place) {
      return id;
    }
  }
  return nullptr;
}

Json starts(const TracedSystem& system) {
  const ResultFacts facts(system.timeline.begin_ns);
  Json list = Json::array();
  for (const StartResult& start : system.results.starts) {
    // The keys that the page has in another order than the report.
    Json fact{{"process", process_at(system.timeline, start.place)}, {"name", start.process}};
    for (const char* key : {"file", "line", "spawn", "exec", "init_after"}) {
      fact[key] = nullptr;
    }
    list.push_back(facts.with(std::move(fact), start));
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
  // What --from and --to count from.
  const std::int64_t first_ns = system.first_event_ns != 0 ? system.first_event_ns : begin_ns;
  return {{"begin", begin_ns - timeline.begin_ns},
          {"end", end_ns - timeline.begin_ns},
          {"first", first_ns - timeline.begin_ns}};
}

Json launcher_events(const TracedSystem& system) {
  const ResultFacts facts(system.timeline.begin_ns);
  const bool is_part = !whole_trace(system).is_null();
  Json list = Json::array();
  for (const LauncherEventResult& event : system.results.launcher_events) {
    if (is_part && (event.time_ns < system.timeline.begin_ns || event.time_ns > system.timeline.end_ns)) {
      continue;
    }
    list.push_back(facts.with({{"sentence", event.sentence()}, {"ordinary", event.is_ordinary()}}, event));
  }
  return list;
}

Json startup(const TracedSystem& system) {
  if (!system.results.startup) {
    return nullptr;
  }
  const StartupResult& startup = *system.results.startup;
  return {{"duration", startup.ready_ns - startup.begin_ns},
          {"path", ResultFacts(startup.begin_ns).of(startup.critical_path)}};
}

// Of lifecycle nodes whose processes asked for memory in the trace.
Json state_memory(const TracedSystem& system) {
  Json list = Json::array();
  for (const LifecycleResult& state : system.results.ros2.lifecycle) {
    if (state.process_allocations == 0) {
      continue;
    }
    list.push_back({{"node", state.node},
                    {"state", state.state},
                    {"begin", state.begin_ns - system.timeline.begin_ns},
                    {"duration", state.end_ns - state.begin_ns},
                    {"allocations", state.allocations.value_or(0)},
                    {"bytes", state.allocated_bytes},
                    {"process_allocations", state.process_allocations},
                    {"process_bytes", state.process_allocated_bytes}});
  }
  return list;
}

// [callback, runs, calls of malloc and the like, bytes] for each callback of which this is known.
Json callback_memory(const TracedSystem& system) {
  Json list = Json::array();
  for (const CallbackResult& callback : system.results.ros2.callbacks) {
    if (!callback.allocations) {
      continue;
    }
    list.push_back(
        {callback.id, callback.durations.count + callback.unfinished, *callback.allocations, callback.allocated_bytes});
  }
  return list;
}

Json cost(const RecordedVerdict& verdict) {
  if (!verdict.ns_per_event) {
    return nullptr;
  }
  Json processes = Json::array();
  for (const RecordedVerdict::ProcessCost& process : verdict.processes) {
    Json fact;
    for (const char* key : {"name", "vpid", "events", "seconds"}) {
      fact[key] = nullptr;
    }
    fact["share"] = process.processor_share;
    processes.push_back(ResultFacts(0).with(std::move(fact), process));
  }
  return {{"ns_per_event", *verdict.ns_per_event}, {"processes", std::move(processes)}};
}

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
  Json kept = Json::array();
  for (const timeline::KeptMessage& one : timeline.kept) {
    kept.push_back({one.publisher, one.subscription});
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
          {"kept", kept},
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
          {"lost_unknown", system.verdict.damaged},
          {"event_counts", facts.of(overview.event_counts)},
          {"losses", facts.of(overview.losses)}};
}

// 0 for a process that has events of the kernel alone: `folded` counts it, and nothing refers to it.
Json processes(const Timeline& timeline, const TraceOverview& overview) {
  Json list = Json::array();
  for (const timeline::Process& process : timeline.processes) {
    ProcessResult result = process.place ? overview.processes[*process.place] : ProcessResult{};
    if (result.folded > 0) {
      list.push_back(0);
      continue;
    }
    result.vpid = process.vpid;
    result.name = process.name;
    result.host = process.host;
    list.push_back(ResultFacts(timeline.begin_ns).with({}, result));
  }
  return list;
}

// The processes that have events of the kernel alone, by name.
Json folded_processes(const TraceOverview& overview) {
  Json list = Json::array();
  for (const ProcessResult& process : overview.processes) {
    if (process.folded > 0) {
      list.push_back(
          {{"name", process.name}, {"host", process.host}, {"count", process.folded}, {"events", process.events}});
    }
  }
  return list;
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

// [topic, messages whose publication is an estimate, publications that may have been taken or not] of recordings
// without timestamps of publications.
Json estimates(const TracedSystem& system) {
  Json list = Json::array();
  for (const TopicResult& topic : system.results.ros2.topics) {
    if (topic.is_estimated()) {
      list.push_back({topic_at(system.timeline, topic.name), topic.estimated, topic.undecided});
    }
  }
  return list;
}

// starts, startup, launcher_events, calls, actions, state_memory, callback_memory, cost, absences, overwritten, others.
Json result_facts(const TracedSystem& system) {
  const ResultFacts facts(system.timeline.begin_ns);
  return {{"starts", starts(system)},
          {"startup", startup(system)},
          {"launcher_events", launcher_events(system)},
          {"calls", facts.of(system.results.ros2.calls)},
          {"actions", facts.of(system.results.ros2.actions)},
          {"state_memory", state_memory(system)},
          {"callback_memory", callback_memory(system)},
          {"cost", cost(system.verdict)},
          {"absences", system.verdict.absences},
          {"overwritten", system.verdict.overwritten},
          {"others", system.others.size()}};
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
             {"folded", folded_processes(system.results.overview)},
             {"overview", overview(system, timeline.begin_ns)},
             {"findings", findings(system)},
             {"chains", chains(system)},
             {"unseen_chains", system.results.ros2.unseen_chains},
             {"has_all_chains", system.results.ros2.has_all_chains},
             {"estimates", estimates(system)},
             {"remarks", system.results.ros2.remarks},
             {"warnings", system.results.warnings}};
  facts.update(objects(timeline));
  facts.update(result_facts(system));
  return script_text(facts.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace tracing
