// SPDX-License-Identifier: Apache-2.0
#include "rcl_yaml_param_parser/read_yaml.hpp"

#include <yaml.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string_view>

#include "rcl_yaml_param_parser/typed_scalar.hpp"
#include "words.hpp"

namespace rcl_yaml {
namespace {

[[noreturn]] void wrong(const std::string& what) {
  throw std::invalid_argument(what);
}

constexpr std::string_view kParametersKey = "ros__parameters";

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
  std::string text() const {
    return {reinterpret_cast<const char*>(event_.data.scalar.value), event_.data.scalar.length};
  }
  bool is_quoted() const {
    const auto style = event_.data.scalar.style;
    return style == YAML_SINGLE_QUOTED_SCALAR_STYLE || style == YAML_DOUBLE_QUOTED_SCALAR_STYLE;
  }
  // Of a scalar, a list or a mapping.
  std::string_view tag() const {
    const yaml_char_t* const tag = type() == YAML_SCALAR_EVENT           ? event_.data.scalar.tag
                                   : type() == YAML_SEQUENCE_START_EVENT ? event_.data.sequence_start.tag
                                   : type() == YAML_MAPPING_START_EVENT  ? event_.data.mapping_start.tag
                                                                         : nullptr;
    return tag == nullptr ? "" : reinterpret_cast<const char*>(tag);
  }
  bool is_empty_scalar() const { return type() == YAML_SCALAR_EVENT && event_.data.scalar.length == 0 && !is_quoted(); }

 private:
  yaml_event_t event_{};
};

// Reads events. Errors get the prefix `file:line: `, or no prefix without a file.
class Reader {
 public:
  Reader(std::string text, std::string file) : text_(std::move(text)), file_(std::move(file)) {
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

  std::string place(std::size_t line) const { return file_ + ":" + std::to_string(line); }

  [[noreturn]] void fail(std::size_t line, const std::string& what) const {
    wrong(file_.empty() ? what : place(line) + ": " + what);
  }

  // Reads the first event of the next document. Returns false at the end of the text.
  bool open_document(Event& first) {
    while (true) {
      Event event;
      next(event);
      if (event.type() == YAML_STREAM_END_EVENT) {
        return false;
      }
      if (event.type() == YAML_DOCUMENT_START_EVENT) {
        next(first);
        return true;
      }
    }
  }

 private:
  std::string text_;
  std::string file_;
  yaml_parser_t parser_{};
};

Scalar read_scalar(Reader& reader, const Event& event, const std::string& name) {
  if (event.is_empty_scalar()) {
    reader.fail(event.line(), "parameter '" + name + "' has no value; an empty string is written \"\"");
  }
  try {
    return typed_scalar(event.text(), {event.is_quoted(), event.tag()});
  } catch (const std::invalid_argument& error) {
    reader.fail(event.line(), "parameter '" + name + "': " + error.what());
  }
}

// A list or a mapping can only have the tag of its kind.
void check_tag(Reader& reader, const Event& event, const char* expected) {
  if (!event.tag().empty() && event.tag() != "!" && event.tag() != expected) {
    reader.fail(event.line(), "the tag '" + std::string(event.tag()) + "' does not fit " +
                                  (event.type() == YAML_SEQUENCE_START_EVENT ? "a list" : "a mapping"));
  }
}

template <typename T>
ParameterValue list_of(const std::vector<Scalar>& items) {
  std::vector<T> result;
  for (const Scalar& item : items) {
    result.push_back(std::get<T>(item));
  }
  return result;
}

std::optional<ParameterValue> read_list(Reader& reader, const std::string& name) {
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
      reader.fail(event.line(), "the list of parameter '" + name + "' must be of one type, but begins with " +
                                    type_name(items.front()) + " and has " + type_name(items.back()));
    }
  }
  if (items.empty()) {
    return std::nullopt;
  }
  switch (items.front().index()) {
    case 0:
      return list_of<bool>(items);
    case 1:
      return list_of<std::int64_t>(items);
    case 2:
      return list_of<double>(items);
    case 3:
      return list_of<std::string>(items);
    default:
      break;
  }
  // `param dump` writes bytes one by one.
  Bytes bytes;
  for (const Scalar& item : items) {
    const Bytes& more = std::get<Bytes>(item);
    bytes.insert(bytes.end(), more.begin(), more.end());
  }
  return bytes;
}

