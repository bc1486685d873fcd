// SPDX-License-Identifier: Apache-2.0
#include "launcher/deploy/yaml_text.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>

namespace launch {
namespace {

using Json = nlohmann::ordered_json;

// Whole files stay readable: lines of printable ASCII, of which the first begins with no blank, and one line end behind
// the last. A literal block does not hold other texts as they are.
bool is_plain_file(const std::string& text) {
  const auto is_plain = [](unsigned char c) { return c == '\n' || (c >= ' ' && c < 0x7f); };
  return text.size() > 1 && text.ends_with('\n') && text[text.size() - 2] != '\n' && text.front() != ' ' &&
         text.front() != '\n' && std::all_of(text.begin(), text.end(), is_plain);
}

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
    out << (is_plain_file(text) ? YAML::Literal : YAML::DoubleQuoted) << text;
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
