// SPDX-License-Identifier: Apache-2.0
// The layout of an event of the kernel in memory, from the file `format` of tracefs (Documentation/trace/events.rst).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tracing::kernel {

struct EventField {
  enum class Kind {
    kInteger,
    kText,         // a fixed array of characters
    kDynamicText,  // 32 bits that give the place of a text in the record: its offset, and its length in the high half
    kIntegers      // a fixed array of integers
  };

  std::string name;
  Kind kind = Kind::kInteger;
  std::uint32_t offset = 0;        // in the record
  std::uint32_t size = 0;          // bytes of the whole field
  std::uint32_t element_size = 0;  // bytes, of kIntegers
  bool is_signed = false;
  bool hexadecimal = false;  // an address
};

struct EventFormat {
  std::uint16_t id = 0;
  std::string name;                // as LTTng names it: sched_switch, syscall_entry_openat
  std::vector<EventField> fields;  // without the common fields
};

// The name of an event of the kernel in LTTng's modules: "irq_softirq_entry" for "softirq_entry".
std::string lttng_name(const std::string& kernel_name);

// A field whose type is none of the kinds is left out. Events of the scheduler call a thread tid, as LTTng does. Throws
// std::runtime_error for a text without name and ID.
EventFormat parse_event_format(const std::string& text);

}  // namespace tracing::kernel
