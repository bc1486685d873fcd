// SPDX-License-Identifier: Apache-2.0
// The kinds of findings of a report: what programs and people call them, and the reasoning behind each.
#pragma once

#include <array>
#include <iterator>

namespace tracing {

enum class FindingKind {
  kSlowestChain,
  kOverBudget,  // a chain that took longer than its budget
  kOverrun,     // a timer whose callback took longer than its period
  kWorstJitter,
  kBusiestExecutor,
  kDroppedMessages,
  kLongestWait,      // of messages for an executor
  kLongTail,         // a callback that sometimes takes many times as long as usually
  kUnanswered,       // requests
  kUnfinished,       // callbacks that were left by an exception
  kStarvedCallback,  // it waited for a processor
  kSlowestStart,
  kMemoryInActive,      // a lifecycle node asks for memory in its active state
  kDriftingTimer,       // it is usually called too late or too early, without having missed a period
  kDominatingCallback,  // it takes a large part of the time of its thread
  kBlockingCallback,    // others of its thread are due and wait for it
};

// In the order of FindingKind.
struct FindingWords {
  const char* name;         // for programs
  const char* title;        // for people
  const char* explanation;  // what is compared with what, what it means, and what helps
};

inline constexpr FindingWords kFindingWords[] = {
    {"slowest_chain", "Slowest chain",
     "The chain without a budget whose response is the longest, if half of its inputs take 10 ms and more, and its "
     "callbacks and their waits for an executor do, too: what waits for the period of a timer is no fault. The "
     "response "
     "runs from the begin of the first callback to the end of the last one. launch report DIR --chain A B shows its "
     "steps: the time in each callback, on the way and in the wait for the executor. A <chain> with a budget in the "
     "<trace> of the launch file says how long it may take; then only what exceeds the budget is a finding."},
    {"over_budget", "Over budget",
     "The chain of the launch file whose responses exceed its budget most often. launch report DIR --chain A B shows "
     "where its time goes; the callback or the wait that takes most is where to begin."},
    {"overrun", "Over period",
     "The timer whose callback takes longer than its period most often: in 1 % of its runs, and five times or in a "
     "fourth of them. Such a timer misses periods. Shorten the callback, give the timer a longer period, or let its "
     "work be done elsewhere."},
    {"worst_jitter", "Worst jitter",
     "The timer that is farthest off its period for its length: by 10 % and 0.1 ms, or it has missed five periods and "
     "1 % of them. The limit is held against the 99th percentile of 500 intervals and more, the 90th of 50 and more, "
     "else the median, so that one stall of the machine is no finding. If a callback of the same thread ran meanwhile, "
     "the finding is about that one instead (blocking_callback). Otherwise the thread did not get a processor: record "
     "the events of the kernel's scheduler (events-kernel=\"sched_switch sched_wakeup sched_waking\"), and give the "
     "process a priority or processors of its own (cpus)."},
    {"busiest_executor", "Busiest executor",
     "The thread that waits for work for the smallest part of the time, from 50 % busy on. What arrives at a busy "
     "thread waits. Give some of its nodes an executor of their own, for example component_container_isolated, or use "
     "several threads."},
    {"dropped_messages", "Dropped messages",
     "The subscription that missed most messages of publishers from which it got others, and the place where they got "
     "lost. Pushed out of its queue or buffer: it is read too seldom, so give it a longer queue or shorten what its "
     "thread does. Lost by the publisher: its queue is too short for messages that must be repeated. Lost in "
     "transport: "
     "one side is best effort; make both reliable, or raise the buffers of the network (net.core.rmem_max). What a "
     "content filter holds back is no loss."},
    {"longest_wait", "Longest wait",
     "The subscription whose messages wait longest for a busy executor: 1 ms and more. The limit is held against the "
     "99th percentile of 500 messages and more, the 90th of 50 and more, else the median. If one callback of the same "
     "thread is what they wait for, the finding is about that one instead (blocking_callback)."},
    {"long_tail", "Rare slowness",
     "The callback that sometimes takes ten times as long as usually, and 1 ms or more: its 99th percentile if it ran "
     "500 times and more, else its 90th. launch report DIR --html FILE shows each run; events of the kernel's "
     "scheduler "
     "say whether it worked, was blocked, or waited for a processor."},
    {"unanswered", "No response",
     "The client with the largest part of requests without a response. Requests that were on their way when the trace "
     "or the client ended do not count. Is the service there in time, does its callback return, does the client spin?"},
    {"unfinished", "No end",
     "The callback that most often began without an end: an exception left it, or events were lost."},
    {"starved_callback", "No processor",
     "The callback that waited longest for a processor, 1 ms or more, and the thread that had it meanwhile. Needs "
     "events "
     "of the kernel's scheduler. Give one of them a priority, or processors of its own (cpus)."},
    {"slowest_start", "Slowest start",
     "The process that took longest from its exec until an executor looked for work, from 3 s on. launch report DIR "
     "--all shows the phases of each start, and what the start of the whole system had to wait for."},
    {"memory_in_active", "Memory in active",
     "The lifecycle node whose callbacks ask for memory most often while it is active. Real-time systems ask for "
     "memory "
     "before, when they are configured: an allocation may take a lock or a system call. Needs the events of "
     "lttng_ust_libc. launch report DIR --all lists the calls of each callback (mallocs)."},
    {"drifting_timer", "Drifting timer",
     "The timer that misses no period, and whose median interval is 1 % and 0.05 ms or more off its period. A timer "
     "that is set anew in its callback (reset, or another one-shot timer) adds the time of the callback to each "
     "period; rclcpp's timers do not drift by themselves."},
    {"dominating_callback", "Dominating",
     "The callback that takes the largest part of the time of a thread, from 30 % on. Nothing else of its thread runs "
     "meanwhile. Shorten it, call it less often, or give its node an executor of its own."},
    {"blocking_callback", "Blocking",
     "The callback for which others of its thread wait: a timer that is due, or a subscription whose message is there. "
     "It is named if it has held up one of them five times and in 1 % of its calls, by 1 ms on average, and a timer by "
     "5 % "
     "of its period. What the others suffer, such as missed periods and long waits, is told here and not "
     "once more. Give the callback a group of its own and an executor with several threads, give its node an executor "
     "of its own, or shorten it."},
};

inline constexpr auto kFindingNames = [] {
  std::array<const char*, std::size(kFindingWords)> names{};
  for (std::size_t i = 0; i < names.size(); ++i) {
    names[i] = kFindingWords[i].name;
  }
  return names;
}();

}  // namespace tracing
