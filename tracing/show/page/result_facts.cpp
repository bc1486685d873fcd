// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/page/result_facts.hpp"

namespace tracing {

namespace {

// The process at a place in the overview; null if there is none.
PageJson process_at(const timeline::Timeline& timeline, const std::optional<ProcessIndex>& place) {
  for (std::size_t id = 0; place && id < timeline.processes.size(); ++id) {
    if (timeline.processes[id].place == place) {
      return id;
    }
  }
  return nullptr;
}

PageJson starts(const TracedSystem& system) {
  const ResultFacts facts(system.timeline.begin_ns);
  PageJson list = PageJson::array();
  for (const StartResult& start : system.results.starts) {
    // The keys that the page has in another order than the report.
    PageJson fact{{"process", process_at(system.timeline, start.place)}, {"name", start.process}};
    for (const char* key : {"file", "line", "spawn", "exec", "init_after"}) {
      fact[key] = nullptr;
    }
    list.push_back(facts.with(std::move(fact), start));
  }
  return list;
}

PageJson startup(const TracedSystem& system) {
  if (!system.results.startup) {
    return nullptr;
  }
  const StartupResult& startup = *system.results.startup;
  return {{"duration", startup.ready_ns - startup.begin_ns},
          {"path", ResultFacts(startup.begin_ns).of(startup.critical_path)}};
}

// Of lifecycle nodes whose processes asked for memory in the trace.
PageJson state_memory(const TracedSystem& system) {
  PageJson list = PageJson::array();
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
PageJson callback_memory(const TracedSystem& system) {
  PageJson list = PageJson::array();
  for (const CallbackResult& callback : system.results.ros2.callbacks) {
    if (!callback.allocations) {
      continue;
    }
    list.push_back(
        {callback.id, callback.durations.count + callback.unfinished, *callback.allocations, callback.allocated_bytes});
  }
  return list;
}

PageJson cost(const RecordedVerdict& verdict) {
  if (!verdict.ns_per_event) {
    return nullptr;
  }
  PageJson processes = PageJson::array();
  for (const RecordedVerdict::ProcessCost& process : verdict.processes) {
    PageJson fact;
    for (const char* key : {"name", "vpid", "events", "seconds"}) {
      fact[key] = nullptr;
    }
    fact["share"] = process.processor_share;
    processes.push_back(ResultFacts(0).with(std::move(fact), process));
  }
  return {{"ns_per_event", *verdict.ns_per_event}, {"processes", std::move(processes)}};
}

}  // namespace

PageJson result_facts(const TracedSystem& system) {
  const ResultFacts facts(system.timeline.begin_ns);
  return {{"starts", starts(system)},
          {"startup", startup(system)},
          {"calls", facts.of(system.results.ros2.calls)},
          {"actions", facts.of(system.results.ros2.actions)},
          {"state_memory", state_memory(system)},
          {"callback_memory", callback_memory(system)},
          {"cost", cost(system.verdict)},
          {"absences", system.verdict.absences},
          {"overwritten", system.verdict.overwritten}};
}

}  // namespace tracing
