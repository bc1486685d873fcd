// SPDX-License-Identifier: Apache-2.0
// Which callback ran while another one of its thread was due: a timer, or a subscription whose message was there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "tracing/model/execution/execution_sink.hpp"
#include "tracing/model/execution/thread_map.hpp"

namespace tracing {

// What has held up one callback.
struct HoldUpRecord {
  struct By {
    ObjectId callback = kNoObject;
    std::int64_t ns = 0;      // in all
    std::uint64_t count = 0;  // calls that were held up
  };
  std::vector<By> by;  // at most kMost
  static constexpr std::size_t kMost = 8;

  // By whom most; null: by none.
  const By* most() const;
};

class HoldUps : public ExecutionSink {
 public:
  // The model must outlive this object.
  explicit HoldUps(const ObjectModel& model) : model_(model) {}

  void on_callback_begin(const CallbackInstance& instance) override;
  void on_callback(const CallbackInstance& instance) override;
  void on_message(const MessageFlow& message) override;

  // Indexed by the callback's ObjectId; may be shorter than the model's list.
  const std::vector<HoldUpRecord>& records() const { return records_; }

 private:
  struct Run {
    ObjectId callback = kNoObject;
    std::int64_t begin_ns = 0;
    std::int64_t end_ns = 0;
  };

  void add(ObjectId callback, const ThreadId& thread, std::int64_t due_ns, std::int64_t begin_ns);

  const ObjectModel& model_;
  ThreadMap<std::deque<Run>> runs_;           // the newest ones of each thread
  std::vector<std::int64_t> last_begins_ns_;  // by callback
  std::vector<HoldUpRecord> records_;
};

}  // namespace tracing
