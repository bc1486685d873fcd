// SPDX-License-Identifier: Apache-2.0
#include "launcher/language/parameter_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>

#include "base/text/ascii.hpp"
#include "launcher/frontend/frontend.hpp"
#include "launcher/substitution/boolean.hpp"
#include "launcher/substitution/template_parser.hpp"

namespace launch {

namespace {

constexpr const char* kOtherType = "leave the type out to have the value typed as YAML";
constexpr const char* kNoParameterType = "use a bool, an int, a float, a string, or a list of one of them";

struct NamedType {
  std::string_view name;
  ParameterType type;
  bool list;
};
constexpr NamedType kTypes[] = {
    {"", ParameterType::kAny, false},           {"yaml", ParameterType::kAny, false},
    {"str", ParameterType::kStr, false},        {"bool", ParameterType::kBool, false},
    {"int", ParameterType::kInt, false},        {"float", ParameterType::kFloat, false},
    {"list_of_str", ParameterType::kStr, true}, {"list_of_bool", ParameterType::kBool, true},
    {"list_of_int", ParameterType::kInt, true}, {"list_of_float", ParameterType::kFloat, true},
};

// Digits as Python's int() and float() read them: single underscores between digits are allowed.
std::optional<std::string> python_digits(std::string_view text) {
  text = trim(text);
  if (!text.empty() && text.front() == '+') {
    text.remove_prefix(1);
  }
  std::string digits;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '_') {
      digits += text[i];
      continue;
    }
    const auto is_digit = [&](std::size_t at) { return at < text.size() && text[at] >= '0' && text[at] <= '9'; };
    if (i == 0 || !is_digit(i - 1) || !is_digit(i + 1)) {
      return std::nullopt;
    }
  }
  return digits;
}

template <typename Number>
std::optional<Number> parse_number(std::string_view text) {
  const std::optional<std::string> digits = python_digits(text);
  Number value{};
  if (!digits || digits->empty()) {
    return std::nullopt;
  }
  const char* const end = digits->data() + digits->size();
  const auto result = std::from_chars(digits->data(), end, value);
  return result.ec == std::errc() && result.ptr == end ? std::optional(value) : std::nullopt;
}

ParameterScalar to_parameter(const Scalar& scalar, const SourceRange& where) {
  switch (scalar.type) {
    case Scalar::Type::kBool:
      return scalar.bool_value;
    case Scalar::Type::kInt:
      return scalar.int_value;
    case Scalar::Type::kFloat:
      return scalar.float_value;
    case Scalar::Type::kString:
    case Scalar::Type::kUntyped:
      return scalar.text.text();
    default:
      throw LaunchError(fmt::format("a {} can't be the value of a parameter", type_name(scalar.type)), where,
                        kNoParameterType, Finding::kWrongType);
  }
}

std::optional<ParameterScalar> convert(ParameterType type, const std::string& text) {
  switch (type) {
    case ParameterType::kBool:
      if (const auto value = yaml_boolean(trim(text))) {
        return *value;
      }
      return std::nullopt;
    case ParameterType::kInt:
      if (const auto value = parse_number<std::int64_t>(text)) {
        return *value;
      }
      return std::nullopt;
    case ParameterType::kFloat:
      if (const auto value = parse_number<double>(text)) {
        return *value;
      }
      return std::nullopt;
    default:
      return text;
  }
}

std::string_view type_text_of(ParameterType type) {
  switch (type) {
    case ParameterType::kBool:
      return "bool";
    case ParameterType::kInt:
      return "int";
    case ParameterType::kFloat:
      return "float";
    default:
      return "str";
  }
}

std::string type_with_article(ParameterType type) {
  return fmt::format("{} {}", type == ParameterType::kInt ? "an" : "a", type_text_of(type));
}

bool has_type(ParameterType type, const ParameterScalar& scalar) {
  return (type == ParameterType::kBool && std::holds_alternative<bool>(scalar)) ||
         (type == ParameterType::kInt && std::holds_alternative<std::int64_t>(scalar)) ||
         (type == ParameterType::kFloat && std::holds_alternative<double>(scalar)) ||
         (type == ParameterType::kStr && std::holds_alternative<std::string>(scalar));
}

void require_uniform(const std::vector<ParameterScalar>& items, const char* message, const SourceRange& where) {
  for (const ParameterScalar& item : items) {
    if (item.index() != items.front().index()) {
      throw LaunchError(message, where, kNoParameterType, Finding::kWrongType);
    }
  }
}

}  // namespace

