// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/export/tables.hpp"

#include <functional>
#include <optional>
#include <string>
#include <type_traits>

#include "tracing/model/timeline/state_name.hpp"

namespace tracing {

namespace {

using timeline::Index;
using timeline::kNone;
using timeline::Timeline;
using Emit = std::function<void(const Row&)>;

constexpr bool kText = true;

Cell reference(Index index) {
  return index == kNone ? Cell{} : Cell{std::int64_t{index}};
}

Cell number(std::uint64_t value) {
  return static_cast<std::int64_t>(value);
}

Cell text_or_null(std::string_view text) {
  return text.empty() ? Cell{} : Cell{text};
}

Cell optional(const std::optional<std::int64_t>& value) {
  return value ? Cell{*value} : Cell{};
}

Table trace_table(const TracedSystem& system) {
  return {
      "trace",
      {{"directory", kText}, {"begin_ns"}, {"end_ns"}, {"events"}, {"lost_events"}, {"lost_packets"}, {"error", kText}},
      [&system](const Emit& emit) {
        const TraceOverview& overview = system.results.overview;
        emit({std::string_view(system.directory.native()), optional(overview.begin_ns), optional(overview.end_ns),
              number(overview.events), number(overview.lost_events()), number(overview.lost_packets()),
              text_or_null(system.error)});
      }};
}

// For each list of objects: a row for each, which begins with its index.
template <class Object, class Cells>
Table object_table(std::string_view name, std::vector<Column> columns, const std::vector<Object>& objects,
                   Cells cells) {
  columns.insert(columns.begin(), {"id"});
  return {name, std::move(columns), [&objects, cells](const Emit& emit) {
            for (std::size_t id = 0; id < objects.size(); ++id) {
              Row row = cells(objects[id]);
              row.insert(row.begin(), number(id));
              emit(row);
            }
          }};
}

// Cells are texts and integers. A field of another type has no place in a table: trait::kNotInTables.
Cell cell_of(const std::string& text) {
  return std::string_view(text);
}
Cell cell_of(const std::optional<std::int64_t>& value) {
  return optional(value);
}
template <class Value>
Cell cell_of(const Value& value) {
  if constexpr (std::is_integral_v<Value>) {
    return static_cast<std::int64_t>(value);
  } else {
    return {};
  }
}

// For each list of results that has no names for other tables to refer to: a column for each field.
template <class Result>
Table result_table(std::string_view name, const std::vector<Result>& results) {
  std::vector<Column> columns;
  for (const Field<Result>& field : Result::kFields) {
    if (!field.has(trait::kNotInTables)) {
      columns.push_back({field.name, field.member.is_text()});
    }
  }
  return object_table(name, std::move(columns), results, [](const Result& result) {
    Row row;
    for (const Field<Result>& field : Result::kFields) {
      if (!field.has(trait::kNotInTables)) {
        field.member.visit([&](auto member) { row.push_back(cell_of(std::invoke(member, result))); });
      }
    }
    return row;
  });
}

std::vector<Table> object_tables(const Timeline& timeline) {
  const auto endpoint = [](const timeline::Endpoint& end) { return Row{reference(end.node), reference(end.topic)}; };
  return {
      object_table("processes", {{"vpid"}, {"name", kText}, {"host", kText}}, timeline.processes,
                   [](const timeline::Process& process) {
                     return Row{process.vpid, std::string_view(process.name), text_or_null(process.host)};
                   }),
      object_table("threads", {{"process"}, {"vtid"}}, timeline.threads,
                   [](const timeline::Thread& thread) {
                     return Row{reference(thread.process), thread.vtid};
                   }),
      object_table("nodes", {{"process"}, {"name", kText}}, timeline.nodes,
                   [](const timeline::Node& node) {
                     return Row{reference(node.process), std::string_view(node.name)};
                   }),
      object_table("topics", {{"name", kText}}, timeline.topics,
                   [](const std::string& topic) { return Row{std::string_view(topic)}; }),
      object_table("publishers", {{"node"}, {"topic"}}, timeline.publishers, endpoint),
      object_table("subscriptions", {{"node"}, {"topic"}}, timeline.subscriptions, endpoint),
      object_table("callbacks",
                   {{"process"},
                    {"node"},
                    {"kind", kText},
                    {"topic"},
                    {"service", kText},
                    {"period_ns"},
                    {"address"},
                    {"symbol", kText}},
                   timeline.callbacks,
                   [](const timeline::Callback& callback) {
                     const bool timer = callback.owner == CallbackResult::Owner::kTimer;
                     return Row{reference(callback.process),
                                reference(callback.node),
                                std::string_view(owner_name(callback.owner)),
                                reference(callback.topic),
                                text_or_null(callback.service),
                                timer ? Cell{callback.period_ns} : Cell{},
                                number(callback.address),
                                text_or_null(callback.symbol)};
                   }),
  };
}

Table instance_table(const Timeline& timeline) {
  return object_table("callback_instances",
                      {{"callback"}, {"thread"}, {"start_ns"}, {"duration_ns"}, {"intra_process"}, {"message"}},
                      timeline.instances, [](const timeline::Instance& instance) {
                        return Row{reference(instance.callback),
                                   reference(instance.thread),
                                   instance.start_ns,
                                   instance.finished ? Cell{instance.end_ns - instance.start_ns} : Cell{},
                                   number(instance.intra_process ? 1 : 0),
                                   reference(instance.message)};
                      });
}

Table message_table(const Timeline& timeline) {
  return object_table("messages",
                      {{"topic"},
                       {"publisher"},
                       {"publishing_thread"},
                       {"publishing_instance"},
                       {"called_ns"},
                       {"published_ns"},
                       {"subscription"},
                       {"taken_ns"},
                       {"receiving_instance"},
                       {"callback_ns"},
                       {"repeated"}},
                      timeline.messages, [&timeline](const timeline::Message& message) {
                        const bool taken = message.taken_ns != 0;
                        const bool delivered = message.receiving_instance != kNone;
                        return Row{reference(message.topic),
                                   reference(message.publisher),
                                   reference(message.publishing_thread),
                                   reference(message.publishing_instance),
                                   message.called_ns,
                                   message.published_ns,
                                   reference(message.subscription),
                                   taken ? Cell{message.taken_ns} : Cell{},
                                   reference(message.receiving_instance),
                                   delivered ? Cell{timeline.instances[message.receiving_instance].start_ns} : Cell{},
                                   number(message.repeated ? 1 : 0)};
                      });
}

Table lifecycle_table(const Timeline& timeline) {
  return object_table(
      "lifecycle_states", {{"node"}, {"state", kText}, {"begin_ns"}, {"end_ns"}}, timeline.lifecycle,
      [](const timeline::LifecycleState& interval) {
        return Row{reference(interval.node), std::string_view(interval.state), interval.begin_ns, interval.end_ns};
      });
}

Table state_table(const Timeline& timeline) {
  return object_table(
      "thread_states",
      {{"thread"}, {"state", kText}, {"begin_ns"}, {"end_ns"}, {"cpu"}, {"other_tid"}, {"other_name", kText}},
      timeline.states, [&timeline](const timeline::ThreadState& state) {
        Row row{reference(state.thread),
                std::string_view(timeline::state_name(state.state)),
                state.begin_ns,
                state.end_ns,
                std::int64_t{state.cpu},
                {},
                {}};
        if (state.other != kNone) {
          row[5] = timeline.other_threads[state.other].tid;
          row[6] = std::string_view(timeline.other_threads[state.other].name);
        }
        return row;
      });
}

std::vector<Table> result_tables(const TraceResults& results) {
  return {
      result_table("starts", results.starts),
      result_table("losses", results.overview.losses),
      {"event_counts",
       {{"vpid"}, {"event", kText}, {"events"}},
       [&overview = results.overview](const Emit& emit) {
         for (const EventCount& event : overview.event_counts) {
           if (event.name.starts_with("launch:")) {
             emit({Cell(), std::string_view(event.name), number(event.total)});
           }
           for (std::size_t process = 0; process < event.by_process.size(); ++process) {
             if (event.by_process[process] == 0) {
               continue;
             }
             emit({optional(overview.processes[process].vpid), std::string_view(event.name),
                   number(event.by_process[process])});
           }
         }
       }},
  };
}

}  // namespace

std::vector<Table> tables_of(const TracedSystem& system) {
  std::vector<Table> tables{trace_table(system)};
  for (Table& table : object_tables(system.timeline)) {
    tables.push_back(std::move(table));
  }
  tables.push_back(instance_table(system.timeline));
  tables.push_back(message_table(system.timeline));
  tables.push_back(lifecycle_table(system.timeline));
  tables.push_back(state_table(system.timeline));
  for (Table& table : result_tables(system.results)) {
    tables.push_back(std::move(table));
  }
  return tables;
}

}  // namespace tracing
