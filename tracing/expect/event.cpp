// SPDX-License-Identifier: Apache-2.0
#include "launch_trace_testing/event.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <ostream>
#include <stdexcept>
#include <utility>

namespace launch_trace_testing {

namespace {

std::string fields_text(const EventClass& event_class) {
  if (event_class.fields.empty()) {
    return "no field";
  }
  return fmt::format("{}", fmt::join(event_class.fields, ", "));
}

}  // namespace

std::optional<std::uint64_t> Value::unsigned_integer() const {
  if (const auto* const number = std::get_if<std::uint64_t>(&data)) {
    return *number;
  }
  const auto whole = integer();
  return whole && *whole >= 0 ? std::optional(static_cast<std::uint64_t>(*whole)) : std::nullopt;
}

std::optional<std::int64_t> Value::integer() const {
  if (const auto* const number = std::get_if<std::int64_t>(&data)) {
    return *number;
  }
  if (const auto* const enumeration = std::get_if<Enumeration>(&data)) {
    return enumeration->number;
  }
  const auto* const number = std::get_if<std::uint64_t>(&data);
  return number != nullptr && std::in_range<std::int64_t>(*number) ? std::optional(static_cast<std::int64_t>(*number))
                                                                   : std::nullopt;
}

std::optional<double> Value::real() const {
  if (const auto* const number = std::get_if<double>(&data)) {
    return *number;
  }
  if (const auto* const number = std::get_if<std::uint64_t>(&data)) {
    return static_cast<double>(*number);
  }
  const auto whole = integer();
  return whole ? std::optional(static_cast<double>(*whole)) : std::nullopt;
}

std::optional<std::string_view> Value::text() const {
  if (const auto* const string = std::get_if<std::string>(&data)) {
    return *string;
  }
  const auto* const enumeration = std::get_if<Enumeration>(&data);
  return enumeration != nullptr && !enumeration->label.empty() ? std::optional<std::string_view>(enumeration->label)
                                                               : std::nullopt;
}

std::string to_string(const Value& value) {
  struct Text {
    bool hexadecimal;
    std::string operator()(std::uint64_t number) const {
      return hexadecimal ? fmt::format("{:#x}", number) : fmt::format("{}", number);
    }
    std::string operator()(std::int64_t number) const { return fmt::format("{}", number); }
    std::string operator()(double number) const { return fmt::format("{}", number); }
    std::string operator()(const std::string& text) const { return fmt::format("\"{}\"", text); }
    std::string operator()(const Value::Enumeration& enumeration) const {
      return enumeration.label.empty() ? fmt::format("{}", enumeration.number) : enumeration.label;
    }
    std::string operator()(const Value::Array& elements) const {
      std::vector<std::string> texts;
      for (const Value& element : elements) {
        texts.push_back(to_string(element));
      }
      return fmt::format("({})", fmt::join(texts, " "));
    }
    std::string operator()(const Value::Structure& members) const {
      std::vector<std::string> texts;
      for (const Value::Member& member : members) {
        texts.push_back(member.name + "=" + to_string(member.value));
      }
      return fmt::format("({})", fmt::join(texts, " "));
    }
  };
  return std::visit(Text{value.hexadecimal}, value.data);
}

const Value* Event::find(std::string_view field) const {
  const auto index_in = [&](const std::vector<std::string>& names) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), field) - names.begin());
  };
  const std::size_t index = index_in(class_->fields);
  if (index < class_->fields.size()) {
    return &values_[index];
  }
  const std::size_t context = index_in(class_->contexts);
  return context < class_->contexts.size() ? &values_[class_->fields.size() + context] : nullptr;
}

const Value& Event::at(std::string_view field) const {
  if (const Value* const value = find(field)) {
    return *value;
  }
  throw std::out_of_range(fmt::format("{} has no field '{}'; it has {}", name(), field, fields_text(*class_)));
}

namespace {

[[noreturn]] void fail_kind(const Event& event, std::string_view field, std::string_view kind) {
  throw std::invalid_argument(
      fmt::format("the field {} of {} is {}, which is no {}", field, event.name(), to_string(event.at(field)), kind));
}

}  // namespace

std::uint64_t Event::handle(std::string_view field) const {
  const auto value = at(field).unsigned_integer();
  if (!value) {
    fail_kind(*this, field, "handle");
  }
  return *value;
}

std::int64_t Event::number(std::string_view field) const {
  const auto value = at(field).integer();
  if (!value) {
    fail_kind(*this, field, "integer of 64 bits with a sign");
  }
  return *value;
}

const std::string& Event::text(std::string_view field) const {
  const auto* const value = std::get_if<std::string>(&at(field).data);
  if (value == nullptr) {
    fail_kind(*this, field, "text");
  }
  return *value;
}

std::string to_string(const Event& event) {
  std::string text = event.name();
  for (const std::string& field : event.event_class().fields) {
    text += fmt::format(" {}={}", field, to_string(event.at(field)));
  }
  return text + fmt::format(" of {}[{}/{}]", event.procname(), event.vpid(), event.vtid());
}

std::ostream& operator<<(std::ostream& stream, const Event& event) {
  return stream << to_string(event);
}

}  // namespace launch_trace_testing
