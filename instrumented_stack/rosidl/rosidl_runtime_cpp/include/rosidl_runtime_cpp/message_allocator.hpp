// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

namespace rosidl_runtime_cpp {

template <class MessageT, class ContainerAllocator>
struct MessageOfAllocator {
  static_assert(sizeof(ContainerAllocator) == 0, "the members of messages use the standard allocator");
};
template <class MessageT, class T>
struct MessageOfAllocator<MessageT, std::allocator<T>> {
  using type = MessageT;
};

// What `String_<ContainerAllocator>` of a message `String` means: the message itself, for the standard allocator.
template <class MessageT, class ContainerAllocator>
using MessageWithAllocator = typename MessageOfAllocator<MessageT, ContainerAllocator>::type;

}  // namespace rosidl_runtime_cpp
