// SPDX-License-Identifier: Apache-2.0
// What happened: callbacks, messages, calls, waits, states. A row for each time.
#include "tracing/model/timeline/state_name.hpp"
#include "tracing/show/tables/goals.hpp"
#include "tracing/show/tables/table_rows.hpp"

namespace tracing {

namespace {

using timeline::Call;
using timeline::Instance;
using timeline::kNone;
using timeline::Message;
using timeline::MessageDetail;
using System = const TracedSystem&;

Table instance_table(System system) {
  return table_of<Instance>(
      "callback_instances", "each run of a callback, by start", system, system.timeline.instances,
      {{"callback", kInteger, [](System, const Instance& instance) { return reference(instance.callback); },
        "in `callbacks`"},
       {"thread", kInteger, [](System, const Instance& instance) { return reference(instance.thread); },
        "in `threads`"},
       {"start_ns", kInteger, [](System, const Instance& instance) { return Cell{instance.start_ns}; }},
       {"duration_ns", kInteger,
        [](System, const Instance& instance) {
          return instance.finished ? Cell{instance.end_ns - instance.start_ns} : Cell{};
        },
        "`NULL`: it has no end in the trace"},
       {"intra_process", kInteger, [](System, const Instance& instance) { return number(instance.intra_process); },
        "1: its message came without the middleware"},
       {"message", kInteger, [](System, const Instance& instance) { return reference(instance.message); },
        "in `messages`: that it got"}});
}

// The parts of messages that MessageDetail has. Systems that were read without details have none.
const MessageDetail* detail_of(System system, const Message& message) {
  const auto place = static_cast<std::size_t>(&message - system.timeline.messages.data());
  const std::vector<MessageDetail>& details = system.timeline.details.messages;
  return place < details.size() ? &details[place] : nullptr;
}

template <std::int64_t MessageDetail::*kMember>
Cell detail_time(System system, const Message& message) {
  const MessageDetail* detail = detail_of(system, message);
  return detail == nullptr ? Cell{} : time(detail->*kMember);
}

Cell rclcpp_time(System system, const Message& message) {
  const MessageDetail* detail = detail_of(system, message);
  return detail != nullptr && detail->has_rclcpp ? Cell{message.called_ns} : Cell{};
}

template <bool MessageDetail::*kMember>
Cell detail_flag(System system, const Message& message) {
  const MessageDetail* detail = detail_of(system, message);
  return detail == nullptr ? Cell{} : number(detail->*kMember);
}

bool has_executor(const MessageDetail* detail, const Message& message) {
  return detail != nullptr && detail->waited_ns >= 0 && message.receiving_instance != kNone;
}

Cell callback_time(System system, const Message& message) {
  const bool delivered = message.receiving_instance != kNone;
  return delivered ? Cell{system.timeline.instances[message.receiving_instance].start_ns} : Cell{};
}

Table message_table(System system) {
  return table_of<Message>(
      "messages",
      "each message on its way to each subscription, by publication. One without its publication in the "
      "trace is not here",
      system, system.timeline.messages,
      {{"topic", kInteger, [](System, const Message& message) { return reference(message.topic); }, "in `topics`"},
       {"publisher", kInteger, [](System, const Message& message) { return reference(message.publisher); },
        "in `publishers`"},
       {"publishing_thread", kInteger,
        [](System, const Message& message) { return reference(message.publishing_thread); }, "in `threads`"},
       {"publishing_instance", kInteger,
        [](System, const Message& message) { return reference(message.publishing_instance); },
        "in `callback_instances`: in which it was published"},
       {"called_ns", kInteger, [](System, const Message& message) { return Cell{message.called_ns}; },
        "the call of `publish()`: the first publish function that is in the trace"},
       {"published_ns", kInteger, [](System, const Message& message) { return Cell{message.published_ns}; },
        "`rmw_publish`, or `rclcpp_intra_publish`"},
       {"subscription", kInteger, [](System, const Message& message) { return reference(message.subscription); },
        "in `subscriptions`"},
       {"taken_ns", kInteger, [](System, const Message& message) { return time(message.taken_ns); },
        "`rmw_take`, or taken out of the ring buffer; `NULL`: nobody took it, or it can't be told (`undecided` of the "
        "topic)"},
       {"receiving_instance", kInteger,
        [](System, const Message& message) { return reference(message.receiving_instance); },
        "in `callback_instances`: that got it"},
       {"callback_ns", kInteger, callback_time, "start of its callback"},
       {"repeated", kInteger, [](System, const Message& message) { return number(message.repeated); },
        "1: the row above has the same publication, taken by another subscription"},
       {"rclcpp_ns", kInteger, rclcpp_time, "`rclcpp_publish`"},
       {"rcl_ns", kInteger, detail_time<&MessageDetail::rcl_ns>, "`rcl_publish`"},
       {"written_ns", kInteger, detail_time<&MessageDetail::written_ns>, "`dds:write`, of middleware that records it"},
       {"intra_process", kInteger, detail_flag<&MessageDetail::intra_process>, "1: without the middleware"},
       {"estimated", kInteger, detail_flag<&MessageDetail::is_estimated>,
        "1: the trace has no timestamps of publications (ros2_tracing before 8.0). Which one it is was found by its "
        "time "
        "(`docs/analysis.md`)"},
       {"transport_ns", kInteger,
        [](System all, const Message& message) {
          const MessageDetail* detail = detail_of(all, message);
          return has_executor(detail, message) ? Cell{detail->waited_ns} : Cell{};
        },
        "part of the time from `published_ns` to `taken_ns`: on the way. `docs/report.md` explains the parts"},
       {"executor_ns", kInteger,
        [](System all, const Message& message) {
          const MessageDetail* detail = detail_of(all, message);
          return has_executor(detail, message) ? Cell{message.taken_ns - message.published_ns - detail->waited_ns}
                                               : Cell{};
        },
        "likewise: waiting for the executor"}});
}

Table call_table(System system) {
  return table_of<Call>(
      "calls", "each request to a service, by begin. What the trace does not hold is `NULL`", system,
      system.timeline.details.calls,
      {{"client", kInteger, [](System, const Call& call) { return reference(call.client); }, "in `clients`"},
       {"service", kInteger, [](System, const Call& call) { return reference(call.service); }, "in `services`"},
       {"sent_ns", kInteger, [](System, const Call& call) { return time(call.sent_ns); }, "`rmw_send_request`"},
       {"taken_ns", kInteger, [](System, const Call& call) { return time(call.taken_ns); }, "`rmw_take_request`"},
       {"answered_ns", kInteger, [](System, const Call& call) { return time(call.answered_ns); },
        "`rmw_send_response`"},
       {"received_ns", kInteger, [](System, const Call& call) { return time(call.received_ns); },
        "`rmw_take_response`"}});
}

Table goal_table(System system) {
  return {"goals",
          "each goal of an action, by begin. A goal has no identity in the trace: its result is that which the client "
          "asks for after this answer and before the next one",
          {{"id"},
           {"action", kText, "its name"},
           {"client", kInteger, "in `nodes`"},
           {"server", kInteger, "in `nodes`"},
           {"sent_ns", kInteger, "the goal"},
           {"answered_ns", kInteger, "the client has the answer: accepted or not"},
           {"asked_ns", kInteger, "the client asks for the result; `NULL`: rejected, or not wanted"},
           {"result_ns", kInteger, "it has the result"},
           {"goal_call", kInteger, "in `calls`"},
           {"result_call", kInteger, "in `calls`"}},
          [&system](const Emit& emit) {
            std::int64_t id = 0;
            for (const Goal& goal : goals_of(system.timeline)) {
              emit({id++, std::string_view(goal.action), reference(goal.client), reference(goal.server),
                    time(goal.sent_ns), time(goal.answered_ns), time(goal.asked_ns), time(goal.result_ns),
                    reference(goal.goal_call), reference(goal.result_call)});
            }
          }};
}

Table lifecycle_table(System system) {
  using timeline::LifecycleState;
  return table_of<LifecycleState>(
      "lifecycle_states", "each stay of a lifecycle node in a state", system, system.timeline.lifecycle,
      {{"node", kInteger, [](System, const LifecycleState& stay) { return reference(stay.node); }, "in `nodes`"},
       {"state", kText, [](System, const LifecycleState& stay) { return Cell{std::string_view(stay.state)}; }},
       {"begin_ns", kInteger, [](System, const LifecycleState& stay) { return Cell{stay.begin_ns}; }},
       {"end_ns", kInteger, [](System, const LifecycleState& stay) { return Cell{stay.end_ns}; },
        "of the last one: the end of the node's state machine, or of the trace"}});
}

Table state_table(System system) {
  using timeline::ThreadState;
  return table_of<ThreadState>(
      "thread_states",
      "what a thread did on the machine; from its first callback or publication on. Empty without events of the "
      "kernel's scheduler",
      system, system.timeline.states,
      {{"thread", kInteger, [](System, const ThreadState& state) { return reference(state.thread); }, "in `threads`"},
       {"state", kText,
        [](System, const ThreadState& state) { return Cell{std::string_view(timeline::state_name(state.state))}; },
        "`running`, `runnable` (it waited for a processor), `blocked`"},
       {"begin_ns", kInteger, [](System, const ThreadState& state) { return Cell{state.begin_ns}; }},
       {"end_ns", kInteger, [](System, const ThreadState& state) { return Cell{state.end_ns}; }},
       {"cpu", kInteger, [](System, const ThreadState& state) { return number(state.cpu); },
        "where it ran; of `runnable` and `blocked`: where it waited, the one that it was woken for, or had last"},
       {"other_tid", kInteger,
        [](System all, const ThreadState& state) {
          return state.other == kNone ? Cell{} : Cell{all.timeline.other_threads[state.other].tid};
        },
        "of `runnable`: the thread that had the processor longest"},
       {"other_name", kText,
        [](System all, const ThreadState& state) {
          return state.other == kNone ? Cell{} : Cell{std::string_view(all.timeline.other_threads[state.other].name)};
        },
        "likewise"}});
}

}  // namespace

void add_event_tables(const TracedSystem& system, std::vector<Table>& tables) {
  using timeline::InstanceMemory;
  using timeline::Wait;
  tables.push_back(instance_table(system));
  tables.push_back(table_of<InstanceMemory>(
      "allocations",
      "memory that runs of callbacks asked for, with events of `lttng_ust_libc`; runs that asked for none are left out",
      system, system.timeline.details.memory,
      {{"callback_instance", kInteger, [](System, const InstanceMemory& memory) { return reference(memory.instance); },
        "in `callback_instances`"},
       {"allocations", kInteger, [](System, const InstanceMemory& memory) { return number(memory.calls); },
        "calls that ask for memory, not those of callbacks that ran within"},
       {"allocated_bytes", kInteger, [](System, const InstanceMemory& memory) { return number(memory.bytes); }}}));
  tables.push_back(message_table(system));
  tables.push_back(call_table(system));
  tables.push_back(goal_table(system));
  tables.push_back(table_of<Wait>(
      "executor_waits", "each time that a thread of an executor waited for work, by begin", system,
      system.timeline.details.waits,
      {{"thread", kInteger, [](System, const Wait& wait) { return reference(wait.thread); }, "in `threads`"},
       {"begin_ns", kInteger, [](System, const Wait& wait) { return Cell{wait.begin_ns}; },
        "`rclcpp_executor_wait_for_work`"},
       {"end_ns", kInteger, [](System, const Wait& wait) { return Cell{wait.end_ns}; },
        "`rclcpp_executor_get_next_ready`"}}));
  tables.push_back(lifecycle_table(system));
  tables.push_back(state_table(system));
}

}  // namespace tracing
