// SPDX-License-Identifier: Apache-2.0
// What is known of a callback.
#pragma once

#include "tracing/model/analysis/results/overview.hpp"
#include "tracing/model/objects/callback_symbol.hpp"

namespace tracing {

struct CallbackResult {
  enum class Owner { kUnknown, kSubscription, kTimer, kService, kClient };
  std::uint32_t id = 0;  // ObjectId: index in ObjectModel::callbacks()
  ProcessIndex process = 0;
  std::string node;
  Owner owner = Owner::kUnknown;
  std::string owner_name;  // topic or service, for a client the service that it asks; empty for timers
  std::int64_t period_ns = 0;
  std::uint64_t address = 0;
  std::string symbol;
  DurationSummary durations;
  std::uint64_t intra_process = 0;
  std::uint64_t unfinished = 0;
  double rate_hz = 0;
  DurationSummary interval;
  DurationSummary jitter;
  std::uint64_t missed = 0;
  std::uint64_t overruns = 0;
  std::optional<std::uint64_t> allocations;
  std::uint64_t allocated_bytes = 0;
  DurationSummary running;
  DurationSummary runnable;
  DurationSummary blocked;
  std::int64_t longest_runnable_ns = 0;
  std::string ran_instead;
  std::int64_t ran_instead_ns = 0;
  std::optional<std::uint32_t> held_up_by_id;  // as `id`
  std::string held_up_by;
  std::uint64_t held_up = 0;
  std::int64_t held_up_ns = 0;
  bool doubtful = false;

  const char* owner_word() const;
  bool is_of_subscription() const { return owner == Owner::kSubscription; }
  bool is_of_service() const { return owner == Owner::kService || owner == Owner::kClient; }
  bool is_of_timer() const { return owner == Owner::kTimer; }
  std::string brief_symbol() const { return short_symbol(symbol); }
  bool has_thread_states() const { return running.count > 0; }

  static const Field<CallbackResult> kFields[];
};

// In the order of CallbackResult::Owner.
inline constexpr const char* kOwnerNames[] = {"unknown", "subscription", "timer", "service", "client"};

constexpr const char* owner_name(CallbackResult::Owner owner) {
  return kOwnerNames[static_cast<std::size_t>(owner)];
}

inline const char* CallbackResult::owner_word() const {
  return tracing::owner_name(owner);
}

inline constexpr Field<CallbackResult> CallbackResult::kFields[] = {
    {"process", &CallbackResult::process, "index in `processes`", trait::kProcess},
    {"node", &CallbackResult::node, ""},
    {"owner", {&CallbackResult::owner_word, kOwnerNames}, "what calls it"},
    {"topic", &CallbackResult::owner_name, "of a subscription", trait::kPlain, &CallbackResult::is_of_subscription},
    {"service", &CallbackResult::owner_name, "of a service, or that a client calls", trait::kPlain,
     &CallbackResult::is_of_service},
    {"period_ns", &CallbackResult::period_ns, "of a timer", trait::kPlain, &CallbackResult::is_of_timer},
    {"address", &CallbackResult::address, ""},
    {"symbol", &CallbackResult::symbol, "the function, in readable form"},
    {"duration", &CallbackResult::durations, "of the instances that have a start and an end"},
    {"intra_process", &CallbackResult::intra_process, "how many of these got their message from within the process"},
    {"unfinished", &CallbackResult::unfinished,
     "instances without an end: an exception, a killed process, or still running"},
    {"rate_hz", &CallbackResult::rate_hz,
     "begins in a second, from the first to the last one; 0 for a single one and for a burst (`docs/report.md`)"},
    {"interval", &CallbackResult::interval, "from one begin to the next"},
    {"jitter", &CallbackResult::jitter, "of a timer: how far the intervals are from the period, either way",
     trait::kPlain, &CallbackResult::is_of_timer},
    {"missed", &CallbackResult::missed, "of a timer: periods without a call", trait::kPlain,
     &CallbackResult::is_of_timer},
    {"overruns", &CallbackResult::overruns, "of a timer: runs that took longer than the period", trait::kPlain,
     &CallbackResult::is_of_timer},
    {"short_symbol", &CallbackResult::brief_symbol, "class and function of `symbol`"},
    {"allocations", &CallbackResult::allocations,
     "calls that ask for memory; `null` without events of `lttng_ust_libc`"},
    {"allocated_bytes", &CallbackResult::allocated_bytes, ""},
    {"running", &CallbackResult::running,
     "with events of the kernel's scheduler: the part of the durations in which the thread had a processor",
     trait::kPlain, &CallbackResult::has_thread_states},
    {"runnable", &CallbackResult::runnable, "likewise, in which it waited for one", trait::kPlain,
     &CallbackResult::has_thread_states},
    {"blocked", &CallbackResult::blocked, "likewise, in which it waited for something else", trait::kPlain,
     &CallbackResult::has_thread_states},
    {"longest_runnable_ns", &CallbackResult::longest_runnable_ns, "the longest wait for a processor without a break",
     trait::kPlain, &CallbackResult::has_thread_states},
    {"ran_instead", &CallbackResult::ran_instead, "the thread that had the processor for most of that time",
     trait::kPlain, &CallbackResult::has_thread_states},
    {"ran_instead_ns", &CallbackResult::ran_instead_ns, "for how long", trait::kPlain,
     &CallbackResult::has_thread_states},
    {"held_up_by", &CallbackResult::held_up_by,
     "the callback of the same thread that ran for most of the time in which this one was due: its timer, or a "
     "message; "
     "empty: none"},
    {"held_up", &CallbackResult::held_up, "how many of its calls that callback held up"},
    {"held_up_ns", &CallbackResult::held_up_ns, "for how long in all"},
    {"doubtful", &CallbackResult::doubtful, "its process may have lost events"},
};

}  // namespace tracing
