// SPDX-License-Identifier: Apache-2.0
#include "launch_trace/event.hpp"

#include <algorithm>

#include "tracing/decode/cpp_api/access.hpp"

namespace launch_trace {

namespace {

std::optional<std::size_t> index_in(const std::vector<std::string>& names, std::string_view name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    return std::nullopt;
  }
  return static_cast<std::size_t>(found - names.begin());
}

}  // namespace

std::optional<std::size_t> EventClass::field_index(std::string_view field) const {
  return index_in(fields, field);
}

std::optional<std::size_t> EventClass::context_index(std::string_view context) const {
  return index_in(contexts, context);
}

Value::Kind Value::kind() const {
  const tracing::FieldValue& field = Access::field(*this);
  if (field.unsigned_integer()) {
    return Kind::kUnsigned;
  }
  if (field.integer()) {
    return Kind::kSigned;
  }
  if (field.real()) {
    return Kind::kReal;
  }
  if (field.is_structure()) {
    return Kind::kStructure;
  }
  if (field.is_variant()) {
    return Kind::kVariant;
  }
  return field.is_array() ? Kind::kArray : Kind::kString;
}

std::optional<std::uint64_t> Value::unsigned_integer() const {
  return Access::field(*this).unsigned_integer();
}

std::optional<std::int64_t> Value::integer() const {
  return Access::field(*this).integer();
}

std::optional<double> Value::real() const {
  return Access::field(*this).real();
}

std::optional<std::string_view> Value::string() const {
  return Access::field(*this).string();
}

std::optional<std::string_view> Value::label() const {
  return Access::field(*this).enumeration_label();
}

bool Value::is_hexadecimal() const {
  return Access::field(*this).is_hexadecimal();
}

std::size_t Value::size() const {
  return Access::field(*this).size();
}

Value Value::operator[](std::size_t index) const {
  return Access::value(Access::field(*this)[index]);
}

std::string_view Value::member_name(std::size_t index) const {
  return Access::field(*this).member_name(index);
}

std::optional<std::int64_t> Event::cpu_id() const {
  return Access::event(*this).cpu_id;
}

std::optional<std::int64_t> Event::vpid() const {
  return Access::event(*this).vpid;
}

std::optional<std::int64_t> Event::vtid() const {
  return Access::event(*this).vtid;
}

std::optional<std::string_view> Event::procname() const {
  return Access::event(*this).procname;
}

Value Event::field(std::size_t index) const {
  const tracing::Event& event = Access::event(*this);
  if (event.record != nullptr) {
    return Access::value(tracing::FieldValue((*event.record)[index]));  // without a call
  }
  return Access::value(event.field(index));
}

std::optional<Value> Event::field(std::string_view name) const {
  const std::optional<std::size_t> index = class_->field_index(name);
  return index ? std::optional(field(*index)) : std::nullopt;
}

Value Event::context(std::size_t index) const {
  return Access::value(Access::event(*this).context(index));
}

std::optional<Value> Event::context(std::string_view name) const {
  const std::optional<std::size_t> index = class_->context_index(name);
  return index ? std::optional(context(*index)) : std::nullopt;
}

}  // namespace launch_trace
