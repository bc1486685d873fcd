// SPDX-License-Identifier: Apache-2.0
// A page of the kernel's trace ring buffer, as `trace_pipe_raw` gives it (Documentation/trace/ring-buffer-design.rst
// and events/header_page, events/header_event of tracefs).
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <span>

namespace tracing::kernel {

constexpr std::size_t kPidOffset = 4;  // of common_pid in a record

// The number at `offset`, in the byte order of this machine; 0 when it does not lie wholly in `bytes`.
template <typename T>
T load(std::span<const std::uint8_t> bytes, std::size_t offset) {
  T value{};
  if (offset + sizeof value <= bytes.size()) {
    std::memcpy(&value, bytes.data() + offset, sizeof value);
  }
  return value;
}

struct RingPage {
  std::uint64_t begin = 0;         // time of the first record, on the clock of the instance
  std::uint64_t end = 0;           // time of the last record
  std::uint64_t lost_records = 0;  // between the previous page and this one; 1 when the kernel doesn't know the number
};

// Calls `record` for each record of the page, with its time and its bytes. If the page is cut off, the records end
// there.
RingPage read_ring_page(std::span<const std::uint8_t> page,
                        const std::function<void(std::uint64_t time, std::span<const std::uint8_t> record)>& record);

// Removes from the page the number of records that were lost before it. Returns whether there were some.
bool forget_lost_records(std::span<std::uint8_t> page);

}  // namespace tracing::kernel
