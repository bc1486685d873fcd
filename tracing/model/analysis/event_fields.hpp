// SPDX-License-Identifier: Apache-2.0
// Fields of an event by name: empty or 0 if it has none of this name.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "tracing/decode/reader/event.hpp"

namespace tracing {

inline std::string text_of(const Event& event, std::string_view field) {
  const std::optional<FieldValue> value = event.field(field);
  return std::string(value ? value->string().value_or("") : "");
}

inline std::int64_t number_of(const Event& event, std::string_view field) {
  const std::optional<FieldValue> value = event.field(field);
  return value ? value->integer().value_or(0) : 0;
}

}  // namespace tracing
