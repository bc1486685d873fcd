// SPDX-License-Identifier: Apache-2.0
#include "launcher/message_types/read_value.hpp"

#include <fmt/format.h>

#include <charconv>
#include <limits>
#include <string_view>
#include <utility>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/frontend/yaml_document.hpp"
#include "launcher/message_types/utf16.hpp"

namespace launch {

namespace {

constexpr std::string_view kHeader = "std_msgs/msg/Header";
constexpr std::string_view kTime = "builtin_interfaces/msg/Time";

struct IntegerRange {
  std::int64_t least;
  std::uint64_t most;
};

IntegerRange range_of(FieldKind kind) {
  const auto range = [](auto example) {
    using Limits = std::numeric_limits<decltype(example)>;
    return IntegerRange{static_cast<std::int64_t>(Limits::min()), static_cast<std::uint64_t>(Limits::max())};
  };
  switch (kind) {
    case FieldKind::kInt8:
      return range(std::int8_t{});
    case FieldKind::kInt16:
      return range(std::int16_t{});
    case FieldKind::kUint16:
      return range(std::uint16_t{});
    case FieldKind::kInt32:
      return range(std::int32_t{});
    case FieldKind::kUint32:
      return range(std::uint32_t{});
    case FieldKind::kInt64:
      return range(std::int64_t{});
    case FieldKind::kUint64:
      return range(std::uint64_t{});
    default:
      return range(std::uint8_t{});
  }
}

bool is_plain_word(const YamlNode& node, std::string_view word) {
  return node.kind == YamlNode::Kind::kScalar && node.scalar.text.text() == word;
}

class Reader {
 public:
  std::vector<Diagnostic> errors;
  std::vector<std::vector<std::size_t>> times;

  MessageValue message(const MessageType& type, const YamlNode& node) {
    MessageValue value = default_value(type);
    if (node.kind != YamlNode::Kind::kMapping) {
      fail(node, fmt::format("{} is expected, found {}", described(type), describe(node)),
           type.fields.empty() ? "it has no fields: write {}"
                               : fmt::format("write its fields as a mapping: '{{{}: …}}'", type.fields.front().name));
      return value;
    }
    for (const YamlEntry& entry : node.entries) {
      const std::string& name = entry.key.scalar.text.text();
      const MessageField* const field = type.find(name);
      if (field == nullptr) {
        fail(entry.key, fmt::format("{} has no field '{}'", type.name, name), fields_help(type, name));
        continue;
      }
      const auto index = static_cast<std::size_t>(field - type.fields.data());
      path_.push_back(index);
      value.list()[index] = field_value(field->type, entry.value, field->default_value);
      path_.pop_back();
    }
    return value;
  }

  MessageValue field_value(const FieldType& type, const YamlNode& node, const MessageValue& fallback) {
    if (type.many == Many::kOne) {
      return single(type, node, fallback);
    }
    if (node.kind != YamlNode::Kind::kSequence) {
      fail(node, fmt::format("a list is expected for {}, found {}", to_string(type), describe(node)));
      return fallback;
    }
    const bool is_array = type.many == Many::kArray;
    if (is_array ? node.items.size() != type.count : type.count != 0 && node.items.size() > type.count) {
      fail(node, fmt::format("{} has {}{} elements, found {}", to_string(type), is_array ? "" : "at most ", type.count,
                             node.items.size()));
      return fallback;
    }
    const FieldType element = type.element();
    MessageValue::List list;
    list.reserve(node.items.size());
    for (const YamlNode& item : node.items) {
      path_.push_back(list.size());
      list.push_back(single(element, item, default_value(element)));
      path_.pop_back();
    }
    return {std::move(list)};
  }

 private:
  static std::string described(const MessageType& type) { return fmt::format("a message {}", type.name); }

  static std::string fields_help(const MessageType& type, const std::string& name) {
    if (std::string help = did_you_mean(name, type.field_names()); !help.empty()) {
      return help;
    }
    std::string names;
    for (const std::string& each : type.field_names()) {
      names += fmt::format("{}{}", names.empty() ? "" : ", ", each);
    }
    return names.empty() ? "it has no fields" : "its fields are " + names;
  }

  void fail(const YamlNode& node, std::string message, std::string help = {}) {
    errors.push_back({Severity::kError, std::move(message), node.where, std::move(help)});
  }

