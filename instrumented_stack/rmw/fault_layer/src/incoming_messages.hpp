// SPDX-License-Identifier: Apache-2.0
// The messages of a subscription, or the requests of a service, given to its takes as its faults want it. A message
// that is late, or the copy of one, waits here, where the middleware does not know it.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>

#include "faults/message_faults.hpp"
#include "middleware.hpp"

namespace rmw_fault_layer {

// What a take tells of a message beside it, as it stands in memory.
using Info = std::vector<std::byte>;

class IncomingMessages {
 public:
  // How one take gets at its message.
  struct Access {
    std::function<rmw_ret_t(void* info, bool& taken)> take;  // from the middleware
    std::function<Bytes()> bytes;                            // of what was taken; empty: it cannot be serialized
    std::function<bool(const Bytes&)> set;                   // false: the bytes are no message
  };

  // `size_of_info` in bytes. `name` is that of the topic or service.
  IncomingMessages(std::unique_ptr<rmw_fastrtps::MessageFaults> faults, std::size_t size_of_info, std::string name,
                   rmw_context_t* context);
  ~IncomingMessages();
  IncomingMessages(const IncomingMessages&) = delete;
  IncomingMessages& operator=(const IncomingMessages&) = delete;

  // `info` may be null.
  rmw_ret_t take(const Access& access, void* info, bool& taken);

  // Whether a message waits here whose time has come.
  bool has_message() const;
  // Triggered when there is one.
  void* guard_condition() const { return guard_condition_->data; }
  // Called as well then, with the number of messages.
  void set_callback(rmw_event_callback_t callback, const void* user_data);

 private:
  struct Message {
    Bytes bytes;
    Info info;
  };

  void put(const Message& message);

  std::unique_ptr<rmw_fastrtps::MessageFaults> faults_;
  std::size_t size_of_info_;
  std::string name_;
  rmw_guard_condition_t* guard_condition_;
  mutable std::mutex mutex_;
  std::deque<Message> waiting_;
  NotSerialized not_serialized_;
  std::mutex callback_mutex_;  // held while it is called
  rmw_event_callback_t callback_ = nullptr;
  const void* user_data_ = nullptr;
};

}  // namespace rmw_fault_layer
