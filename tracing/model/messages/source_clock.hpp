// SPDX-License-Identifier: Apache-2.0
// The clock of the source timestamps of a process, as the times of its trace have it.
//
// A source timestamp comes from the wall clock, while a publish function runs. The tracer has measured once how far its
// own clock is from the epoch, so both agree until somebody sets the wall clock. What is learned here is the least time
// from the call of a publish function to a source timestamp: the least duration of a write, and what the clocks differ
// in.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

namespace tracing {

class SourceClock {
 public:
  // What the clocks may differ in as long as nothing is known.
  static constexpr std::int64_t kUncertainty = 100'000;  // ns
  // From so many matches on, hardly any write takes less time than the least one so far.
  static constexpr std::uint32_t kConfirmed = 16;
  // So many messages in a row that fit no publication, but agree with one another, tell that the clock was set.
  static constexpr std::uint32_t kAgreeing = 8;

  bool is_confirmed() const { return matches_ >= kConfirmed; }
  // The least time from a call to a source timestamp. Confirmed clocks only.
  std::int64_t least_ns() const { return least_ns_; }
  // What the clocks differ in, give or take kUncertainty.
  std::int64_t offset_ns() const { return offset_ns_; }

  // A message of a known publication took so long from the call to its source timestamp.
  void on_match(std::int64_t delay_ns) {
    least_ns_ = std::min(least_ns_, delay_ns);
    ++matches_;
    agreeing_ = 0;
  }
  // A message fits no publication. If it is the newest one of the process that was published before it was taken, the
  // clocks differ by something between these.
  void on_miss(std::int64_t at_least_ns, std::int64_t at_most_ns) {
    if (agreeing_ == 0 || at_least_ns > most_ || at_most_ns < least_) {
      agreeing_ = 0;
      least_ = at_least_ns;
      most_ = at_most_ns;
    }
    least_ = std::max(least_, at_least_ns);
    most_ = std::min(most_, at_most_ns);
    if (++agreeing_ >= kAgreeing) {
      offset_ns_ = most_;
      least_ns_ = most_;
      matches_ = 0;
      agreeing_ = 0;
    }
  }

 private:
  std::int64_t offset_ns_ = 0;
  std::int64_t least_ns_ = std::numeric_limits<std::int64_t>::max();
  std::uint32_t matches_ = 0;
  std::uint32_t agreeing_ = 0;  // messages without a publication, one after the other
  std::int64_t least_ = 0;      // what they agree on
  std::int64_t most_ = 0;
};

}  // namespace tracing
