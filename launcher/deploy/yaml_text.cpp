// SPDX-License-Identifier: Apache-2.0
#include "launcher/deploy/yaml_text.hpp"

#include <yaml-cpp/yaml.h>

namespace launch {
namespace {

using Json = nlohmann::ordered_json;

void emit(YAML::Emitter& out, const Json& value) {
  if (value.is_object()) {
    out << YAML::BeginMap;
    for (const auto& [key, item] : value.items()) {
      out << YAML::Key << key << YAML::Value;
      emit(out, item);
    }
    out << YAML::EndMap;
  } else if (value.is_array()) {
    out << YAML::BeginSeq;
    for (const Json& item : value) {
      emit(out, item);
    }
    out << YAML::EndSeq;
  } else if (value.is_string()) {
    const std::string text = value.get<std::string>();
    // Whole files stay readable.
    out << (text.find('\n') == std::string::npos ? YAML::DoubleQuoted : YAML::Literal) << text;
  } else if (value.is_boolean()) {
    out << value.get<bool>();
  } else if (value.is_number_float()) {
    out << value.get<double>();
  } else {
    out << value.get<std::int64_t>();
  }
}

}  // namespace

std::string as_yaml(const Json& value) {
  YAML::Emitter out;
  emit(out, value);
  return std::string(out.c_str()) + "\n";
}

}  // namespace launch
