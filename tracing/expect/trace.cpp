// SPDX-License-Identifier: Apache-2.0
#include "launch_trace_testing/trace.hpp"

#include <fmt/format.h>

#include <ostream>
#include <set>
#include <utility>

#include "tracing/expect/event_table.hpp"
#include "tracing/expect/trace_store.hpp"

namespace launch_trace_testing {

Trace::Trace() : store_(std::make_shared<const TraceStore>()) {}

Trace::Trace(const std::filesystem::path& directory, const ReadOptions& options)
    : Trace(std::vector{directory}, options) {}

Trace::Trace(const std::vector<std::filesystem::path>& directories, const ReadOptions& options)
    : store_(std::make_shared<const TraceStore>(directories, options)) {}

const std::vector<Event>& Trace::events() const {
  return store_->events;
}

const std::vector<Loss>& Trace::losses() const {
  return store_->losses;
}

const std::vector<std::string>& Trace::damage() const {
  return store_->damage;
}

const std::vector<std::filesystem::path>& Trace::directories() const {
  return store_->directories;
}

const std::vector<CallbackRun>& Trace::callbacks() const {
  return store_->callbacks;
}

const std::vector<Delivery>& Trace::deliveries() const {
  return store_->deliveries;
}

std::int64_t Trace::begin_ns() const {
  return empty() ? 0 : events().front().time_ns();
}

std::int64_t Trace::end_ns() const {
  return empty() ? 0 : events().back().time_ns();
}

std::string to_string(const Trace& trace) {
  std::set<std::pair<std::string, std::int64_t>> processes;
  for (const Event& event : trace) {
    processes.emplace(event.host(), event.vpid());
  }
  return fmt::format("a trace with {} of {}", counted(trace.size(), "event"), counted(processes.size(), "process"));
}

std::ostream& operator<<(std::ostream& stream, const Trace& trace) {
  return stream << to_string(trace);
}

void PrintTo(const Trace& trace, std::ostream* stream) {
  *stream << trace;
}

}  // namespace launch_trace_testing
