// SPDX-License-Identifier: Apache-2.0
// Processes, threads, and the objects of ROS 2.
#include "tracing/show/tables/table_rows.hpp"

namespace tracing {

namespace {

using timeline::Endpoint;
using timeline::ServiceEnd;
using System = const TracedSystem&;

const ProcessResult* result_of(System system, const timeline::Process& process) {
  return process.place ? &system.results.overview.processes[*process.place] : nullptr;
}

std::vector<ColumnOf<Endpoint>> endpoint_columns() {
  return {
      {"node", kInteger, [](System, const Endpoint& end) { return reference(end.node); }, "in `nodes`"},
      {"topic", kInteger, [](System, const Endpoint& end) { return reference(end.topic); }, "in `topics`"},
      {"queue_depth", kInteger, [](System, const Endpoint& end) { return number(end.queue_depth); },
       "as the program asked for it"},
      {"reliable", kInteger, [](System, const Endpoint& end) { return end.qos ? number(end.qos->reliable) : Cell{}; },
       "1 or 0; this and what follows is the quality of service that the middleware has agreed to, if the trace "
       "has it"},
      {"history_depth", kInteger,
       [](System, const Endpoint& end) { return end.qos ? number(end.qos->history_depth) : Cell{}; },
       "0: all messages are kept"}};
}

std::vector<ColumnOf<ServiceEnd>> service_columns() {
  return {{"node", kInteger, [](System, const ServiceEnd& end) { return reference(end.node); }, "in `nodes`"},
          {"name", kText, [](System, const ServiceEnd& end) { return text(end.name); }, "of the service"}};
}

std::vector<ColumnOf<timeline::Callback>> callback_columns() {
  using timeline::Callback;
  return {{"process", kInteger, [](System, const Callback& callback) { return reference(callback.process); },
           "in `processes`"},
          {"node", kInteger, [](System, const Callback& callback) { return reference(callback.node); }, "in `nodes`"},
          {"kind", kText,
           [](System, const Callback& callback) { return Cell{std::string_view(owner_name(callback.owner))}; },
           "`subscription`, `timer`, `service`, `client`, `unknown`"},
          {"topic", kInteger, [](System, const Callback& callback) { return reference(callback.topic); },
           "in `topics`, of a subscription"},
          {"service", kText, [](System, const Callback& callback) { return text(callback.service); },
           "name, of a service or client"},
          {"period_ns", kInteger,
           [](System, const Callback& callback) {
             return callback.owner == CallbackResult::Owner::kTimer ? Cell{callback.period_ns} : Cell{};
           },
           "of a timer"},
          {"address", kInteger, [](System, const Callback& callback) { return number(callback.address); }, ""},
          {"symbol", kText, [](System, const Callback& callback) { return text(callback.symbol); },
           "the function, in readable form"},
          {"owner", kInteger, [](System, const Callback& callback) { return reference(callback.owner_id); },
           "in `subscriptions`, `timers`, `services` or `clients`, as `kind` says"},
          {"callback_group", kInteger, [](System, const Callback& callback) { return reference(callback.group); },
           "in `callback_groups`"}};
}

}  // namespace

void add_object_tables(const TracedSystem& system, std::vector<Table>& tables) {
  const timeline::Timeline& timeline = system.timeline;
  tables.push_back(table_of<timeline::Process>(
      "processes", "", system, timeline.processes,
      {{"vpid", kInteger, [](System, const auto& process) { return number(process.vpid); }, "0: the trace has none"},
       {"name", kText, [](System, const auto& process) { return Cell{std::string_view(process.name)}; },
        "`procname` of its main thread"},
       {"host", kText, [](System, const auto& process) { return text(process.host); }, "name of the machine"},
       {"events", kInteger,
        [](System all, const auto& process) {
          const ProcessResult* result = result_of(all, process);
          return result == nullptr ? Cell{} : number(result->events);
        },
        "`NULL` for the launcher"},
       {"doubtful", kInteger,
        [](System all, const auto& process) {
          const ProcessResult* result = result_of(all, process);
          return result == nullptr ? Cell{} : number(result->doubtful);
        },
        "1: a buffer that the process may have used lost events, or a part of the trace is missing"}}));
  tables.push_back(table_of<timeline::Thread>(
      "threads", "those that ran callbacks, published, took messages of the trace or waited for work", system,
      timeline.threads,
      {{"process", kInteger, [](System, const auto& thread) { return reference(thread.process); }, "in `processes`"},
       {"vtid", kInteger, [](System, const auto& thread) { return number(thread.vtid); }}}));
  tables.push_back(table_of<timeline::Node>(
      "nodes", "", system, timeline.nodes,
      {{"process", kInteger, [](System, const auto& node) { return reference(node.process); }, "in `processes`"},
       {"name", kText, [](System, const auto& node) { return Cell{std::string_view(node.name)}; },
        "with its namespace"}}));
  tables.push_back(table_of<std::string>(
      "topics", "", system, timeline.topics,
      {{"name", kText, [](System, const auto& topic) { return Cell{std::string_view(topic)}; }}}));
  tables.push_back(table_of("publishers", "", system, timeline.publishers, endpoint_columns()));
  std::vector<ColumnOf<Endpoint>> subscription_columns = endpoint_columns();
  subscription_columns.push_back(
      {"filtered", kInteger,
       [](System, const Endpoint& end) { return end.qos ? number(end.qos->is_filtered) : Cell{}; },
       "1: it takes messages of some contents only"});
  tables.push_back(table_of("subscriptions", "", system, timeline.subscriptions, subscription_columns));
  tables.push_back(table_of<timeline::Timer>(
      "timers", "those of nodes", system, timeline.timers,
      {{"node", kInteger, [](System, const auto& timer) { return reference(timer.node); }, "in `nodes`"},
       {"period_ns", kInteger, [](System, const auto& timer) { return number(timer.period_ns); }}}));
  tables.push_back(table_of("services", "", system, timeline.services, service_columns()));
  tables.push_back(table_of("clients", "", system, timeline.clients, service_columns()));
  tables.push_back(table_of<timeline::Executor>(
      "executors", "of a trace with the events of CARET, which alone tell of them", system, timeline.executors,
      {{"process", kInteger, [](System, const auto& executor) { return reference(executor.process); },
        "in `processes`"},
       {"kind", kText, [](System, const auto& executor) { return text(executor.kind); },
        "`single_threaded_executor`, `multi_threaded_executor`, `static_single_threaded_executor`"},
       {"address", kInteger, [](System, const auto& executor) { return number(executor.address); }}}));
  tables.push_back(table_of<timeline::CallbackGroup>(
      "callback_groups", "likewise", system, timeline.callback_groups,
      {{"executor", kInteger, [](System, const auto& group) { return reference(group.executor); }, "in `executors`"},
       {"kind", kText, [](System, const auto& group) { return text(group.kind); },
        "`mutually_exclusive`, `reentrant`"}}));
  tables.push_back(table_of<timeline::SimulatedTime>(
      "simulated_times", "likewise, with CARET's recorder of clocks: the time of nodes with `use_sim_time`", system,
      timeline.simulated_times,
      {{"time_ns", kInteger, [](System, const auto& time) { return number(time.time_ns); }},
       {"simulated_ns", kInteger, [](System, const auto& time) { return number(time.simulated_ns); }}}));
  tables.push_back(table_of("callbacks", "", system, timeline.callbacks, callback_columns()));
}

}  // namespace tracing
