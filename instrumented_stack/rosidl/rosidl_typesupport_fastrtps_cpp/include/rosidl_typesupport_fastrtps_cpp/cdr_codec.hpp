// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>

namespace eprosima::fastcdr {
class Cdr;
}

namespace rosidl_typesupport_fastrtps_cpp {

struct MaxSize;

// Converts a message type to CDR bytes and back. Generated code specialises it for each message:
//   write      throws if the buffer is too small
//   read       throws if the bytes are cut short or contain a longer sequence than the type allows
//   end_after  the position after the message, if it is written at `position`
//   add_to     adds the message's maximum size to an upper bound
//   least_size the least number of bytes of a message
// Positions are bytes from the beginning of the payload; alignment counts from there.
template <typename Message>
struct CdrCodec;

// The sum of the maximum sizes of a type's members.
struct MaxSize {
  static constexpr std::size_t kUnbounded = std::numeric_limits<std::size_t>::max();

  std::size_t end = 0;
  // False once a member without an upper bound was added. Such a member counts as empty.
  bool bounded = true;
  // The serialised bytes and the memory have the same layout.
  bool plain = true;

  // Adds a member of type T. `string_bound` is the maximum length of each string in it.
  template <typename T>
  void add(std::size_t string_bound = kUnbounded);
  // Adds `count` numbers of `size` bytes.
  void add_primitives(std::size_t size, std::size_t count);
};

}  // namespace rosidl_typesupport_fastrtps_cpp
