// SPDX-License-Identifier: Apache-2.0
// What an event of the kernel looks like in memory, from the file `format` of tracefs (Documentation/trace/events.rst).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tracing::kernel {

struct EventField {
  enum class Kind {
    kInteger,
    kText,         // a fixed array of characters
    kDynamicText,  // 32 bits that say where in the record a text stands: its offset, and its length in the high half
    kIntegers      // a fixed array of integers
  };

  std::string name;
  Kind kind = Kind::kInteger;
  std::uint32_t offset = 0;        // in the record
  std::uint32_t size = 0;          // bytes, of all of it
  std::uint32_t element_size = 0;  // bytes, of kIntegers
  bool is_signed = false;
  bool hexadecimal = false;  // an address
};

struct EventFormat {
  std::uint16_t id = 0;
  std::string name;                // as LTTng names it: sched_switch, syscall_entry_openat
  std::vector<EventField> fields;  // without the common ones
};

// What LTTng's modules call an event of the kernel: "irq_softirq_entry" for "softirq_entry".
std::string lttng_name(const std::string& kernel_name);

// Fields whose type is none of the kinds are left out. Threads are called tid in events of the scheduler, as LTTng
// calls them. Throws std::runtime_error for a text without name and ID.
EventFormat parse_event_format(const std::string& text);

}  // namespace tracing::kernel
