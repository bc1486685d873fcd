// SPDX-License-Identifier: Apache-2.0
// Memory that a process of a launch shares with the launcher: what each thread of an executor does, and since when.
//
// The launcher makes the memory, a page for each process that it watches. $LAUNCH_EXECUTOR_PROGRESS of the process is
// "OFFSET:PATH", the place of its page in a file. A thread takes a slot when it begins to spin, and gives it back when
// it ends. Descendants that are ROS programs, too, take slots of the same page.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

namespace executor_progress {

constexpr const char* kVariable = "LAUNCH_EXECUTOR_PROGRESS";

enum class Doing : std::uint64_t {
  kNothing,  // it does not spin, and need not
  kWaiting,  // the time is that at which it will wake up at the latest; kNever if only a message wakes it
  kBetween,  // since that time it chooses what to do next
  kTimer,    // since that time a callback runs: of a timer …
  kSubscription,
  kService,
  kClient,
  kWaitable,
  kAway  // since that time no function of an executor runs, after spin_some() and its like
};

// What a thread does, with a time of CLOCK_MONOTONIC in ns.
constexpr unsigned kDoingBits = 4;
constexpr std::uint64_t kNever = ~std::uint64_t{0} >> kDoingBits;
constexpr std::uint64_t pack(Doing doing, std::uint64_t time) {
  return time << kDoingBits | static_cast<std::uint64_t>(doing);
}
constexpr Doing doing_of(std::uint64_t packed) {
  return static_cast<Doing>(packed & ((std::uint64_t{1} << kDoingBits) - 1));
}
constexpr std::uint64_t time_of(std::uint64_t packed) {
  return packed >> kDoingBits;
}

// In a cache line of its own, because its thread writes it at each callback.
struct alignas(64) Slot {
  std::atomic<std::uint32_t> pid;  // 0: free
  std::atomic<std::uint32_t> tid;
  std::atomic<std::uint64_t> state;  // packed
  std::atomic<std::uint64_t> steps;  // changes of the state, so that two equal states can be told apart
};

struct alignas(64) Page {
  static constexpr std::size_t kSize = 4096;
  static constexpr std::size_t kSlots = kSize / sizeof(Slot) - 1;

  std::atomic<std::uint32_t> joined;  // a process whose executors use this page has begun
  Slot slots[kSlots];
};

static_assert(sizeof(Page) == Page::kSize);
static_assert(std::atomic<std::uint64_t>::is_always_lock_free && std::atomic<std::uint32_t>::is_always_lock_free);

}  // namespace executor_progress
