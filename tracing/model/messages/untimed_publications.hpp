// SPDX-License-Identifier: Apache-2.0
// The newest publications of a topic that were recorded without a timestamp, as by ros2_tracing before 8.0. The source
// timestamp of a message that is taken tells which one it is.
//
// The middleware takes the timestamp from the clock while the publish functions run. So it lies between rcl_publish and
// the next event of the thread that the join looks at. A message is a publication if its timestamp is within these
// bounds, and within those of no other publication of the topic. What fits several ones is left open.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "tracing/model/execution/execution_sink.hpp"
#include "tracing/model/execution/thread_map.hpp"
#include "tracing/model/messages/source_clock.hpp"

namespace tracing {

class SourceClocks {
 public:
  SourceClock& of(ProcessId process) { return clocks_[process]; }
  // Says whether the events of two processes have times of one clock. Without, those of all have.
  void compare_by(std::function<bool(ProcessId, ProcessId)> have_one_clock) {
    have_one_clock_ = std::move(have_one_clock);
  }
  bool have_one_clock(ProcessId process, ProcessId other) const {
    return !have_one_clock_ || have_one_clock_(process, other);
  }

 private:
  std::map<ProcessId, SourceClock> clocks_;
  std::function<bool(ProcessId, ProcessId)> have_one_clock_;
};

// A message that was taken.
struct SourceStamp {
  std::int64_t source_timestamp = 0;
  std::int64_t taken_ns = 0;
  ProcessId taking_process = kNoProcess;
};

class UntimedPublications {
 public:
  // `most`: so many are remembered of each thread.
  explicit UntimedPublications(std::size_t most) : most_(most) {}

  void add(const Publication& publication);
  // The thread goes on after the publication, which is its last one of the topic.
  void close(const Publication& publication, std::int64_t time_ns);
  // The publication of a message, which is then not here any more. Nullopt: none fits, or several do.
  std::optional<Publication> take(const SourceStamp& message, SourceClocks& clocks);
  // The publication with this number, which is then not here any more.
  std::optional<Publication> extract(std::uint64_t number);

  // Those of which no message was found, also older ones.
  std::uint64_t count() const { return count_; }

 private:
  static constexpr std::int64_t kOpen = std::numeric_limits<std::int64_t>::max();
  struct Sent {
    Publication publication;
    std::int64_t begin_ns = 0;    // its source timestamp is not earlier
    std::int64_t end_ns = kOpen;  // nor later
  };
  using OfThread = std::deque<Sent>;
  struct Candidate {
    OfThread* thread = nullptr;
    std::size_t place = 0;
    std::int64_t delay_ns = 0;  // from its begin to the source timestamp
    bool is_usual = true;       // writes of its publisher take as long, or nothing is known about that
  };

  static std::size_t begun_by(const OfThread& sent, std::int64_t time_ns);
  // A confirmed clock says which publication of a thread it is. Without, all that are near the time may be it.
  void find_by_clock(OfThread& sent, const SourceStamp& message, const SourceClock& clock);
  void find_near(OfThread& sent, const SourceStamp& message, const SourceClock& clock);
  // Written in less time than all before.
  void find_faster(OfThread& sent, const SourceStamp& message, const SourceClock& clock);
  void add_candidate(OfThread& sent, std::size_t place, const SourceStamp& message, const SourceClock& clock);
  std::int64_t usual_ns(ObjectId publisher) const;
  void learn(ObjectId publisher, std::int64_t after_least_ns);
  void learn_miss(const SourceStamp& message, SourceClocks& clocks);

  std::size_t most_;
  std::uint64_t count_ = 0;
  ThreadMap<OfThread> threads_;
  std::map<ObjectId, double> means_;  // by publisher: how much longer than the least one a write takes
  std::vector<Candidate> found_;      // kept for its memory
};

}  // namespace tracing
