// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/reader/event.hpp"

#include <babeltrace2/babeltrace.h>

#include <algorithm>
#include <limits>

namespace tracing {

namespace {

std::optional<std::size_t> index_in(const std::vector<std::string>& names, std::string_view name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    return std::nullopt;
  }
  return static_cast<std::size_t>(found - names.begin());
}

}  // namespace

std::optional<std::size_t> EventClass::index_of(std::string_view field) const {
  return index_in(fields, field);
}

std::optional<std::size_t> EventClass::index_of_context(std::string_view context) const {
  return index_in(contexts, context);
}

std::optional<std::uint64_t> FieldValue::foreign_unsigned_integer() const {
  if (!bt_field_class_type_is(bt_field_get_class_type(foreign_), BT_FIELD_CLASS_TYPE_UNSIGNED_INTEGER)) {
    return std::nullopt;
  }
  return bt_field_integer_unsigned_get_value(foreign_);
}

std::optional<std::int64_t> FieldValue::foreign_integer() const {
  const bt_field_class_type type = bt_field_get_class_type(foreign_);
  if (bt_field_class_type_is(type, BT_FIELD_CLASS_TYPE_SIGNED_INTEGER)) {
    return bt_field_integer_signed_get_value(foreign_);
  }
  if (bt_field_class_type_is(type, BT_FIELD_CLASS_TYPE_UNSIGNED_INTEGER)) {
    const std::uint64_t value = bt_field_integer_unsigned_get_value(foreign_);
    if (value <= static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())) {
      return static_cast<std::int64_t>(value);
    }
  }
  return std::nullopt;
}

std::optional<double> FieldValue::real() const {
  if (foreign_ == nullptr) {
    return direct_.real();
  }
  switch (bt_field_get_class_type(foreign_)) {
    case BT_FIELD_CLASS_TYPE_SINGLE_PRECISION_REAL:
      return bt_field_real_single_precision_get_value(foreign_);
    case BT_FIELD_CLASS_TYPE_DOUBLE_PRECISION_REAL:
      return bt_field_real_double_precision_get_value(foreign_);
    default:
      return std::nullopt;
  }
}

std::optional<std::string_view> FieldValue::string() const {
  if (foreign_ == nullptr) {
    return direct_.string();
  }
  if (bt_field_get_class_type(foreign_) != BT_FIELD_CLASS_TYPE_STRING) {
    return std::nullopt;
  }
  return std::string_view(bt_field_string_get_value(foreign_), bt_field_string_get_length(foreign_));
}

bool FieldValue::is_hexadecimal() const {
  if (foreign_ == nullptr) {
    return direct_.type->is_number() && direct_.type->base == 16;
  }
  const bt_field_class* const type = bt_field_borrow_class_const(foreign_);
  return bt_field_class_type_is(bt_field_class_get_type(type), BT_FIELD_CLASS_TYPE_INTEGER) &&
         bt_field_class_integer_get_preferred_display_base(type) ==
             BT_FIELD_CLASS_INTEGER_PREFERRED_DISPLAY_BASE_HEXADECIMAL;
}

bool FieldValue::is_foreign_enumeration() const {
  return bt_field_class_type_is(bt_field_get_class_type(foreign_), BT_FIELD_CLASS_TYPE_ENUMERATION);
}

bool FieldValue::is_array() const {
  if (foreign_ != nullptr) {
    return bt_field_class_type_is(bt_field_get_class_type(foreign_), BT_FIELD_CLASS_TYPE_ARRAY);
  }
  const ctf::FieldKind kind = direct_.type->kind;
  return (kind == ctf::FieldKind::kArray || kind == ctf::FieldKind::kSequence) && !direct_.type->is_characters();
}

bool FieldValue::is_structure() const {
  if (foreign_ == nullptr) {
    return direct_.type->kind == ctf::FieldKind::kStructure;
  }
  return bt_field_get_class_type(foreign_) == BT_FIELD_CLASS_TYPE_STRUCTURE;
}

bool FieldValue::is_variant() const {
  if (foreign_ == nullptr) {
    return direct_.type->kind == ctf::FieldKind::kVariant;
  }
  return bt_field_class_type_is(bt_field_get_class_type(foreign_), BT_FIELD_CLASS_TYPE_VARIANT);
}

std::size_t FieldValue::size() const {
  if (is_variant()) {
    return 1;
  }
  if (is_structure()) {
    return foreign_ == nullptr ? direct_.type->members.size()
                               : bt_field_class_structure_get_member_count(bt_field_borrow_class_const(foreign_));
  }
  if (!is_array()) {
    return 0;
  }
  return foreign_ == nullptr ? direct_.length : bt_field_array_get_length(foreign_);
}

FieldValue FieldValue::operator[](std::size_t index) const {
  if (foreign_ == nullptr) {
    return FieldValue(direct_.child(index));
  }
  if (is_variant()) {
    return FieldValue(bt_field_variant_borrow_selected_option_field_const(foreign_));
  }
  if (is_structure()) {
    return FieldValue(bt_field_structure_borrow_member_field_by_index_const(foreign_, index));
  }
  return FieldValue(bt_field_array_borrow_element_field_by_index_const(foreign_, index));
}

std::string_view FieldValue::member_name(std::size_t index) const {
  if (foreign_ == nullptr) {
    return direct_.type->members[index].name;
  }
  return bt_field_class_structure_member_get_name(
      bt_field_class_structure_borrow_member_by_index_const(bt_field_borrow_class_const(foreign_), index));
}

std::optional<std::string_view> FieldValue::enumeration_label() const {
  if (foreign_ == nullptr) {
    const std::string_view label = direct_.label();
    return label.empty() ? std::nullopt : std::optional(label);
  }
  const bt_field_class_type type = bt_field_get_class_type(foreign_);
  bt_field_class_enumeration_mapping_label_array labels = nullptr;
  std::uint64_t count = 0;
  if (type == BT_FIELD_CLASS_TYPE_UNSIGNED_ENUMERATION) {
    bt_field_enumeration_unsigned_get_mapping_labels(foreign_, &labels, &count);
  } else if (type == BT_FIELD_CLASS_TYPE_SIGNED_ENUMERATION) {
    bt_field_enumeration_signed_get_mapping_labels(foreign_, &labels, &count);
  }
  return count == 0 ? std::nullopt : std::optional<std::string_view>(labels[0]);
}

FieldValue Event::foreign_field(std::size_t index) const {
  return FieldValue(bt_field_structure_borrow_member_field_by_index_const(foreign_payload, index));
}

std::optional<FieldValue> Event::field(std::string_view field_name) const {
  const std::optional<std::size_t> index = event_class->index_of(field_name);
  if (!index) {
    return std::nullopt;
  }
  return field(*index);
}

FieldValue Event::context(std::size_t index) const {
  const bool is_of_stream = index < event_class->stream_contexts;
  const std::size_t member = is_of_stream ? index : index - event_class->stream_contexts;
  if (record != nullptr) {
    return FieldValue((is_of_stream ? *stream_context : *event_context)[member]);
  }
  const bt_field* const structure = is_of_stream ? foreign_stream_context : foreign_event_context;
  return FieldValue(bt_field_structure_borrow_member_field_by_index_const(structure, member));
}

std::optional<FieldValue> Event::context(std::string_view context_name) const {
  const std::optional<std::size_t> index = event_class->index_of_context(context_name);
  if (!index) {
    return std::nullopt;
  }
  return context(*index);
}

}  // namespace tracing
