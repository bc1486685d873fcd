// SPDX-License-Identifier: Apache-2.0
// Counts the allocations of a thread, and tells for which library they were made. Linking it replaces malloc() in the
// whole program.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace test_support {

struct Allocations {
  std::size_t in_stack = 0;                // by rclcpp, rcl, rmw, tracetools, messages and the program itself
  std::size_t in_fast_dds = 0;             // by Fast DDS and Fast CDR
  std::vector<std::string> stack_callers;  // functions, or libraries with addresses, of the first allocations in_stack
};

// Counts for this thread, from construction to finish().
class AllocationCount {
 public:
  AllocationCount();
  ~AllocationCount();
  AllocationCount(const AllocationCount&) = delete;
  AllocationCount& operator=(const AllocationCount&) = delete;

  Allocations finish();

  // Sanitizers have an allocator of their own.
  static bool is_possible();
};

}  // namespace test_support
