// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/objects/process_doubt.hpp"

#include <optional>
#include <utility>

namespace tracing {

namespace {

constexpr std::int64_t kNeighbours = 1'000'000;   // ns; a tracepoint takes less, unless its thread has to wait
constexpr std::uint64_t kLeastAddress = 1 << 16;  // smaller numbers are no addresses

// All fields as text. `has_address`: one of them is an address.
std::string fields_of(const Event& event, bool& has_address) {
  std::string text;
  for (std::size_t i = 0; i < event.event_class->fields.size(); ++i) {
    const FieldValue field = event.field(i);
    if (const std::optional<std::uint64_t> number = field.unsigned_integer()) {
      has_address = has_address || (field.is_hexadecimal() && *number >= kLeastAddress);
      text += std::to_string(*number);
    } else if (const std::optional<std::int64_t> with_sign = field.integer()) {
      text += std::to_string(*with_sign);
    } else if (const std::optional<std::string_view> characters = field.string()) {
      text += *characters;
    }
    text += '\0';
  }
  return text;
}

}  // namespace

bool ProcessDoubt::is_copy(const Event& event, std::uint32_t process) {
  ++(process == other_ ? events_of_other_ : events_);
  bool has_address = false;
  std::string fields = fields_of(event, has_address);
  const std::int64_t vtid = event.vtid.value_or(0);
  const bool is_copy = has_address && process != process_ && event.name() == name_ && vtid == vtid_ &&
                       event.timestamp_ns - time_ns_ < kNeighbours && fields == fields_;
  process_ = process;
  name_ = event.name();
  vtid_ = vtid;
  time_ns_ = event.timestamp_ns;
  fields_ = std::move(fields);
  return is_copy;
}

}  // namespace tracing