  MessageValue single(const FieldType& type, const YamlNode& node, const MessageValue& fallback) {
    if (type.kind == FieldKind::kMessage) {
      return nested(*type.message, node);
    }
    if (node.kind != YamlNode::Kind::kScalar) {
      fail(node, fmt::format("{} is expected, found {}", to_string(type), describe(node)));
      return fallback;
    }
    if (type.kind == FieldKind::kString || type.kind == FieldKind::kWstring) {
      return text(type, node, fallback);
    }
    const Scalar& scalar = node.scalar;
    if (type.kind == FieldKind::kBool) {
      if (scalar.type == Scalar::Type::kBool) {
        return {scalar.bool_value};
      }
      if (scalar.type == Scalar::Type::kInt && (scalar.int_value == 0 || scalar.int_value == 1)) {
        return {scalar.int_value == 1};
      }
      fail(node, fmt::format("bool is expected, found {}", describe(node)), "write true or false");
      return fallback;
    }
    return is_integer(type.kind) ? integer(type, node, fallback) : floating(type, node, fallback);
  }

  MessageValue nested(const MessageType& type, const YamlNode& node) {
    if (type.name == kHeader && is_plain_word(node, "auto")) {
      times.push_back(path_);
      times.back().push_back(0);
      return default_value(type);
    }
    if (type.name == kTime && is_plain_word(node, "now")) {
      times.push_back(path_);
      return default_value(type);
    }
    return message(type, node);
  }

  MessageValue text(const FieldType& type, const YamlNode& node, const MessageValue& fallback) {
    const std::string& text = node.scalar.text.text();
    const std::size_t length = type.kind == FieldKind::kWstring ? to_utf16(text).size() : text.size();
    if (type.string_bound != 0 && length > type.string_bound) {
      fail(node, fmt::format("{} has at most {} characters, found {}", to_string(type), type.string_bound, length));
      return fallback;
    }
    return {text};
  }

  MessageValue integer(const FieldType& type, const YamlNode& node, const MessageValue& fallback) {
    const Scalar& scalar = node.scalar;
    const IntegerRange range = range_of(type.kind);
    const std::string& text = scalar.text.text();
    std::uint64_t large = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), large);
    const bool is_large = error == std::errc() && end == text.data() + text.size() &&
                          large > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
    if (type.kind == FieldKind::kUint64 && is_large) {
      return {large};
    }
    if (scalar.type != Scalar::Type::kInt && !is_large) {
      fail(node, fmt::format("{} is expected, found {}", to_string(type), describe(node)));
      return fallback;
    }
    if (is_large || scalar.int_value < range.least ||
        (scalar.int_value > 0 && static_cast<std::uint64_t>(scalar.int_value) > range.most)) {
      fail(node,
           fmt::format("{} does not fit {}, which goes from {} to {}", text, to_string(type), range.least, range.most));
      return fallback;
    }
    if (type.kind == FieldKind::kUint64) {
      return {static_cast<std::uint64_t>(scalar.int_value)};
    }
    return {scalar.int_value};
  }

  MessageValue floating(const FieldType& type, const YamlNode& node, const MessageValue& fallback) {
    const Scalar& scalar = node.scalar;
    double value = 0.0;
    const std::string& text = scalar.text.text();
    if (scalar.type == Scalar::Type::kFloat) {
      value = scalar.float_value;
    } else if (scalar.type == Scalar::Type::kInt) {
      value = static_cast<double>(scalar.int_value);
    } else {  // 1e3, which is a text in YAML 1.1
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
      if (text.empty() || error != std::errc() || end != text.data() + text.size()) {
        fail(node, fmt::format("{} is expected, found {}", to_string(type), describe(node)));
        return fallback;
      }
    }
    return {type.kind == FieldKind::kFloat32 ? static_cast<double>(static_cast<float>(value)) : value};
  }

  std::vector<std::size_t> path_;
};

// Only the begin of an empty text is known.
bool is_blank(const LocatedText& text) {
  return text.text().find_first_not_of(" \t\r\n") == std::string::npos;
}

void throw_if_any(std::vector<Diagnostic> errors) {
  if (!errors.empty()) {
    throw LaunchError(std::move(errors));
  }
}

}  // namespace

void MessageText::stamp(std::int64_t nanoseconds) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  for (const std::vector<std::size_t>& place : times) {
    MessageValue* time = &value;
    for (const std::size_t index : place) {
      time = &time->list()[index];
    }
    time->list() = {{nanoseconds / kSecond}, {nanoseconds % kSecond}};
  }
}

MessageText read_message(const MessageType& type, const LocatedText& yaml) {
  if (is_blank(yaml)) {
    return {default_value(type), {}};
  }
  Reader reader;
  const YamlNode node = read_yaml(yaml, reader.errors);
  MessageText result{reader.message(type, node), std::move(reader.times)};
  throw_if_any(std::move(reader.errors));
  return result;
}

MessageValue read_value(const FieldType& type, const LocatedText& yaml) {
  Reader reader;
  const YamlNode node = read_yaml(yaml, reader.errors);
  MessageValue value = reader.field_value(type, node, default_value(type));
  throw_if_any(std::move(reader.errors));
  return value;
}

}  // namespace launch
