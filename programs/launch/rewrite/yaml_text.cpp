// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/rewrite/yaml_text.hpp"

#include <fmt/format.h>

#include "base/diagnostics/diagnostic.hpp"
#include "base/text/quoted_text.hpp"
#include "launcher/frontend/frontend.hpp"

namespace launch {

namespace {

using Type = Scalar::Type;

Type type_of(std::string_view text) {
  return yaml11_scalar(LocatedText(std::string(text))).type;
}

// Whether the text, without quotes, is one scalar.
bool may_be_plain(std::string_view text, bool in_flow) {
  if (text.empty() || text.front() == ' ' || text.back() == ' ' || text.back() == ':' ||
      std::string_view("-?:,[]{}#&*!|>'\"%@`").find(text.front()) != std::string_view::npos) {
    return false;
  }
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < ' ' ||
        (in_flow && std::string_view(",[]{}").find(c) != std::string_view::npos)) {
      return false;
    }
  }
  return text.find(": ") == std::string_view::npos && text.find(" #") == std::string_view::npos;
}

bool is_number_like(std::string_view text) {
  return text.find_first_not_of("+-.0123456789eExX_abcdefABCDEF:") == std::string_view::npos;
}

std::string quoted(std::string_view text) {
  const bool has_controls = text.find_first_of("\n\t\r") != std::string_view::npos;
  if (!has_controls && text.find_first_of("\"\\") != std::string_view::npos) {
    std::string result = "'";
    for (const char c : text) {
      result += c == '\'' ? "''" : std::string(1, c);
    }
    return result + "'";
  }
  return backslash_quoted(text, '"');
}

// The value of a parameter in XML: the launcher reads it by the rules of YAML.
std::string parameter_text(const std::string& text, bool in_flow) {
  if (text.empty() || text.find("$(") != std::string::npos) {
    return yaml_string(text, in_flow);
  }
  try {
    const Value read = yaml11_value(LocatedText(text));
    if (read.list() != nullptr) {
      return text.find('\n') == std::string::npos && text.starts_with('[') ? text : yaml_string(text, in_flow);
    }
    if (read.scalar()->type != Type::kString && (may_be_plain(text, in_flow) || is_number_like(text))) {
      return text;
    }
    const bool has_quotes = text.starts_with('"') || text.starts_with('\'');
    return has_quotes && read.scalar()->type == Type::kString && read.scalar()->text.text() != text
               ? text
               : yaml_string(text, in_flow);
  } catch (const LaunchError&) {
    return yaml_string(text, in_flow);  // no YAML: the launcher takes the text itself
  }
}

}  // namespace

std::string yaml_string(std::string_view text, bool in_flow) {
  return may_be_plain(text, in_flow) && type_of(text) == Type::kString ? std::string(text) : quoted(text);
}

std::string yaml_value(const Value& value, AttributeType type, bool in_flow) {
  if (const auto* const list = value.list()) {
    std::string text;
    for (const Value& item : *list) {
      text += (text.empty() ? "" : ", ") + yaml_value(item, type, true);
    }
    return "[" + text + "]";
  }
  const Scalar& scalar = *value.scalar();
  const std::string& text = scalar.text.text();
  if (scalar.type == Type::kString) {
    return yaml_string(text, in_flow);
  }
  if (scalar.type != Type::kUntyped) {
    return text;
  }
  switch (type) {
    case AttributeType::kBoolean:
      return type_of(text) == Type::kBool ? text : yaml_string(text, in_flow);
    case AttributeType::kFloat:
      // ROS 2 takes no whole number for a float in YAML.
      if (!text.empty() && text.find_first_not_of("0123456789") == std::string::npos) {
        return text + ".0";
      }
      [[fallthrough]];
    case AttributeType::kInteger:
      return type_of(text) == Type::kInt || type_of(text) == Type::kFloat ? text : yaml_string(text, in_flow);
    case AttributeType::kParameter:
      return parameter_text(text, in_flow);
    default:
      return yaml_string(text, in_flow);
  }
}

}  // namespace launch
