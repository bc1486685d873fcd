// SPDX-License-Identifier: Apache-2.0
// Reads parameter values and files as YAML, with ROS 2's own type rules (rcl_yaml_param_parser). They differ from YAML
// 1.1 and 1.2: `y` and `on` are booleans, integers may be hexadecimal or octal, `1e3` and `inf` are floating point
// numbers, `null` and `~` are strings.
#include <yaml.h>

#include <array>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <stdexcept>

#include "arguments/wrong.hpp"
#include "rcl/parameter_overrides.hpp"

namespace rcl {
namespace {

constexpr std::string_view kParametersKey = "ros__parameters";
constexpr std::string_view kStringTag = "tag:yaml.org,2002:str";

using Scalar = std::variant<bool, std::int64_t, double, std::string>;

std::string read_file(const std::string& path) {
  const std::unique_ptr<FILE, int (*)(FILE*)> file(std::fopen(path.c_str(), "re"), std::fclose);
  std::string text;
  std::array<char, 4096> block;
  if (file != nullptr) {
    while (const std::size_t count = std::fread(block.data(), 1, block.size(), file.get())) {
      text.append(block.data(), count);
    }
  }
  if (file == nullptr || std::ferror(file.get()) != 0) {
    wrong("parameter file '" + path + "' cannot be read: " + std::strerror(errno));
  }
  return text;
}

// One event of the YAML parser. The destructor frees it.
class Event {
 public:
  Event() = default;
  Event(const Event&) = delete;
  Event& operator=(const Event&) = delete;
  ~Event() { yaml_event_delete(&event_); }

  yaml_event_t* get() { return &event_; }
  yaml_event_type_t type() const { return event_.type; }
  std::size_t line() const { return event_.start_mark.line + 1; }
  std::string_view text() const {
    return {reinterpret_cast<const char*>(event_.data.scalar.value), event_.data.scalar.length};
  }
  bool is_forced_string() const {
    const auto& scalar = event_.data.scalar;
    return scalar.style != YAML_PLAIN_SCALAR_STYLE ||
           (scalar.tag != nullptr && reinterpret_cast<const char*>(scalar.tag) == kStringTag);
  }

