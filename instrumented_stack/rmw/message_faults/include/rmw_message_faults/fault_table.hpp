// SPDX-License-Identifier: Apache-2.0
// A file that the launcher and the nodes of a test map: which messages a fault hits, and which it has hit.
//
// The launcher writes the file before it starts a process. $RMW_MESSAGE_FAULTS of a process is "1,3:PATH": the numbers
// of the faults that are for this process, and the file. Whoever applies a fault then writes a byte to the pipe
// PATH.wake, if there is room, so that the launcher looks.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

namespace rmw_message_faults {

constexpr const char* kVariable = "RMW_MESSAGE_FAULTS";
constexpr const char* kWakeSuffix = ".wake";

enum class Kind : std::uint32_t { kDrop, kDuplicate, kCorrupt, kDelay };
enum class Side : std::uint32_t { kPublish, kTake, kRequest, kResponse };  // the last two: at the service

// No ROS name is longer.
constexpr std::size_t kNameCapacity = 256;

struct Fault {
  // Written before the processes start.
  Kind kind;
  Side side;
  char topic[kNameCapacity];  // "/chatter", or of a service "/add"; ends with a zero byte, as the next one does
  char node[kNameCapacity];   // "/talker"; empty: each node
  std::uint64_t first;        // number of the first message that is hit, from 1
  std::uint64_t every;        // then each message of so many
  std::uint64_t count;        // so many are hit; 0: no end
  std::int64_t delay;         // ns
  std::uint64_t seed;         // of the bytes that kCorrupt changes

  // Set by the launcher. Messages before it is set are not counted.
  std::atomic<std::uint32_t> is_armed;

  // Counted by all processes together.
  std::atomic<std::uint64_t> seen;        // messages of the topic or service
  std::atomic<std::uint64_t> hit;         // of them
  std::atomic<std::int64_t> first_time;   // CLOCK_MONOTONIC, ns, of the first hit; 0: none yet
  std::atomic<std::int64_t> latest_time;  // of the latest one
};

struct Table {
  static constexpr std::uint64_t kMagic = 0x3174'6c66'776d'72U;  // "rmwflt1"

  std::uint64_t magic;
  std::uint64_t size_of_fault;
  std::uint64_t count;
  // `count` faults follow.

  static std::size_t size_for(std::size_t count) { return sizeof(Table) + count * sizeof(Fault); }
  Fault* faults() { return reinterpret_cast<Fault*>(this + 1); }
};

static_assert(std::atomic<std::uint64_t>::is_always_lock_free && std::atomic<std::uint32_t>::is_always_lock_free);
static_assert(sizeof(Table) % alignof(Fault) == 0);

}  // namespace rmw_message_faults
