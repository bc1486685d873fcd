// SPDX-License-Identifier: Apache-2.0
// The parts of find_worth_a_look(): each looks for one kind of findings, in any order. What several of them need.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tracing/model/analysis/results.hpp"
#include "tracing/model/findings/finding.hpp"
#include "tracing/model/findings/hosts.hpp"

namespace tracing {

using Findings = std::vector<Finding>;

Findings slow_chains(const TraceResults& results);
Findings exceeded_budgets(const TraceResults& results);
Findings busy_executors(const TraceResults& results);
Findings slow_starts(const TraceResults& results);
Findings memory_in_active(const TraceResults& results);

Findings overruns(const TraceResults& results);
Findings late_timers(const TraceResults& results);
Findings drifting_timers(const TraceResults& results);
Findings dominating_callbacks(const TraceResults& results);
Findings blocking_callbacks(const TraceResults& results);
Findings long_tails(const TraceResults& results);
Findings unfinished_callbacks(const TraceResults& results);
Findings starved_callbacks(const TraceResults& results);

Findings dropped_messages(const TraceResults& results);
Findings waiting_messages(const TraceResults& results);
Findings unanswered_requests(const TraceResults& results);

// A value that at least five others reach, if there are enough: p99 of 500 and more, p90 of 50 and more, else p50. One
// stall of the machine does not move it.
std::int64_t usual_worst(const DurationSummary& times);

// At most `most`, and a little of that, less than 1, by how great the value is: so the greatest of those that reach the
// most is named first.
double at_most(double most, double weight, double value);

// "1.20 ms"
std::string duration(std::int64_t nanoseconds);
// " (events were lost)", " (an estimate)", both, or nothing
std::string mark(bool doubtful, bool estimated = false);
// "left: /ping, timer 100 ms" if there are several machines
std::string label(const Hosts& hosts, const CallbackResult& callback);
// "/ping, timer 100 ms (Ping::send())"
std::string place_in_source(const CallbackResult& callback);
// Null if there is none.
const CallbackResult* find_callback(const TraceResults& results, std::uint32_t id);
// The callback of a subscription; null if there is none, as for clients of actions.
const CallbackResult* callback_of(const TraceResults& results, const SubscriptionResult& subscription);

}  // namespace tracing
