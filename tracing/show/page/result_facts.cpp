// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/page/result_facts.hpp"

namespace tracing {

namespace {

PageJson starts(const TracedSystem& system) {
  const std::int64_t begin_ns = system.timeline.begin_ns;
  PageJson list = PageJson::array();
  for (const StartResult& start : system.results.starts) {
    list.push_back({{"process", process_json(system.timeline, start.place)},
                    {"name", start.process},
                    {"file", start.file},
                    {"line", start.line},
                    {"spawn", start.spawn_ns ? PageJson(*start.spawn_ns - begin_ns) : PageJson(nullptr)},
                    {"exec", start.exec_ns - begin_ns},
                    {"init_after", optional_json(start.init_after_ns)},
                    {"node_after", optional_json(start.node_after_ns)},
                    {"ready_after", optional_json(start.ready_after_ns)},
                    {"callback_after", optional_json(start.callback_after_ns)},
                    {"publication_after", optional_json(start.publication_after_ns)}});
  }
  return list;
}

PageJson startup(const TracedSystem& system) {
  if (!system.results.startup) {
    return nullptr;
  }
  const StartupResult& startup = *system.results.startup;
  PageJson path = PageJson::array();
  for (const StartStep& step : startup.critical_path) {
    path.push_back({{"process", step.process},
                    {"what", step.what},
                    {"begin", step.begin_ns - startup.begin_ns},
                    {"end", step.end_ns - startup.begin_ns}});
  }
  return {{"duration", startup.ready_ns - startup.begin_ns}, {"path", std::move(path)}};
}

PageJson calls(const TracedSystem& system) {
  PageJson list = PageJson::array();
  for (const CallResult& call : system.results.ros2.calls) {
    list.push_back({{"service", call.service},
                    {"client", call.client},
                    {"server", call.server},
                    {"requests", call.requests},
                    {"responses", call.responses},
                    {"round_trip", durations_json(call.round_trip)},
                    {"request", durations_json(call.request)},
                    {"in_service", durations_json(call.in_service)},
                    {"response", durations_json(call.response)}});
  }
  return list;
}

PageJson actions(const TracedSystem& system) {
  PageJson list = PageJson::array();
  for (const ActionResult& action : system.results.ros2.actions) {
    list.push_back({{"name", action.name},
                    {"client", action.client},
                    {"server", action.server},
                    {"goals", action.goals},
                    {"answers", action.answers},
                    {"results", action.results},
                    {"cancels", action.cancels},
                    {"feedback", action.feedback},
                    {"acceptance", durations_json(action.acceptance)},
                    {"execution", durations_json(action.execution)}});
  }
  return list;
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
    processes.push_back({{"name", process.name},
                         {"vpid", process.vpid},
                         {"events", process.events},
                         {"seconds", process.seconds},
                         {"share", process.processor_share},
                         {"ns_per_callback", process.ns_per_callback ? PageJson(*process.ns_per_callback) : nullptr}});
  }
  return {{"ns_per_event", *verdict.ns_per_event}, {"processes", std::move(processes)}};
}

}  // namespace

PageJson result_facts(const TracedSystem& system) {
  return {{"starts", starts(system)},
          {"startup", startup(system)},
          {"calls", calls(system)},
          {"actions", actions(system)},
          {"state_memory", state_memory(system)},
          {"callback_memory", callback_memory(system)},
          {"cost", cost(system.verdict)},
          {"absences", system.verdict.absences},
          {"overwritten", system.verdict.overwritten}};
}

}  // namespace tracing