// Reads a scalar or list. `first` is its first event.
std::optional<ParameterValue> read_any(Reader& reader, const Event& first, const std::string& name) {
  if (first.type() == YAML_SEQUENCE_START_EVENT) {
    check_tag(reader, first, YAML_SEQ_TAG);
    return read_list(reader, name);
  }
  return std::visit([](auto value) -> ParameterValue { return value; }, read_scalar(reader, first, name));
}

struct Key {
  std::string name;
  std::size_t line;
};

// The next key of a mapping, nullopt at the end of the mapping. `what` says what the key is: "a node name".
std::optional<Key> read_key(Reader& reader, const std::string& what) {
  Event event;
  reader.next(event);
  if (event.type() == YAML_MAPPING_END_EVENT) {
    return std::nullopt;
  }
  if (event.type() != YAML_SCALAR_EVENT || event.text().empty()) {
    reader.fail(event.line(), what + " must be a plain value");
  }
  return Key{event.text(), event.line()};
}

// Reads the mapping below `ros__parameters`, or a mapping inside it. Names are joined with dots.
void read_parameters_below(Reader& reader, const std::string& prefix, ParameterSink& sink) {
  while (const std::optional<Key> key = read_key(reader, "a parameter name")) {
    const std::string name = prefix + key->name;
    Event value;
    reader.next(value);
    if (value.type() == YAML_MAPPING_START_EVENT) {
      check_tag(reader, value, YAML_MAP_TAG);
      read_parameters_below(reader, name + ".", sink);
    } else {
      sink.add_parameter(name, read_any(reader, value, name), reader.place(value.line()));
    }
  }
}

void read_node(Reader& reader, const std::string& node, std::size_t line, ParameterSink& sink) {
  if (node.empty()) {
    reader.fail(line, "'ros__parameters' must stand below a node name, such as '/**'");
  }
  if (const std::string problem = wrong_in_node_pattern(node); !problem.empty()) {
    reader.fail(line, "'" + node + "' is no name of a node: " + problem);
  }
  Event value;
  reader.next(value);
  if (value.type() != YAML_MAPPING_START_EVENT) {
    reader.fail(value.is_empty_scalar() ? line : value.line(), "'ros__parameters' must hold parameters as NAME: VALUE");
  }
  sink.add_node(node);
  read_parameters_below(reader, "", sink);
}

// Reads a mapping above `ros__parameters`. Its keys are parts of the node's name.
void read_nodes(Reader& reader, const std::string& prefix, ParameterSink& sink) {
  while (const std::optional<Key> key = read_key(reader, "a node name")) {
    const std::string& name = key->name;
    if (name.starts_with(kParametersKey)) {
      read_node(reader, prefix, key->line, sink);
      continue;
    }
    Event value;
    reader.next(value);
    if (value.type() != YAML_MAPPING_START_EVENT) {
      reader.fail(
          key->line,
          "'" + name + "' stands where a node name is expected; parameters must stand below NODE: ros__parameters:");
    }
    const bool joined = prefix.empty() || prefix.ends_with('/');
    read_nodes(reader, prefix + (joined ? "" : "/") + name, sink);
  }
}

}  // namespace

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

void read_parameters(std::string text, const std::string& file, ParameterSink& sink) {
  Reader reader(std::move(text), file);
  while (true) {
    Event first;
    if (!reader.open_document(first)) {
      return;
    }
    if (first.type() != YAML_MAPPING_START_EVENT) {
      reader.fail(first.line(), "a parameter file must be a mapping of node names");
    }
    read_nodes(reader, "", sink);
  }
}

std::optional<ParameterValue> read_value(std::string text, const std::string& name, bool required) {
  Reader reader(std::move(text), "");
  Event first;
  if (!reader.open_document(first)) {
    if (required) {
      wrong("no value stands after ':='");
    }
    return std::nullopt;
  }
  if (first.type() == YAML_MAPPING_START_EVENT) {
    wrong("a mapping is no parameter value");
  }
  auto value = read_any(reader, first, name);
  Event second;
  if (reader.open_document(second)) {
    wrong("a second value stands behind the first");
  }
  return value;
}

}  // namespace rcl_yaml
