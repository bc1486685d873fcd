// SPDX-License-Identifier: Apache-2.0
#include "tracing/reader/event.hpp"

#include <babeltrace2/babeltrace.h>

#include <algorithm>
#include <limits>

namespace tracing {

std::optional<std::size_t> EventClass::index_of(std::string_view field) const {
  const auto found = std::find(fields.begin(), fields.end(), field);
  if (found == fields.end()) return std::nullopt;
  return static_cast<std::size_t>(found - fields.begin());
}

std::optional<std::uint64_t> FieldValue::unsigned_integer() const {
  if (!bt_field_class_type_is(bt_field_get_class_type(field_), BT_FIELD_CLASS_TYPE_UNSIGNED_INTEGER)) {
    return std::nullopt;
  }
  return bt_field_integer_unsigned_get_value(field_);
}

std::optional<std::int64_t> FieldValue::integer() const {
  const bt_field_class_type type = bt_field_get_class_type(field_);
  if (bt_field_class_type_is(type, BT_FIELD_CLASS_TYPE_SIGNED_INTEGER)) {
    return bt_field_integer_signed_get_value(field_);
  }
  if (bt_field_class_type_is(type, BT_FIELD_CLASS_TYPE_UNSIGNED_INTEGER)) {
    const std::uint64_t value = bt_field_integer_unsigned_get_value(field_);
    if (value <= static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())) {
      return static_cast<std::int64_t>(value);
    }
  }
  return std::nullopt;
}

std::optional<double> FieldValue::real() const {
  switch (bt_field_get_class_type(field_)) {
    case BT_FIELD_CLASS_TYPE_SINGLE_PRECISION_REAL:
      return bt_field_real_single_precision_get_value(field_);
    case BT_FIELD_CLASS_TYPE_DOUBLE_PRECISION_REAL:
      return bt_field_real_double_precision_get_value(field_);
    default:
      return std::nullopt;
  }
}

std::optional<std::string_view> FieldValue::string() const {
  if (bt_field_get_class_type(field_) != BT_FIELD_CLASS_TYPE_STRING) return std::nullopt;
  return std::string_view(bt_field_string_get_value(field_), bt_field_string_get_length(field_));
}

bool FieldValue::is_array() const {
  return bt_field_class_type_is(bt_field_get_class_type(field_), BT_FIELD_CLASS_TYPE_ARRAY);
}

std::size_t FieldValue::size() const {
  return is_array() ? bt_field_array_get_length(field_) : 0;
}

FieldValue FieldValue::operator[](std::size_t index) const {
  return FieldValue(bt_field_array_borrow_element_field_by_index_const(field_, index));
}

FieldValue Event::field(std::size_t index) const {
  return FieldValue(bt_field_structure_borrow_member_field_by_index_const(payload, index));
}

std::optional<FieldValue> Event::field(std::string_view field_name) const {
  const std::optional<std::size_t> index = event_class->index_of(field_name);
  if (!index) return std::nullopt;
  return field(*index);
}

}  // namespace tracing
