// SPDX-License-Identifier: Apache-2.0
// What the addresses of rcl contexts tell of processes. An operating system gives the number of a process that has
// ended to another one, and only `rcl_init` tells the two apart.
#pragma once

#include <cstdint>

namespace tracing {

// Whether no process has objects at both addresses. Each process has its heap at a place chosen at random (ASLR), where
// its contexts are close together. Two heaps of different processes are terabytes apart, in the same region of the
// address space: that of the program (0x55…) or that of mapped memory (0x7f…). A process may have objects in both
// regions, so two addresses in different regions tell nothing.
constexpr bool are_of_two_processes(std::uint64_t a, std::uint64_t b) {
  constexpr int kRegion = 44;                                     // bits
  constexpr std::uint64_t kLargestHeap = std::uint64_t{1} << 34;  // 16 GiB
  return a >> kRegion == b >> kRegion && (a > b ? a - b : b - a) > kLargestHeap;
}

}  // namespace tracing
