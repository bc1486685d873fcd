// SPDX-License-Identifier: Apache-2.0
// The results of the report as tables: sums and distributions of the whole trace.
#include "tracing/show/tables/table_rows.hpp"

namespace tracing {

void add_statistics_tables(const TracedSystem& system, std::vector<Table>& tables) {
  const Ros2Results& results = system.results.ros2;
  const ColumnOf<CallbackResult> callback{
      "callback", kInteger, [](const TracedSystem&, const CallbackResult& result) { return number(result.id); },
      "in `callbacks`"};
  tables.push_back(result_table("callback_statistics", "callbacks that ran", system, results.callbacks, {callback}));
  tables.push_back(result_table("topic_statistics", "", system, results.topics));
  tables.push_back(
      result_table("subscription_statistics",
                   "what became of the messages for each subscription: where they got lost, and where time went",
                   system, results.subscriptions));
  tables.push_back(
      result_table("call_statistics", "one row for each client and the service that it called", system, results.calls));
  tables.push_back(result_table("actions", "one row for each action and client that it has", system, results.actions));
  tables.push_back(result_table("node_statistics", "", system, results.nodes));
  tables.push_back(result_table("executor_statistics", "threads that ran callbacks", system, results.executors));
  tables.push_back(result_table("execution_statistics",
                                "services, clients and waitables that executors served, from events of `ros2_ext`",
                                system, results.executions));
  tables.push_back(result_table("lifecycle_statistics",
                                "the stays of lifecycle nodes in their states, with the memory "
                                "that they asked for",
                                system, results.lifecycle));
  tables.push_back(
      result_table("unmatched", "events without the event that belongs to them", system, results.unmatched));
}

}  // namespace tracing
