// SPDX-License-Identifier: Apache-2.0
#include "launcher/plan/parameter_json.hpp"

#include <cmath>
#include <cstdlib>
#include <regex>

#include "launcher/frontend/yaml_document.hpp"

namespace launch {

namespace {

using Json = nlohmann::ordered_json;

Json number_as_json(double value) {
  if (std::isfinite(value)) {
    return value;
  }
  return {{"$float", std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf"}};
}

Json scalar_as_json(const ParameterScalar& scalar) {
  if (const double* const number = std::get_if<double>(&scalar)) {
    return number_as_json(*number);
  }
  if (const std::byte* const byte = std::get_if<std::byte>(&scalar)) {
    return std::to_integer<int>(*byte);
  }
  return std::visit([](const auto& value) { return Json(value); }, scalar);
}

// Types a plain scalar as rcl_yaml_param_parser does.
Json plain_scalar_as_json(const std::string& text) {
  static const std::regex true_word("y|Y|yes|Yes|YES|true|True|TRUE|on|On|ON");
  static const std::regex false_word("n|N|no|No|NO|false|False|FALSE|off|Off|OFF");
  static const std::regex integer("[-+]?(?:0x[0-9a-fA-F]+|0[0-7]*|[1-9][0-9]*)");
  static const std::regex real("[-+]?(?:[0-9]+(?:\\.[0-9]*)?|\\.[0-9]+)(?:[eE][-+]?[0-9]+)?");
  static const std::regex infinite("([-+]?)\\.(?:inf|Inf|INF)");
  static const std::regex not_a_number("\\.(?:nan|NaN|NAN)");
  static const std::regex null("~|null|Null|NULL|");
  std::smatch match;
  if (std::regex_match(text, true_word)) {
    return true;
  }
  if (std::regex_match(text, false_word)) {
    return false;
  }
  if (std::regex_match(text, integer)) {
    return std::strtoll(text.c_str(), nullptr, 0);
  }
  if (std::regex_match(text, real)) {
    return std::strtod(text.c_str(), nullptr);
  }
  if (std::regex_match(text, match, infinite)) {
    return number_as_json(match[1] == "-" ? -INFINITY : INFINITY);
  }
  if (std::regex_match(text, not_a_number)) {
    return number_as_json(NAN);
  }
  return std::regex_match(text, null) ? Json(nullptr) : Json(text);
}

Json node_as_json(const YamlNode& node) {
  switch (node.kind) {
    case YamlNode::Kind::kMapping: {
      Json object = Json::object();
      for (const YamlEntry& entry : node.entries) {
        object[entry.key.scalar.text.text()] = node_as_json(entry.value);
      }
      return object;
    }
    case YamlNode::Kind::kSequence: {
      Json array = Json::array();
      for (const YamlNode& item : node.items) {
        array.push_back(node_as_json(item));
      }
      return array;
    }
    case YamlNode::Kind::kScalar:
      break;
  }
  // A scalar with a tag counts as text, as one in quotes does.
  return node.is_plain || node.is_null() ? plain_scalar_as_json(node.scalar.text.text())
                                         : Json(node.scalar.text.text());
}

}  // namespace

nlohmann::ordered_json parameter_as_json(const ParameterValue& value) {
  if (const auto* const scalar = std::get_if<ParameterScalar>(&value)) {
    return scalar_as_json(*scalar);
  }
  Json array = Json::array();
  for (const ParameterScalar& item : std::get<std::vector<ParameterScalar>>(value)) {
    array.push_back(scalar_as_json(item));
  }
  return array;
}

std::string parameter_type_name(const ParameterValue& value) {
  static constexpr const char* kNames[] = {"bool", "integer", "double", "string", "byte"};
  if (const auto* const scalar = std::get_if<ParameterScalar>(&value)) {
    return kNames[scalar->index()];
  }
  // A list without items has the type that ros2 launch gives it.
  const auto& items = std::get<std::vector<ParameterScalar>>(value);
  return items.empty() ? "byte_array" : std::string(kNames[items.front().index()]) + "_array";
}

nlohmann::ordered_json parameter_file_as_json(const std::string& text) {
  try {
    std::vector<Diagnostic> duplicate_keys;  // the last one counts
    return node_as_json(read_yaml(LocatedText(text), duplicate_keys));
  } catch (const LaunchError&) {
    return text;
  }
}

}  // namespace launch
