// SPDX-License-Identifier: Apache-2.0
// Follows messages within a process, from rclcpp_intra_publish through the ring buffer of a subscription.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "tracing/model/execution/execution_sink.hpp"

namespace tracing {

// A message that was taken out of a ring buffer.
struct BufferedMessage {
  ObjectId subscription = kNoObject;  // kNoObject: the init events of the buffer are not in the trace
  Publication publication;            // has no number when the publication is not in the trace
};

struct BufferRecord {
  std::uint64_t overwritten = 0;  // a newer message took the place of one that no callback had got
  std::uint64_t cleared = 0;
  std::uint64_t unknown = 0;  // taken out without having been put in within the trace
};

class IntraProcessMatcher {
 public:
  // The model must outlive this object.
  explicit IntraProcessMatcher(const ObjectModel& model) : model_(model) {}

  void on(const Origin& origin, const ros2::RclcppConstructRingBuffer& event);
  void on(const Origin& origin, const ros2::RclcppBufferToIpb& event);
  void on(const Origin& origin, const ros2::RclcppIpbToSubscription& event);
  // `publication`: the last one of the thread, if it was within the process.
  void enqueue(const Origin& origin, const ros2::RclcppRingBufferEnqueue& event,
               const std::optional<Publication>& publication);
  BufferedMessage dequeue(const Origin& origin, const ros2::RclcppRingBufferDequeue& event);
  void clear(const Origin& origin, const ros2::RclcppRingBufferClear& event);

  const BufferRecord& record() const { return record_; }
  // Messages that newer ones have pushed out, by subscription.
  std::map<ObjectId, std::uint64_t> overwritten() const;
  std::uint64_t overwritten_of(ObjectId subscription) const;

 private:
  using Key = std::pair<ProcessId, ros2::Handle>;
  struct Buffer {
    ros2::Handle subscription_object = 0;
    std::map<std::uint64_t, Publication> slots;  // by index
  };

  const ObjectModel& model_;
  std::map<Key, Buffer> buffers_;
  std::map<Key, ros2::Handle> buffer_of_ipb_;
  BufferRecord record_;
  std::map<ObjectId, std::uint64_t> overwritten_;
  // By the subscription's object, as long as no event has told whose it is.
  std::map<Key, std::uint64_t> overwritten_of_unknown_;
};

}  // namespace tracing
