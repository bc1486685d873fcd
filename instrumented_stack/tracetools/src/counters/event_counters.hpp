// SPDX-License-Identifier: Apache-2.0
#pragma once

// Counts the events that this process fires to LTTng, in memory that a launcher can read. So others can see how many
// events each process fires while it runs, and how many of them a trace has lost. LTTng itself counts losses only for
// each buffer, and the processes of a user share their buffers.
//
// With TRACETOOLS_EVENT_COUNTERS=DIRECTORY in the environment each process keeps a file DIRECTORY/PID-BEGIN with the
// layout of `CounterFile`. Without it nothing is counted. An event that no session records is not counted either, with
// one exception: what a process fires before any session has reached it is counted as missed.

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "tracetools/events.h"
#include "tracetools/events_ext.h"

namespace tracetools {

#define TRACETOOLS_COUNTED_EVENT(name, ...) name,
enum class CountedEvent : std::size_t {
  TRACETOOLS_EVENTS(TRACETOOLS_COUNTED_EVENT) TRACETOOLS_EXT_EVENTS(TRACETOOLS_COUNTED_EVENT) kCount
};
#undef TRACETOOLS_COUNTED_EVENT

inline constexpr std::size_t kCountedEvents = static_cast<std::size_t>(CountedEvent::kCount);
// Blocks of counters. Each thread has its own. Threads that get none share the first block.
inline constexpr std::size_t kCounterBlocks = 64;
inline constexpr std::size_t kCountedNameSize = 64;  // bytes, zero-terminated

// The file, in the byte order of the machine. Times are CLOCK_MONOTONIC in nanoseconds.
struct CounterFile {
  std::uint64_t magic;  // the characters "ROS2CNT2", written last
  std::uint32_t events;
  std::uint32_t blocks;
  std::uint64_t pid;
  std::uint64_t begin;                     // when this library was loaded
  std::atomic<std::uint64_t> end;          // when the process ended normally; 0 while it runs, and if it was killed
  std::atomic<std::uint64_t> cpu;          // processor time used by then, in ns
  std::atomic<std::uint64_t> blocks_used;  // only this many blocks, from the first on, may be in use
  std::atomic<std::uint64_t> reached;      // when the first session reached the process; 0: none has
  std::atomic<std::uint64_t> missed;       // events fired before, which are in no trace
  char process[kCountedNameSize];          // the name of its program
  char names[kCountedEvents][kCountedNameSize];  // "ros2:rcl_init"
  std::uint64_t counts[kCounterBlocks][kCountedEvents];
};

// Called before the provider is loaded: makes the file.
void begin_counting() noexcept;
// Called when the provider has been loaded. If no session has reached the process by then, events are missed.
void count_missed_events() noexcept;
// A session starts in this process, or resumes. Returns whether it is the first one.
bool session_reaches_process() noexcept;
// The first session gets so many of the missed events by a state dump.
void make_good(std::uint64_t events) noexcept;
// Counts an init event that no session recorded.
void count_unrecorded() noexcept;

namespace detail {
extern std::atomic<bool> counting;
// initial-exec: access is one instruction. The space is available because the library is loaded with the program.
extern thread_local constinit std::uint64_t* own_block [[gnu::tls_model("initial-exec")]];
void count_without_block(CountedEvent event) noexcept;
}  // namespace detail

// Counts one more event. Takes about a nanosecond; any thread. Call it for an event whose tracepoint is enabled.
inline void count(CountedEvent event) noexcept {
  if (!detail::counting.load(std::memory_order_relaxed)) {
    return;
  }
  if (std::uint64_t* const block = detail::own_block) {
    const std::atomic_ref<std::uint64_t> counter(block[static_cast<std::size_t>(event)]);
    counter.store(counter.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  } else {
    detail::count_without_block(event);
  }
}

}  // namespace tracetools
