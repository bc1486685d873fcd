// SPDX-License-Identifier: Apache-2.0
// What happens to a fault of a test.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "launcher/process/event_loop.hpp"

namespace launch {

struct FaultEvent {
  enum class Kind {
    kApplied,  // of messages: for the first time, or again
    kOver,     // it lasted for a time; for a kill, at once
    kMissed    // it could not be applied
  };
  std::size_t number = 0;  // of the fault
  Kind kind = Kind::kApplied;
  std::vector<std::string> labels = {};       // of kApplied: the processes
  int signal = 0;                             // of kApplied: what a kill has sent
  std::string reason = {};                    // of kMissed: "'worker' did not run"
  std::uint64_t messages = 0;                 // of kApplied: how many have been hit so far
  Duration first{0};                          // of kApplied, with messages: when the first one was, as EventLoop::now()
  Duration latest{0};                         // and the latest one
  std::optional<std::uint64_t> packets = {};  // of kOver: how many a fault of the network has hit
};

}  // namespace launch
