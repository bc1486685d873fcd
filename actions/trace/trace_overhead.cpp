// SPDX-License-Identifier: Apache-2.0
#include "actions/trace/trace_overhead.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/visit/launch_context.hpp"
#include "tracing/record/account/cost_measurement.hpp"
#include "tracing/record/account/event_cuts.hpp"
#include "tracing/record/launch_provider/launch_provider.h"
#include "tracing/record/plan/event_classes.hpp"
#include "tracing/record/plan/trace_config.hpp"
#include "tracing/record/plan/trace_error.hpp"

namespace launch {

namespace {

// The library also holds the launcher's other events, see LaunchTracepoints. dlopen() gives the same library again.
void put_into_trace(const std::string& prefix, const tracing::EventCut& cut) {
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

std::string describe(const tracing::EventCut& cut, double budget) {
  const std::string what = cut.event_class.empty() ? "there is nothing left to drop"
                                                   : fmt::format("events '{}' are no longer recorded: {}",
                                                                 cut.event_class, fmt::join(cut.events, " "));
  return fmt::format("{} events a second cost {:.2f} % of a processor, more than max-overhead {:g} %: {}", cut.rate,
                     100 * cut.share, 100 * budget, what);
}

}  // namespace

double perform_percentage(const Template& text, Scope& scope) {
  const std::string given = text.perform(scope);
  double percent = 0;
  const char* const end = given.data() + given.size();
  const auto read = std::from_chars(given.data(), end, percent);
  if (read.ec != std::errc() || std::string_view(read.ptr, end) != "%" || !(percent > 0)) {
    throw LaunchError(
        fmt::format("max-overhead is expected to be a percentage of a processor like 2%, got '{}'", given),
        text.where());
  }
  return percent / 100;
}

void check_drop_order(const std::vector<std::string>& order, const SourceRange& where) {
  const std::vector<std::string>& known = tracing::droppable_classes();
  for (const std::string& name : order) {
    if (name.find(':') == std::string::npos && std::find(known.begin(), known.end(), name) == known.end()) {
      throw LaunchError(fmt::format("there is no class of events '{}'", name), where,
                        fmt::format("drop-order takes {}, or events as PROVIDER:NAME", fmt::join(known, ", ")));
    }
  }
}

std::unique_ptr<tracing::OverheadGuard> watch_overhead(const tracing::TraceConfig& config, const std::string& prefix,
                                                       EventLoop& loop, const RunScope::Tell& tell) {
  if (config.event_counters.empty()) {
    throw tracing::TraceError("max-overhead needs shared memory to count events in",
                              "make /dev/shm writable, or leave max-overhead out");
  }
  const double cost = tracing::event_cost(config.context_fields_ust).ns_per_event;
  return std::make_unique<tracing::OverheadGuard>(
      config, cost, [&loop, tell, prefix, budget = config.max_overhead](const tracing::EventCut& cut) {
        if (!cut.event_class.empty()) {
          put_into_trace(prefix, cut);
        }
        loop.post([tell, text = describe(cut, budget)] { tell(true, text); });
      });
}

}  // namespace launch