 private:
  yaml_event_t event_{};
};

// Reads events. Errors get the prefix `source:line: `, or no prefix without a source.
class Reader {
 public:
  Reader(std::string text, std::string source) : text_(std::move(text)), source_(std::move(source)) {
    if (yaml_parser_initialize(&parser_) == 0) {
      throw std::bad_alloc();
    }
    yaml_parser_set_input_string(&parser_, reinterpret_cast<const unsigned char*>(text_.data()), text_.size());
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() { yaml_parser_delete(&parser_); }

  void next(Event& event) {
    if (yaml_parser_parse(&parser_, event.get()) == 0) {
      fail(parser_.problem_mark.line + 1, parser_.problem == nullptr ? "no valid YAML" : parser_.problem);
    }
    if (event.type() == YAML_ALIAS_EVENT) {
      fail(event.line(), "aliases (*name) are not supported");
    }
  }

  [[noreturn]] void fail(std::size_t line, const std::string& what) const {
    wrong(source_.empty() ? what : source_ + ":" + std::to_string(line) + ": " + what);
  }

  // Reads the first event of the document. Returns false if the document is empty.
  bool open_document(Event& first) {
    Event event;
    next(event);  // stream start
    Event start;
    next(start);
    if (start.type() != YAML_DOCUMENT_START_EVENT) {
      return false;
    }
    next(first);
    return true;
  }

 private:
  std::string text_;
  std::string source_;
  yaml_parser_t parser_{};
};

std::optional<bool> as_bool(std::string_view text) {
  constexpr std::array<std::string_view, 11> kTrue{"y",    "Y",    "yes", "Yes", "YES", "true",
                                                   "True", "TRUE", "on",  "On",  "ON"};
  constexpr std::array<std::string_view, 11> kFalse{"n",     "N",     "no",  "No",  "NO", "false",
                                                    "False", "FALSE", "off", "Off", "OFF"};
  for (std::size_t i = 0; i < kTrue.size(); ++i) {
    if (text == kTrue[i]) {
      return true;
    }
    if (text == kFalse[i]) {
      return false;
    }
  }
  return std::nullopt;
}

std::optional<std::int64_t> as_int(const std::string& text) {
  char* end = nullptr;
  errno = 0;
  const long long value = std::strtoll(text.c_str(), &end, 0);
  if (text.empty() || errno != 0 || end != text.c_str() + text.size()) {
    return std::nullopt;
  }
  return value;
}

std::optional<double> as_double(const std::string& text) {
  // YAML writes `.inf` and `.nan`; strtod expects `inf` and `nan`.
  std::string number = text;
  const std::size_t sign = number.starts_with('-') || number.starts_with('+') ? 1 : 0;
  if (number.size() == sign + 4 && number[sign] == '.' && std::isalpha(static_cast<unsigned char>(number[sign + 1]))) {
    number.erase(sign, 1);
  }
  char* end = nullptr;
  errno = 0;
  const double value = std::strtod(number.c_str(), &end);
  if (number.empty() || errno != 0 || end != number.c_str() + number.size()) {
    return std::nullopt;
  }
  return value;
}

Scalar typed(const Event& event) {
  std::string text(event.text());
  if (!event.is_forced_string()) {
    if (const auto value = as_bool(text)) {
      return *value;
    }
    if (const auto value = as_int(text)) {
      return *value;
    }
    if (const auto value = as_double(text)) {
      return *value;
    }
  }
  return text;
}

const char* type_name(const Scalar& value) {
  constexpr std::array<const char*, 4> kNames{"bool", "integer", "double", "string"};
  return kNames[value.index()];
}

Scalar read_scalar(Reader& reader, const Event& event, const std::string& name) {
  if (event.text().empty() && !event.is_forced_string()) {
    reader.fail(event.line(), "parameter '" + name + "' has no value; an empty string is written \"\"");
  }
  return typed(event);
}

template <typename T>
ParameterValue list_of(const std::vector<Scalar>& items) {
  std::vector<T> result;
  for (const Scalar& item : items) {
    result.push_back(std::get<T>(item));
  }
  return result;
}

ParameterValue read_list(Reader& reader, std::size_t line, const std::string& name) {
  std::vector<Scalar> items;
  while (true) {
    Event event;
    reader.next(event);
    if (event.type() == YAML_SEQUENCE_END_EVENT) {
      break;
    }
    if (event.type() != YAML_SCALAR_EVENT) {
      reader.fail(event.line(), "the list of parameter '" + name + "' may only have plain values");
    }
    items.push_back(read_scalar(reader, event, name));
    if (items.back().index() != items.front().index()) {
      reader.fail(event.line(), "the list of parameter '" + name + "' must be of one type, but begins with a " +
                                    type_name(items.front()) + " and has a " + type_name(items.back()));
    }
  }
  if (items.empty()) {
    reader.fail(line, "parameter '" + name + "' is an empty list, which has no type");
  }
  switch (items.front().index()) {
    case 0:
      return list_of<bool>(items);
    case 1:
      return list_of<std::int64_t>(items);
    case 2:
      return list_of<double>(items);
    default:
      return list_of<std::string>(items);
  }
}

// Reads a scalar or list. `first` is its first event.
ParameterValue read_value(Reader& reader, const Event& first, const std::string& name) {
  if (first.type() == YAML_SEQUENCE_START_EVENT) {
    return read_list(reader, first.line(), name);
  }
  return std::visit([](auto value) -> ParameterValue { return value; }, read_scalar(reader, first, name));
}

// Reads the mapping below `ros__parameters`, or a mapping inside it. Names are joined with dots.
void read_parameters(Reader& reader, const std::string& node, const std::string& prefix, ParameterOverrides& target) {
  while (true) {
    Event key;
    reader.next(key);
    if (key.type() == YAML_MAPPING_END_EVENT) {
      return;
    }
    if (key.type() != YAML_SCALAR_EVENT) {
      reader.fail(key.line(), "a parameter name must be a plain value");
    }
    const std::string name = prefix + std::string(key.text());
    Event value;
    reader.next(value);
    if (value.type() == YAML_MAPPING_START_EVENT) {
      read_parameters(reader, node, name + ".", target);
    } else {
      target.set(node, name, read_value(reader, value, name));
    }
  }
}

// Reads a mapping above `ros__parameters`. Its keys are parts of the node's name.
void read_nodes(Reader& reader, const std::string& prefix, ParameterOverrides& target) {
  while (true) {
    Event key;
    reader.next(key);
    if (key.type() == YAML_MAPPING_END_EVENT) {
      return;
    }
    if (key.type() != YAML_SCALAR_EVENT || key.text().empty()) {
      reader.fail(key.line(), "a node name must be a plain value");
    }
    const std::string name(key.text());
    Event value;
    reader.next(value);
    if (name == kParametersKey) {
      if (prefix.empty()) {
        reader.fail(key.line(), "'ros__parameters' must stand below a node name, such as '/**'");
      }
      // An empty value is treated as an empty mapping.
      if (value.type() == YAML_SCALAR_EVENT && value.text().empty()) {
        continue;
      }
      if (value.type() != YAML_MAPPING_START_EVENT) {
        reader.fail(value.line(), "'ros__parameters' must hold parameters as NAME: VALUE");
      }
      read_parameters(reader, prefix, "", target);
      continue;
    }
    if (value.type() != YAML_MAPPING_START_EVENT) {
      reader.fail(
          key.line(),
          "'" + name + "' stands where a node name is expected; parameters must stand below NODE: ros__parameters:");
    }
    const bool joined = prefix.empty() || prefix.ends_with('/') || name.starts_with('/');
    read_nodes(reader, prefix + (joined ? "" : "/") + name, target);
  }
}

}  // namespace

void ParameterOverrides::load_file(const std::string& path) {
  load_text(read_file(path), path);
}

void ParameterOverrides::load_text(std::string text, const std::string& path) {
  Reader reader(std::move(text), path);
  Event first;
  if (!reader.open_document(first)) {
    return;
  }
  if (first.type() != YAML_MAPPING_START_EVENT) {
    reader.fail(first.line(), "a parameter file must be a mapping of node names");
  }
  // The values are applied only if the whole file is valid.
  ParameterOverrides read;
  read_nodes(reader, "", read);
  merge(read);
}

void ParameterOverrides::set_from_text(std::string_view node_pattern, std::string_view name, std::string_view text) {
  Reader reader(std::string(text), "");
  Event first;
  if (!reader.open_document(first)) {
    wrong("no value stands after ':='");
  }
  if (first.type() == YAML_MAPPING_START_EVENT) {
    wrong("a mapping is no parameter value");
  }
  set(node_pattern, name, read_value(reader, first, std::string(name)));
}

}  // namespace rcl
