// SPDX-License-Identifier: Apache-2.0
#pragma once

// When a message comes, the memory that its events touch has left the caches. The first event on the message's way
// knows which events follow, and asks for the memory of all of them at once. Otherwise each would wait for its own,
// line by line, because one line has the address of the next.
//
// A plan holds addresses, which may be out of date: to fetch memory that is gone does nothing.

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "counters/event_counters.hpp"
#include "probes/probes.hpp"
#include "recording/recording.hpp"

namespace tracetools {

// Any thread may use it at any time.
class alignas(64) FetchPlan {
 public:
  static constexpr std::size_t kMostFollowers = 5;

  // `followers`: the tracepoints that a message passes after the one whose plan this is.
  template <typename... Tracepoints>
  constexpr explicit FetchPlan(const Tracepoints*... followers)
      : count_(sizeof...(followers)), followers_{followers...} {}

  // Asks for everything, and waits for nothing. Call it before the first event is recorded.
  void fetch() const noexcept;
  // Finds the addresses for later messages, now and then. Call it afterwards, when the memory has come.
  void renew() noexcept;

 private:
  using Address = std::atomic<std::uintptr_t>;
  struct OfEvent {
    Address probe{0};
    Address event{0};
    Address recorder{0};
    Address recorder_private{0};
  };
  struct OfChannel {
    Address channel{0};
    Address parent{0};
    Address channel_private{0};
    Address session{0};
    Address functions{0};
  };

  void find_addresses() noexcept;

  std::size_t count_;  // of followers
  OfChannel of_channel_;
  OfEvent of_events_[kMostFollowers];
  const Tracepoint* followers_[kMostFollowers];
};

// Records the first event on the way of a message, as record() does, and has the memory of the others fetched
// meanwhile.
void record_first(const Tracepoint& tracepoint, CountedEvent event, const void* payload, std::size_t size,
                  ProbeCall call, FetchPlan& followers);

}  // namespace tracetools
