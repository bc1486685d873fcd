// SPDX-License-Identifier: Apache-2.0
// What has become of the faults of a test.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "launcher/process/event_loop.hpp"
#include "launcher/run/system_test/fault_event.hpp"
#include "launcher/testing/failure.hpp"
#include "launcher/visit/fault_request.hpp"

namespace launch {

struct FaultResult {
  std::size_t number = 0;  // among the faults of the test, from 1
  std::string file;
  unsigned line = 0;
  unsigned column = 0;
  std::string place;                          // as messages show it: "system.launch.xml:8:6"
  std::string what;                           // "kill of 'worker'"
  std::string reason;                         // why it was not applied; empty: it was
  bool left_out = false;                      // not drawn, or not chosen on the command line
  double seconds = 0;                         // when it was applied, from the begin of the test
  std::uint64_t messages = 0;                 // that a fault of messages has hit
  double latest = 0;                          // when the latest of them was
  std::optional<std::uint64_t> packets = {};  // that a fault of the network has hit

  bool applied() const { return reason.empty(); }
  // "system.launch.xml:8:6: kill of 'worker' at 2.314 s", "…: stop of 'worker': not drawn", "…: drop of messages 3 to 5
  // on '/scan' at 2.314 s, 2 times until 2.414 s".
  std::string text() const;
};

class FaultLog {
 public:
  void begin(std::vector<FaultRequest> faults, Duration now);
  void on_fault(const FaultEvent& event, Duration now);
  // Whether a fault of this run is not over yet. `open()` is then the first.
  bool is_open() const;
  // Whether each fault of this run that is not over is one of messages, which failures() tells of.
  bool is_open_for_messages_only() const;
  const FaultRequest& open() const;

  // After the run; `why` says why nothing more could happen: "the system had ended".
  std::vector<FaultResult> results(const std::string& why) const;
  // The faults without anything random that could not be applied, or not to as many messages as they say: the test has
  // not tested what it says.
  std::vector<Failure> failures(const std::string& why) const;

 private:
  struct Entry {
    FaultRequest request;
    bool is_applied = false;
    bool is_over = false;
    std::string reason;
    Duration at{0};
    std::uint64_t messages = 0;
    Duration latest{0};
    std::optional<std::uint64_t> packets = {};
  };

  std::vector<Entry> entries_;
  Duration begin_{0};
};

}  // namespace launch
