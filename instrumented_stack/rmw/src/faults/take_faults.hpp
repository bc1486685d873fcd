// SPDX-License-Identifier: Apache-2.0
// Gives the messages of a subscription, or the requests of a service, to its takes as its faults want it. A message
// that is late, or the copy of one, waits here, where the reader does not know it.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "faults/message_faults.hpp"
#include "rmw/serialized_message.h"
#include "rmw/types.h"
#include "rosidl_typesupport_fastrtps_cpp/message_type_support.h"

namespace rmw_fastrtps {

struct IncomingMessage;

// `Info` is what a take tells of a message beside it: rmw_message_info_t, or rmw_service_info_t of a request.
template <typename Info>
class TakeFaults {
 public:
  // Takes the next message of the reader. False if there is none.
  using Reader = std::function<bool(rmw_serialized_message_t& message, Info& info)>;

  // `announce` is called when has_message() has become true, by any thread.
  TakeFaults(std::unique_ptr<MessageFaults> faults, const message_type_support_callbacks_t& type,
             std::function<void()> announce);
  ~TakeFaults();
  TakeFaults(const TakeFaults&) = delete;
  TakeFaults& operator=(const TakeFaults&) = delete;

  // False if there is no message now. A message whose bytes can't be read any more is lost.
  bool take(const Reader& reader, const IncomingMessage& message, Info& info);

  // Whether a message waits here whose time has come.
  bool has_message() const;

 private:
  struct Message {
    std::vector<std::uint8_t> bytes;
    Info info;
  };

  // Applies the faults. False if nothing is left of the message for now.
  bool pass(Message& message, std::size_t& copies);
  void put(const Message& message);

  std::unique_ptr<MessageFaults> faults_;
  const message_type_support_callbacks_t& type_;
  std::function<void()> announce_;
  mutable std::mutex mutex_;
  std::deque<Message> waiting_;
  rmw_serialized_message_t buffer_;
};

extern template class TakeFaults<rmw_message_info_t>;
extern template class TakeFaults<rmw_service_info_t>;

}  // namespace rmw_fastrtps
