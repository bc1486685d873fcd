// SPDX-License-Identifier: Apache-2.0
// How far the clock of another machine is ahead of this one's, by round trips over the connection.
//
// A machine tells its time between the moment at which it was asked and the moment at which the answer was there. So
// its clock is ahead by the difference to the middle of the two, and the error is at most half of the round trip,
// however long each direction takes. Each round trip is such an interval for the true offset at its time. The offsets
// of clocks that drift evenly lie on a line through all intervals; the lines that are possible bound the error (A.
// Duda, G. Harrus, Y. Haddad, G. Bernard: Estimating global time in distributed systems, ICDCS 1987).
//
// Compared are the monotonic clocks, which LTTng stamps events with, and which nobody sets. How far they are from the
// epoch is measured once, at the begin of a trace.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace launch {

// Nanoseconds since the epoch, and of the monotonic clock, of one moment.
struct ClockReading {
  std::int64_t epoch_ns = 0;
  std::int64_t monotonic_ns = 0;
};

// What a process that is interrupted between two clocks would spoil, is read again.
ClockReading read_clocks();

class ClockOffset {
 public:
  struct Measured {
    std::int64_t at_ns = 0;           // of the monotonic clock here: the middle of the time of measuring
    std::int64_t offset_ns = 0;       // at this moment: the monotonic clock there minus that here
    double drift = 0;                 // by which the offset grows in each second, in seconds; 0 if none can be told
    std::int64_t uncertainty_ns = 0;  // the largest error of the offset at any moment of measuring
    std::int64_t epoch_ns = 0;        // the time since the epoch here, minus the monotonic clock here
    std::int64_t wall_offset_ns = 0;  // the time since the epoch there, minus that here
    std::int64_t shortest_ns = 0;     // round trip
    std::uint64_t round_trips = 0;
  };

  // The machine was asked at `sent_ns` of the monotonic clock here, and its answer has come just now.
  void take_answer(std::int64_t sent_ns, const ClockReading& there);
  // `round_trip_ns` have passed until now. What can't be true is passed over.
  void add(std::int64_t round_trip_ns, const ClockReading& here, const ClockReading& there);
  // A trace begins. The distance of the clocks from the epoch stays that of the latest answer, whoever sets a clock.
  void keep_epoch() { keeps_epoch_ = count_ > 0; }
  // Nothing before the first round trip.
  std::optional<Measured> measured() const;

 private:
  struct Sample {
    std::int64_t at = 0;
    std::int64_t offset = 0;
    std::int64_t round_trip = 0;
  };

  bool fit_line(const Sample& best, Measured& measured) const;

  std::uint64_t count_ = 0;
  std::int64_t window_ = 1'000'000'000;  // ns
  std::vector<Sample> samples_;          // the shortest of each window
  bool keeps_epoch_ = false;
  std::int64_t epoch_here_ = 0;
  std::int64_t epoch_there_ = 0;
};

// The number of the boot of this machine, which traces have for its clock; empty: unknown.
std::string this_boot();

// For a file beside a trace; with the end of the line. `boot`: of this machine.
std::string clock_as_json(const std::string& machine, const ClockOffset::Measured& measured, const std::string& boot);

}  // namespace launch
