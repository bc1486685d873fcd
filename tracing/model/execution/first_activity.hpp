// SPDX-License-Identifier: Apache-2.0
// When each process did something for the first time: ran a callback, published a message.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tracing/model/execution/execution_sink.hpp"
#include "tracing/model/objects/record_at.hpp"

namespace tracing {

struct FirstActivityRecord {
  std::optional<std::int64_t> callback_ns;
  std::optional<std::int64_t> publication_ns;  // on any topic but /rosout and /parameter_events
};

class FirstActivity : public ExecutionSink {
 public:
  // The model must outlive this object.
  explicit FirstActivity(const ObjectModel& model) : model_(model) {}

  void on_callback_begin(const CallbackInstance& instance) override;
  void on_publication(const Publication& publication) override;

  FirstActivityRecord of(ProcessId process) const {
    return process < records_.size() ? records_[process] : FirstActivityRecord();
  }

 private:
  FirstActivityRecord& record(ProcessId process) { return record_at(records_, process); }

  const ObjectModel& model_;
  std::vector<FirstActivityRecord> records_;
};

}  // namespace tracing
