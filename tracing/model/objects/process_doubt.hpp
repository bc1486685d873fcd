// SPDX-License-Identifier: Apache-2.0
// Whether a process of one session is that of another session with the same id on the same machine. Ids are not enough:
// two containers have processes of one id.
//
// A tracepoint hands its event to one session after another. So an event with an address in it, of the same thread and
// with the same fields as the one before, which is of the other session, is a copy: addresses of two processes differ.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "tracing/decode/reader/event.hpp"

namespace tracing {

class ProcessDoubt {
 public:
  // `other`: the process of the other session.
  explicit ProcessDoubt(std::uint32_t other) : other_(other) {}

  std::uint32_t other() const { return other_; }
  // To be asked for each event of the two. Whether it is a copy of the one before.
  bool is_copy(const Event& event, std::uint32_t process);
  // There were many events, and none of them was a copy.
  bool is_given_up() const { return events_ > kMost || events_of_other_ > kMostOfOther; }

 private:
  static constexpr int kMost = 100;
  static constexpr int kMostOfOther = 10'000;
  std::uint32_t other_;
  int events_ = 0;  // of the process in doubt
  int events_of_other_ = 0;
  // Of the last event.
  std::uint32_t process_ = 0xffffffff;
  std::string_view name_;  // lives as long as the reader
  std::int64_t vtid_ = 0;
  std::int64_t time_ns_ = 0;
  std::string fields_;
};

}  // namespace tracing