ParameterValueSource::ParameterValueSource(const Value& value, const std::string& type,
                                           const std::optional<std::string>& separator, const SourceRange& type_where)
    : where_(value.where) {
  const NamedType* const named = std::find_if(std::begin(kTypes), std::end(kTypes),
                                              [&](const NamedType& candidate) { return candidate.name == type; });
  if (named == std::end(kTypes)) {
    throw LaunchError(fmt::format("got invalid type identifier '{}'", type), type_where,
                      "str, bool, int, float, list_of_str, list_of_bool, list_of_int, list_of_float or yaml");
  }
  type_ = named->type;
  type_is_list_ = named->list;

  const Scalar* const scalar = value.scalar();
  if (!separator) {
    take_value(value);
  } else if (scalar == nullptr || separator->empty()) {
    throw LaunchError("value-sep needs a text to split and a separator", where_, "write a list instead",
                      Finding::kExclusive);
  } else if (type_ != ParameterType::kAny && !type_is_list_) {
    throw LaunchError(fmt::format("value-sep can't be used with type '{}'", type), type_where,
                      fmt::format("use list_of_{}", type), Finding::kExclusive);
  } else {
    is_list_ = true;
    const std::string& text = scalar->text.text();
    for (std::size_t begin = 0; begin <= text.size();) {
      const std::size_t end = std::min(text.find(*separator, begin), text.size());
      LocatedText piece(text.substr(begin, end - begin), scalar->text.range(begin, end - begin));
      items_.push_back(type_ == ParameterType::kAny ? make_untyped(piece)
                                                    : make_item(Scalar{.text = std::move(piece)}));
      begin = end + separator->size();
    }
  }

  if (!is_list_) {
    return;
  }
  std::vector<ParameterScalar> known;
  for (const Item& item : items_) {
    if (const auto* const finished = std::get_if<ParameterScalar>(&item)) {
      known.push_back(*finished);
    }
  }
  require_uniform(known, "the result is a non-uniform list", where_);
}

void ParameterValueSource::take_value(const Value& value) {
  if (const auto* const list = value.list()) {
    take_items(*list);
    return;
  }
  const Scalar& scalar = *value.scalar();
  if (scalar.made != nullptr && type_is_list_) {
    items_.emplace_back(*scalar.made);
    return;
  }
  if (scalar.type == Scalar::Type::kUntyped && (type_ == ParameterType::kAny || type_is_list_)) {
    std::optional<Value> typed;
    if (scalar.text.text().empty()) {
      items_.emplace_back(ParameterScalar(std::string()));
      return;
    }
    try {
      typed = yaml11_value(scalar.text);
    } catch (const YamlSyntaxError&) {
      // Text that isn't YAML, such as "@x", is a string.
    }
    if (typed && typed->list() != nullptr) {
      take_items(*typed->list());
      return;
    }
    if (!type_is_list_) {
      items_.push_back(typed ? make_item(*typed->scalar()) : make_untyped(scalar.text));
      return;
    }
  }
  if (type_is_list_) {
    throw LaunchError("expected a list", where_, "write [a, b], or split a text with value-sep", Finding::kWrongType);
  }
  items_.push_back(make_item(scalar));
}

void ParameterValueSource::take_items(const std::vector<Value>& values) {
  if (type_ != ParameterType::kAny && !type_is_list_) {
    throw LaunchError(fmt::format("expected {}, got a list", type_with_article(type_)), where_,
                      fmt::format("use list_of_{}", type_text_of(type_)), Finding::kWrongType);
  }
  is_list_ = true;
  for (const Value& value : values) {
    if (value.scalar() == nullptr) {
      throw LaunchError("a list can't hold lists", value.where, kNoParameterType, Finding::kWrongType);
    }
    items_.push_back(make_item(*value.scalar()));
  }
}

// A piece of text without a given type, typed by YAML rules now; text that isn't YAML stays a string.
ParameterValueSource::Item ParameterValueSource::make_untyped(const LocatedText& text) const {
  Scalar scalar;
  scalar.type = Scalar::Type::kString;
  scalar.text = text;
  try {
    const Value typed = yaml11_value(text);
    if (typed.scalar() != nullptr) {
      scalar = *typed.scalar();
    }
  } catch (const YamlSyntaxError&) {
  }
  return make_item(scalar);
}

