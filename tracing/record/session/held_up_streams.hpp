// SPDX-License-Identifier: Apache-2.0
// Streams that a process holds up which died within an event: LTTng writes nothing of them any more, whichever process
// fires. It tells nobody. So somebody has to look after the death of a process.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tracing/record/lttng/ring_buffers.hpp"
#include "tracing/record/session/session_details.hpp"

namespace tracing {

struct HeldUpStream {
  std::uint32_t processor = 0;
  std::uint64_t since = 0;  // CLOCK_MONOTONIC, ns: what was recorded from then on is lost
  std::uint64_t seen = 0;   // when it was seen first

  bool operator==(const HeldUpStream&) const = default;
};

class HeldUpStreams {
 public:
  // A thread that lives completes its event within this time, also on a machine that is busy.
  static constexpr std::chrono::milliseconds kLongestEvent{750};
  // Longer is not waited for the one that proves us wrong.
  static constexpr std::chrono::seconds kLongestDoubt{10};

  HeldUpStreams(std::string lttng_session_name, std::vector<pid_t> consumers)
      : session_(std::move(lttng_session_name)), consumers_(std::move(consumers)) {}

  // Call it several times within a second of a death, until is_sure(), and then now and then until is_settled().
  struct Look {
    std::vector<HeldUpStream> held_up;   // streams whose event has stayed incomplete for kLongestEvent, each told once
    std::vector<HeldUpStream> released;  // those of held_up that go on after all
  };
  Look look();
  // Every event that was incomplete has been told, or was completed.
  bool is_sure() const;
  bool is_settled() const;

 private:
  struct Suspicion {
    std::uint64_t first_seen = 0;
    bool told = false;
    bool is_ours = true;
  };

  bool is_ours(const OpenPacket& packet) const;

  std::string session_;
  std::vector<pid_t> consumers_;
  std::map<OpenPacket, Suspicion> suspicions_;
};

// The session with SessionDetails::held_up filled with what is held up now. Takes no time if nothing may be, else
// kLongestEvent. Nothing is where each process has buffers of its own.
SessionDetails with_held_up_streams(SessionDetails session);

}  // namespace tracing
