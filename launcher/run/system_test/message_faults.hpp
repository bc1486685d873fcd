// SPDX-License-Identifier: Apache-2.0
// The faults of messages of a test, as the launcher sees them. The nodes apply them
// (rmw_message_faults/fault_table.hpp); here they are handed out, begin, end and are counted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "base/files/unique_fd.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/process/process_spec.hpp"
#include "launcher/visit/fault_request.hpp"

namespace rmw_message_faults {
struct Fault;
struct Table;
}  // namespace rmw_message_faults

namespace launch {

class MessageFaults {
 public:
  struct Hits {
    std::uint64_t messages = 0;  // of the topic, since the fault began
    std::uint64_t hit = 0;
    Duration first{0};  // as EventLoop::now()
    Duration latest{0};
  };

  // `on_hit` is called when a fault has hit messages. The loop must outlive this object.
  MessageFaults(EventLoop& loop, std::function<void()> on_hit) : loop_(loop), on_hit_(std::move(on_hit)) {}
  ~MessageFaults();  // removes the files
  MessageFaults(const MessageFaults&) = delete;
  MessageFaults& operator=(const MessageFaults&) = delete;

  // Makes the files by which the nodes know the faults, in an existing directory. To be called at most once, before the
  // processes start. Throws std::system_error.
  void begin(const std::vector<FaultRequest>& faults, const std::string& directory);
  // Tells the process, which is about to start, of its faults.
  void prepare(ProcessSpec& spec, ProcessId id) const;

  // The number is that of FaultRequest. Messages are counted while it is armed.
  void arm(std::size_t number, bool armed);
  Hits hits(std::size_t number) const;

 private:
  struct Subject {
    std::size_t number;   // of FaultRequest
    std::string process;  // empty: each
  };

  rmw_message_faults::Fault& fault(std::size_t number) const;

  EventLoop& loop_;
  std::function<void()> on_hit_;
  std::vector<Subject> subjects_;  // in the order of the table
  std::string path_;
  rmw_message_faults::Table* table_ = nullptr;
  UniqueFd wake_;
  EventLoop::SourcePtr source_;
};

}  // namespace launch
