// SPDX-License-Identifier: Apache-2.0
// Converts values of messages to the bytes of DDS and back: plain CDR, as rmw_fastrtps_cpp writes it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "launcher/message_types/interface_type.hpp"

namespace eprosima::fastcdr {
class Cdr;
}

namespace launch {

// Behind the encapsulation header, which the caller reads or writes. Throw exceptions of Fast CDR if the bytes are cut
// short or the buffer is too small, and std::length_error if a length goes beyond the message.
void write_cdr(const MessageType& type, const MessageValue& value, eprosima::fastcdr::Cdr& cdr);
MessageValue read_cdr(const MessageType& type, eprosima::fastcdr::Cdr& cdr);

// The number of bytes that write_cdr() writes behind the header.
std::size_t cdr_size(const MessageType& type, const MessageValue& value);

// With the encapsulation header of four bytes, in the byte order that it names. Throw std::runtime_error.
std::vector<std::uint8_t> to_cdr(const MessageType& type, const MessageValue& value);
MessageValue from_cdr(const MessageType& type, const std::uint8_t* bytes, std::size_t size);

}  // namespace launch
