// SPDX-License-Identifier: Apache-2.0
// The faults of messages that a test asks for (rmw_message_faults/fault_table.hpp), as one endpoint sees them.
//
// A process without $RMW_MESSAGE_FAULTS, and an endpoint that no fault names, have none: publishing and taking then
// test one pointer.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "rmw_message_faults/fault_table.hpp"

namespace rmw_fastrtps {

// The name of the variable of the environment that names the table.
const char* variable_of_faults();

// What happens to one message.
struct MessageFate {
  bool is_dropped = false;
  unsigned copies = 1;
  std::chrono::nanoseconds delay{0};
  std::vector<std::uint64_t> corruptions = {};  // a seed for each

  bool is_usual() const {
    return !is_dropped && copies == 1 && delay == std::chrono::nanoseconds(0) && corruptions.empty();
  }
};

class MessageFaults {
 public:
  // Null if no fault names the endpoint. `node` is fully qualified. The first call of the process reads the table; a
  // table that can't be read is told on stderr, once.
  static std::unique_ptr<MessageFaults> of(rmw_message_faults::Side side, const std::string& topic,
                                           const std::string& node);

  // Counts a message and says what happens to it. Any thread.
  MessageFate next();

  // Forgets the faults of a kind that the endpoint cannot have; they hit nothing. Returns whether there were some.
  bool leave_out(rmw_message_faults::Kind kind);
  bool empty() const { return faults_.empty(); }

  explicit MessageFaults(std::vector<rmw_message_faults::Fault*> faults) : faults_(std::move(faults)) {}

 private:
  std::vector<rmw_message_faults::Fault*> faults_;
};

// Changes one byte in each started 64 bytes behind the encapsulation header. What is changed depends on the seed and on
// the size alone.
void corrupt(std::uint8_t* message, std::size_t size, std::uint64_t seed);

}  // namespace rmw_fastrtps
