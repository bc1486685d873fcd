// SPDX-License-Identifier: Apache-2.0
#include "launcher/language/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "base/text/ascii.hpp"
#include "launcher/substitution/boolean.hpp"

namespace launch {

namespace {

bool to_boolean(const std::string& text, const SourceRange& where) {
  const std::optional<bool> value = yaml_boolean(text);
  if (!value) {
    throw LaunchError(fmt::format("expected a boolean, got '{}'", text), where, "write true or false",
                      Finding::kWrongType);
  }
  return *value;
}

}  // namespace

BooleanField::BooleanField(Template source) : source_(std::move(source)) {
  if (source_->is_literal()) {
    Scope nothing;
    fallback_ = to_boolean(source_->perform(nothing), source_->where());
    source_.reset();
  }
}

bool BooleanField::perform(Scope& scope) const {
  return source_ ? to_boolean(source_->perform(scope), source_->where()) : fallback_;
}

NumberField::NumberField(Template source, bool whole) : source_(std::move(source)), whole_(whole) {
  if (source_.is_literal()) {
    Scope nothing;
    convert(source_.perform(nothing));
  }
}

double NumberField::convert(const std::string& text) const {
  std::string_view digits = trim(text);
  if (!digits.empty() && digits.front() == '+') {
    digits.remove_prefix(1);
  }
  double value = 0.0;
  std::int64_t whole_value = 0;
  const char* const end = digits.data() + digits.size();
  const auto result =
      whole_ ? std::from_chars(digits.data(), end, whole_value) : std::from_chars(digits.data(), end, value);
  if (digits.empty() || result.ec != std::errc() || result.ptr != end) {
    throw LaunchError(fmt::format("expected a {}, got '{}'", whole_ ? "whole number" : "number", text), source_.where(),
                      whole_ ? "write digits, such as 3" : "write a number without its unit, such as 0.5",
                      Finding::kWrongType);
  }
  if (whole_) {
    value = static_cast<double>(whole_value);
  }
  if (not_negative_ && !(value >= 0.0)) {
    throw LaunchError(fmt::format("expected a number that is not negative, got '{}'", text), source_.where(),
                      "write 0 or more", Finding::kWrongType);
  }
  return value;
}

double NumberField::perform(Scope& scope) const {
  return convert(source_.perform(scope));
}

void NumberField::require_not_negative() {
  not_negative_ = true;
  if (source_.is_literal()) {
    Scope nothing;
    convert(source_.perform(nothing));
  }
}

Fields::Fields(SourceRange where) : where_(std::move(where)) {}

const Fields::Entry* Fields::find(std::string_view attribute) const {
  const auto found =
      std::find_if(attributes_.begin(), attributes_.end(), [&](const Entry& entry) { return entry.name == attribute; });
  return found == attributes_.end() ? nullptr : &*found;
}

const SourceRange& Fields::where(std::string_view attribute) const {
  const Entry* const found = find(attribute);
  return found == nullptr ? where_ : found->where;
}

const Template& Fields::text(std::string_view attribute) const {
  return get<Template>(attribute);
}

std::optional<Template> Fields::optional_text(std::string_view attribute) const {
  return has(attribute) ? std::optional(text(attribute)) : std::nullopt;
}

std::string Fields::literal(std::string_view attribute, std::string fallback) const {
  return has(attribute) ? get<std::string>(attribute) : std::move(fallback);
}

std::vector<Template> Fields::words(std::string_view attribute) const {
  return optional_words(attribute).value_or(std::vector<Template>{});
}

std::optional<std::vector<Template>> Fields::optional_words(std::string_view attribute) const {
  if (!has(attribute)) {
    return std::nullopt;
  }
  return get<std::vector<Template>>(attribute);
}

BooleanField Fields::boolean(std::string_view attribute, bool fallback) const {
  return has(attribute) ? get<BooleanField>(attribute) : BooleanField(fallback);
}

std::optional<NumberField> Fields::number(std::string_view attribute) const {
  if (!has(attribute)) {
    return std::nullopt;
  }
  return get<NumberField>(attribute);
}

const Value& Fields::value(std::string_view attribute) const {
  return get<Value>(attribute);
}

std::vector<const Fields*> Fields::items(std::string_view tag) const {
  const auto is_meant = [&](const Item& item) { return item.tag == tag; };
  std::vector<const Fields*> found;
  found.reserve(static_cast<std::size_t>(std::count_if(items_.begin(), items_.end(), is_meant)));
  for (const Item& item : items_) {
    if (is_meant(item)) {
      found.push_back(&item.fields);
    }
  }
  return found;
}

}  // namespace launch
