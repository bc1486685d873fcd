// SPDX-License-Identifier: Apache-2.0
// What Fast CDR 1 and 2 call by different names. Nothing else in the project depends on the version of Fast CDR.
//
// Version 2 writes XCDR2 unless it is told otherwise. ROS 2 speaks plain CDR, as version 1 does: eight-byte numbers are
// aligned to eight bytes, and the encapsulation header is 00 01 00 00.
#pragma once

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>
#include <fastcdr/config.h>
#include <fastcdr/exceptions/Exception.h>

#include <cstddef>
#include <exception>

namespace fastcdr_versions {

// Reads or writes plain CDR in `memory`, which must live as long.
inline eprosima::fastcdr::Cdr plain_cdr(
    eprosima::fastcdr::FastBuffer& memory,
    eprosima::fastcdr::Cdr::Endianness endianness = eprosima::fastcdr::Cdr::DEFAULT_ENDIAN) {
#if FASTCDR_VERSION_MAJOR >= 2
  return eprosima::fastcdr::Cdr(memory, endianness, eprosima::fastcdr::CdrVersion::DDS_CDR);
#else
  return eprosima::fastcdr::Cdr(memory, endianness, eprosima::fastcdr::Cdr::DDS_CDR);
#endif
}

// The elements of an array, without a length.
template <typename Number>
void write_array(eprosima::fastcdr::Cdr& cdr, const Number* numbers, std::size_t count) {
#if FASTCDR_VERSION_MAJOR >= 2
  cdr.serialize_array(numbers, count);
#else
  cdr.serializeArray(numbers, count);
#endif
}

template <typename Number>
void read_array(eprosima::fastcdr::Cdr& cdr, Number* numbers, std::size_t count) {
#if FASTCDR_VERSION_MAJOR >= 2
  cdr.deserialize_array(numbers, count);
#else
  cdr.deserializeArray(numbers, count);
#endif
}

// The number of bytes written so far.
inline std::size_t written_size(const eprosima::fastcdr::Cdr& cdr) {
#if FASTCDR_VERSION_MAJOR >= 2
  return cdr.get_serialized_data_length();
#else
  return cdr.getSerializedDataLength();
#endif
}

// Whether `count` bytes are left to read.
inline bool has_left(eprosima::fastcdr::Cdr& cdr, std::size_t count) {
#if FASTCDR_VERSION_MAJOR >= 2
  eprosima::fastcdr::Cdr::state here = cdr.get_state();
  const bool enough = cdr.jump(count);
  cdr.set_state(here);
#else
  eprosima::fastcdr::Cdr::state here = cdr.getState();
  const bool enough = cdr.jump(count);
  cdr.setState(here);
#endif
  return enough;
}

// Whether `act` ends without an exception. Later releases throw some that are none of std.
template <typename Act>
bool succeeds(Act act) {
  try {
    act();
    return true;
  } catch (const eprosima::fastcdr::exception::Exception&) {
    return false;
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace fastcdr_versions
