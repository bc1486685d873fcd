// SPDX-License-Identifier: Apache-2.0
// Reads numbers from the bytes that the kernel's tracer writes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
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

}  // namespace tracing::kernel
