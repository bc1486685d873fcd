// SPDX-License-Identifier: Apache-2.0
// Shared memory for what a participant sends in large messages.
//
// A writer that is not reliable loses the parts of a message that have no place in shared memory, and with one of them
// the message. A participant of Fast DDS has 512 KiB, so large messages come only if their reader is as fast as their
// writer. But Fast DDS writes to all pages of a segment when it makes it: with more, each participant would hold that
// much memory, and take milliseconds to begin. So large messages go through a second transport, with a segment of up to
// 32 MiB, which is made when the first of them is sent.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "fastdds_versions/transport.hpp"

namespace rmw_fastrtps {

// Threads: all.
class LargeMessages {
 public:
  // `largest_message`: what the transport of the participant sends at most in one message.
  explicit LargeMessages(std::uint32_t largest_message) : largest_message_(largest_message) {}
  ~LargeMessages();
  LargeMessages(const LargeMessages&) = delete;
  LargeMessages& operator=(const LargeMessages&) = delete;

  // Whether a message of so many bytes is. Parts of larger messages are, except for their last ones.
  static bool is_large(std::uint32_t size) { return size > kLarge; }

  // What sends large messages in shared memory. Removes from `destinations` those that are not reached by shared
  // memory. Null if none is left, or if /dev/shm has no room for more than a participant has anyway.
  rtps::SenderResource* sender(std::vector<rtps::Locator>& destinations);

 private:
  static constexpr std::uint32_t kLarge = 32 * 1024;

  void begin(const rtps::Locator& destination);

  const std::uint32_t largest_message_;
  std::mutex mutex_;
  bool has_begun_ = false;
  std::unique_ptr<rtps::TransportInterface> transport_;
  rtps::SendResourceList senders_;
};

}  // namespace rmw_fastrtps
