// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/kernel/event_format.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace tracing::kernel {
namespace {

// The value of "key:value;" in a line, "" when it isn't there.
std::string value_of(const std::string& line, const std::string& key) {
  const std::size_t found = line.find(key + ":");
  if (found == std::string::npos) {
    return {};
  }
  const std::size_t begin = found + key.size() + 1;
  return line.substr(begin, line.find(';', begin) - begin);
}

bool is_size(std::uint32_t size) {
  return size == 1 || size == 2 || size == 4 || size == 8;
}

// Bytes of one element of an array of this C type; 0 for a type that is not known here.
std::uint32_t element_size(std::string_view type) {
  struct Known {
    std::string_view word;
    std::uint32_t size;
  };
  constexpr std::array kKnown = {Known{"char", 1}, Known{"u8", 1},  Known{"s8", 1},   Known{"short", 2},
                                 Known{"u16", 2},  Known{"s16", 2}, Known{"u32", 4},  Known{"s32", 4},
                                 Known{"u64", 8},  Known{"s64", 8}, Known{"long", 8}, Known{"int", 4}};
  for (const Known& known : kKnown) {
    if (type.find(known.word) != std::string_view::npos) {
      return known.size;
    }
  }
  return 0;
}

// Reads a declaration such as "char prev_comm[16]", with its place in the record.
std::optional<EventField> parse_field(const std::string& declaration, const std::string& line) {
  EventField field;
  field.offset = static_cast<std::uint32_t>(std::atol(value_of(line, "offset").c_str()));
  field.size = static_cast<std::uint32_t>(std::atol(value_of(line, "size").c_str()));
  field.is_signed = value_of(line, "signed") == "1";
  const std::size_t bracket = declaration.rfind('[');
  const bool dynamic = declaration.starts_with("__data_loc ");
  const std::string left = dynamic ? declaration : declaration.substr(0, bracket);
  const std::size_t space = left.find_last_of(" *");
  if (space == std::string::npos) {
    return std::nullopt;
  }
  field.name = left.substr(space + 1);
  const std::string type = left.substr(0, space + 1);
  field.hexadecimal = type.find('*') != std::string::npos;

  if (dynamic) {
    if (type.find("char[]") == std::string::npos) {
      return std::nullopt;
    }
    field.kind = EventField::Kind::kDynamicText;
    return field;
  }
  if (bracket == std::string::npos) {
    if (declaration.starts_with("__rel_loc ") || !is_size(field.size)) {
      return std::nullopt;
    }
    return field;
  }
  if (type.starts_with("char") || type.starts_with("const char")) {
    field.kind = EventField::Kind::kText;
    return field;
  }
  field.kind = EventField::Kind::kIntegers;
  field.element_size = element_size(type);
  if (field.element_size == 0 || field.size % field.element_size != 0) {
    return std::nullopt;
  }
  return field;
}

// Beginnings of names that LTTng's modules (2.13) write differently from the kernel.
constexpr std::array<std::pair<std::string_view, std::string_view>, 16> kNamesOfLttng{{
    {"sys_enter_", "syscall_entry_"},
    {"sys_exit_", "syscall_exit_"},
    {"softirq_", "irq_softirq_"},
    {"hrtimer_", "timer_hrtimer_"},
    {"itimer_", "timer_itimer_"},
    {"netif_", "net_if_"},
    {"napi_gro_", "net_napi_gro_"},
    {"consume_skb", "skb_consume"},
    {"kfree_skb", "skb_kfree"},
    {"kmalloc", "kmem_kmalloc"},
    {"kfree", "kmem_kfree"},
    {"mm_page_", "kmem_mm_page_"},
    {"cpu_idle", "power_cpu_idle"},
    {"cpu_frequency", "power_cpu_frequency"},
    {"machine_suspend", "power_machine_suspend"},
    {"wakeup_source_", "power_wakeup_source_"},
}};

void name_as_lttng(EventFormat& format) {
  format.name = lttng_name(format.name);
  if (!format.name.starts_with("sched_")) {
    return;
  }
  for (EventField& field : format.fields) {
    if (field.name.ends_with("pid")) {
      field.name.replace(field.name.size() - 3, 3, "tid");
    }
  }
}

}  // namespace

std::string lttng_name(const std::string& kernel_name) {
  for (const auto& [from, to] : kNamesOfLttng) {
    if (kernel_name.starts_with(from)) {
      return std::string(to) + kernel_name.substr(from.size());
    }
  }
  return kernel_name;
}

EventFormat parse_event_format(const std::string& text) {
  EventFormat format;
  bool has_id = false;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("name: ")) {
      format.name = line.substr(6);
    } else if (line.starts_with("ID: ")) {
      format.id = static_cast<std::uint16_t>(std::atol(line.c_str() + 4));
      has_id = true;
    } else if (const std::string declaration = value_of(line, "field"); !declaration.empty()) {
      auto field = parse_field(declaration, line);
      if (field && !field->name.starts_with("common_")) {
        format.fields.push_back(std::move(*field));
      }
    }
  }
  if (format.name.empty() || !has_id) {
    throw std::runtime_error("this describes no event: " + text.substr(0, 80));
  }
  name_as_lttng(format);
  return format;
}

}  // namespace tracing::kernel
