// SPDX-License-Identifier: Apache-2.0
// Reads a trace into memory. Private to the library.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "launch_trace_testing/trace.hpp"
#include "tracing/model/analysis/trace_analysis.hpp"
#include "tracing/model/timeline/timeline.hpp"

namespace launch_trace_testing {

class TraceStore {
 public:
  TraceStore() = default;
  TraceStore(const std::vector<std::filesystem::path>& directories, const ReadOptions& options);

  std::vector<Event> events;
  std::vector<Loss> losses;
  std::vector<std::string> damage;
  std::vector<std::filesystem::path> directories;
  std::vector<CallbackRun> callbacks;
  std::vector<Delivery> deliveries;

 private:
  Event stored(const tracing::Event& event, const std::string& host);
  void set_class(Event& stored, const tracing::EventClass& event_class, const std::string& host);
  void add_callbacks(const tracing::timeline::Timeline& timeline);
  void add_deliveries(const tracing::timeline::Timeline& timeline);

  std::vector<std::shared_ptr<const EventClass>> classes_;  // by tracing::EventClass::id
  std::vector<std::vector<std::size_t>> contexts_;          // of each class, those that are kept as values
  std::map<std::string, std::shared_ptr<const std::string>, std::less<>> procnames_;
};

}  // namespace launch_trace_testing