ParameterValueSource::Item ParameterValueSource::make_item(const Scalar& scalar) const {
  const SourceRange where = scalar.text.range() ? scalar.text.range() : where_;
  const bool is_text = scalar.type == Scalar::Type::kUntyped || scalar.type == Scalar::Type::kString;
  if (!is_text) {
    ParameterScalar value = to_parameter(scalar, where);
    if (type_ != ParameterType::kAny && !has_type(type_, value)) {
      throw LaunchError(fmt::format("expected {}, got '{}'", type_with_article(type_), scalar.text.text()), where,
                        kOtherType, Finding::kWrongType);
    }
    return value;
  }
  Template parsed = scalar.made != nullptr ? *scalar.made : parse_template(scalar.text);
  if (!parsed.is_literal()) {
    return parsed;
  }
  Scope nothing;
  std::string text = parsed.perform(nothing);
  if (type_ == ParameterType::kAny) {
    return ParameterScalar(std::move(text));
  }
  std::optional<ParameterScalar> value = convert(type_, text);
  if (!value) {
    throw LaunchError(fmt::format("expected {}, got '{}'", type_with_article(type_), text), where, kOtherType,
                      Finding::kWrongType);
  }
  return std::move(*value);
}

ParameterValue ParameterValueSource::type_text(const std::string& text, const SourceRange& where) const {
  if (type_ != ParameterType::kAny) {
    std::optional<ParameterScalar> value = convert(type_, text);
    if (!value) {
      throw LaunchError(fmt::format("expected {}, got '{}'", type_with_article(type_), text), where, kOtherType,
                        Finding::kWrongType);
    }
    return std::move(*value);
  }
  return typed_parameter(text, where);
}

// The value of a text that holds a whole list. Only a Python launch file can ask for this.
ParameterValue ParameterValueSource::typed_list(const std::string& text, const SourceRange& where) const {
  ParameterValue value = typed_parameter(text, where);
  const auto* const items = std::get_if<std::vector<ParameterScalar>>(&value);
  if (items == nullptr || !std::all_of(items->begin(), items->end(),
                                       [this](const ParameterScalar& item) { return has_type(type_, item); })) {
    throw LaunchError(fmt::format("expected a list of {}, got '{}'", type_text_of(type_), text), where, kOtherType,
                      Finding::kWrongType);
  }
  return value;
}

ParameterValue ParameterValueSource::perform(Scope& scope) const {
  if (!is_list_) {
    if (const auto* const finished = std::get_if<ParameterScalar>(&items_.front())) {
      return *finished;
    }
    const Template& source = std::get<Template>(items_.front());
    return type_is_list_ ? typed_list(source.perform(scope), source.where())
                         : type_text(source.perform(scope), source.where());
  }
  std::vector<ParameterScalar> values;
  for (const Item& item : items_) {
    if (const auto* const finished = std::get_if<ParameterScalar>(&item)) {
      values.push_back(*finished);
      continue;
    }
    const Template& source = std::get<Template>(item);
    ParameterValue value = type_text(source.perform(scope), source.where());
    if (!std::holds_alternative<ParameterScalar>(value)) {
      throw LaunchError("a list can't hold lists", source.where(), kNoParameterType, Finding::kWrongType);
    }
    values.push_back(std::get<ParameterScalar>(std::move(value)));
  }
  require_uniform(values, "the output list is not uniform", where_);
  return values;
}

ParameterValue parameter_of(const Value& value) {
  if (value.scalar() != nullptr) {
    return to_parameter(*value.scalar(), value.where);
  }
  std::vector<ParameterScalar> items;
  for (const Value& item : *value.list()) {
    if (item.scalar() == nullptr) {
      throw LaunchError("a list can't hold lists", value.where, kNoParameterType, Finding::kWrongType);
    }
    items.push_back(to_parameter(*item.scalar(), value.where));
  }
  require_uniform(items, "the output list is not uniform", value.where);
  return items;
}

ParameterValue typed_parameter(const std::string& text, const SourceRange& where) {
  if (text.empty()) {
    return ParameterScalar(std::string());
  }
  // The performed text is in no file, so errors point at the template that gave it.
  std::optional<Value> typed;
  try {
    typed = yaml11_value(LocatedText(text));
  } catch (const YamlSyntaxError&) {
    return ParameterScalar(text);
  } catch (const LaunchError& error) {
    throw LaunchError(fmt::format("{}: '{}'", error.diagnostics().front().message, text), where, kNoParameterType,
                      Finding::kWrongType);
  }
  typed->where = where;
  return parameter_of(*typed);
}

}  // namespace launch
