// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/session/overhead_watch.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tracing/record/account/cost_measurement.hpp"
#include "tracing/record/account/event_cuts.hpp"
#include "tracing/record/launch_provider/launch_provider.h"
#include "tracing/record/plan/trace_error.hpp"

namespace tracing {

namespace {

// The library also holds the launcher's other events, see LaunchTracepoints. dlopen() gives the same library again.
void put_into_trace(const std::string& prefix, const EventCut& cut) {
  void* const library = ::dlopen((prefix + "/lib/launch/liblaunch_trace.so").c_str(), RTLD_NOW | RTLD_LOCAL);
  void* const function = library != nullptr ? ::dlsym(library, "launch_trace_cut") : nullptr;
  if (function == nullptr) {
    return;
  }
  const std::string events = fmt::format("{}", fmt::join(cut.events, " "));
  const launch_trace_cut_event event = {.time = cut.time,
                                        .event_class = cut.event_class.c_str(),
                                        .events = events.c_str(),
                                        .rate = cut.rate,
                                        .share = cut.share};
  reinterpret_cast<launch_trace_cut_function>(function)(&event);
}

std::string describe_cut(const EventCut& cut, double budget) {
  const std::string what = cut.event_class.empty() ? "there is nothing left to drop"
                                                   : fmt::format("events '{}' are no longer recorded: {}",
                                                                 cut.event_class, fmt::join(cut.events, " "));
  return fmt::format("{} events a second cost {:.2f} % of a processor, more than max-overhead {:g} %: {}", cut.rate,
                     100 * cut.share, 100 * budget, what);
}

}  // namespace

std::unique_ptr<OverheadGuard> watch_overhead(const TraceConfig& config, const std::string& prefix,
                                              const std::function<void(bool warning, const std::string& text)>& tell) {
  if (config.event_counters.empty()) {
    throw TraceError("max-overhead needs shared memory to count events in",
                     "make /dev/shm writable, or leave max-overhead out");
  }
  const double cost = event_cost(config.context_fields_ust).ns_per_event;
  return std::make_unique<OverheadGuard>(config, cost,
                                         [tell, prefix, budget = config.max_overhead](const EventCut& cut) {
                                           if (!cut.event_class.empty()) {
                                             put_into_trace(prefix, cut);
                                           }
                                           tell(true, describe_cut(cut, budget));
                                         });
}

}  // namespace tracing
