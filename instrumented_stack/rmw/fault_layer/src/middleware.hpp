// SPDX-License-Identifier: Apache-2.0
// The middleware of the process below this layer.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "rmw/rmw.h"

// A function of rmw that this layer puts in front of the middleware's.
#define RMW_FAULT_LAYER_FUNCTION extern "C" __attribute__((visibility("default")))

namespace rmw_fault_layer {

using Bytes = std::vector<std::uint8_t>;

// The middleware's function of this name. Ends the process with a message if it has none.
void* find_next(const char* name);
template <typename Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(find_next(name));
}

// Whether this layer applies faults. The rmw of this stack does so by itself.
bool is_needed();

// Whether service types have type supports of their requests and responses: since Iron.
bool services_tell_their_messages();

// sizeof(rmw_message_info_t) of this ROS 2: gids have 24 bytes before Iron, and 16 since.
std::size_t size_of_message_info();
// No version has a larger one.
inline constexpr std::size_t kMostOfMessageInfo = 256;

// Empty if the middleware cannot do it.
Bytes serialize(const void* message, const rosidl_message_type_support_t* type);
bool deserialize(const Bytes& bytes, const rosidl_message_type_support_t* type, void* message);

// Says once, on stderr, that a fault is not applied because the middleware does not serialize. Thread safe.
class NotSerialized {
 public:
  // `name` is that of the topic or service.
  void tell(const char* name);

 private:
  std::atomic<bool> is_told_{false};
};

// A message of the bytes, which must outlive it.
rmw_serialized_message_t view(const Bytes& bytes);

}  // namespace rmw_fault_layer
