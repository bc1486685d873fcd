// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/message_types/idl_tokens.hpp"
#include "launcher/message_types/interface_file.hpp"
#include "launcher/message_types/read_value.hpp"

namespace launch {

namespace {

// IDL's names of types that differ from those of .msg files.
constexpr std::array<std::pair<std::string_view, FieldKind>, 11> kIdlNames{
    {{"boolean", FieldKind::kBool},
     {"octet", FieldKind::kByte},
     {"char", FieldKind::kChar},
     {"float", FieldKind::kFloat32},
     {"double", FieldKind::kFloat64},
     {"short", FieldKind::kInt16},
     {"long", FieldKind::kInt32},
     {"long long", FieldKind::kInt64},
     {"unsigned short", FieldKind::kUint16},
     {"unsigned long", FieldKind::kUint32},
     {"unsigned long long", FieldKind::kUint64}}};

std::optional<FieldKind> idl_kind(std::string_view name) {
  const auto* const found =
      std::find_if(kIdlNames.begin(), kIdlNames.end(), [&](const auto& row) { return row.first == name; });
  if (found != kIdlNames.end()) {
    return found->second;
  }
  const auto kind = primitive_kind(name);
  return kind && is_integer(*kind) && *kind != FieldKind::kByte ? kind : std::nullopt;
}

// A literal: where it stands, and its text as YAML has it.
struct Literal {
  IdlToken token;
  std::string yaml;
  bool is_text = false;
};

class IdlParser {
 public:
  IdlParser(const std::shared_ptr<const SourceFile>& file, const std::string& package, const FindMessage& find_message)
      : in_(file), package_(package), find_message_(find_message) {}

  std::vector<MessageType> parse(const std::vector<std::string>& parts) {
    const IdlToken begin = in_.next();
    while (in_.next().kind != IdlToken::Kind::kEnd) {
      definition();
    }
    std::vector<MessageType> result;
    for (const std::string& part : parts) {
      const auto found = structs_.find(part);
      if (found == structs_.end()) {
        in_.fail(begin, fmt::format("the file does not define 'struct {}'", part));
      }
      MessageType& message = result.emplace_back(std::move(found->second));
      message.constants = std::move(constants_[part]);
    }
    return result;
  }

 private:
  void definition() {
    annotations();
    const IdlToken token = in_.next();
    if (in_.accept("module")) {
      modules_.push_back(in_.take_name());
      in_.expect("{");
      while (!in_.accept("}")) {
        definition();
      }
      modules_.pop_back();
    } else if (in_.accept("struct")) {
      structure();
    } else if (in_.accept("typedef")) {
      FieldType type = parse_type();
      const std::string name = in_.take_name();
      array(type);
      typedefs_[name] = type;
    } else if (in_.accept("const")) {
      constant();
    } else {
      in_.fail(token, fmt::format("expected 'module', 'struct', 'typedef' or 'const' and not '{}'", token.text));
    }
    in_.expect(";");
  }

  void structure() {
    MessageType& message = structs_[in_.take_name()];
    in_.expect("{");
    while (!in_.accept("}")) {
      const std::optional<Literal> value = annotations();
      const FieldType type = parse_type();
      do {
        MessageField field{in_.take_name(), type, {}};
        array(field.type);
        field.default_value = value ? value_of(*value, field.type) : default_value(field.type);
        message.fields.push_back(std::move(field));
      } while (in_.accept(","));
      in_.expect(";");
    }
    // The member that stands for a message without fields.
    if (message.fields.size() == 1 && message.fields[0].name == "structure_needs_at_least_one_member") {
      message.fields.clear();
    }
  }

  // Skips annotations, and returns the value of @default.
  std::optional<Literal> annotations() {
    std::optional<Literal> value;
    while (in_.accept("@")) {
      const std::string name = in_.take_name();
      if (!in_.accept("(")) {
        continue;
      }
      while (!in_.accept(")")) {
        const IdlToken token = in_.take();
        if (token.kind == IdlToken::Kind::kEnd) {
          in_.fail(token, "a ')' is missing");
        }
        if (name == "default" && token.text == "value" && in_.accept("=")) {
          value = literal();
        }
      }
    }
    return value;
  }

  FieldType parse_type() {
    const IdlToken begin = in_.next();
    if (in_.accept("sequence")) {
      in_.expect("<");
      FieldType type = parse_type();
      if (type.many != Many::kOne) {
        in_.fail(begin, "a sequence of arrays or sequences is not possible");
      }
      type.many = Many::kSequence;
      type.count = in_.accept(",") ? size() : 0;
      in_.expect(">");
      return type;
    }
    for (const FieldKind kind : {FieldKind::kString, FieldKind::kWstring}) {
      if (in_.accept(name_of(kind))) {
        FieldType type{kind};
        if (in_.accept("<")) {
          type.string_bound = size();
          in_.expect(">");
        }
        return type;
      }
    }
    std::string name = in_.take_name();
    while ((name == "unsigned" || name.ends_with("long")) &&
           (in_.next().text == "long" || in_.next().text == "short")) {
      name += fmt::format(" {}", in_.take().text);
    }
    if (const auto kind = idl_kind(name)) {
      return {*kind};
    }
    std::string last = name;
    while (in_.accept("::")) {
      last = in_.take_name();
      name += "/" + last;
    }
    if (const auto found = typedefs_.find(last); found != typedefs_.end()) {
      return found->second;
    }
    return message_type(begin, last == name ? fmt::format("{}/msg/{}", package_, name) : name);
  }

  FieldType message_type(const IdlToken& begin, const std::string& name) {
    try {
      return {FieldKind::kMessage, find_message_(name)};
    } catch (const LaunchError& error) {
      const Diagnostic& first = error.diagnostics().front();
      throw LaunchError(first.message, first.where ? first.where : in_.range(begin), first.help);
    }
  }

  void array(FieldType& type) {
    const IdlToken begin = in_.next();
    if (in_.accept("[")) {
      if (type.many != Many::kOne) {
        in_.fail(begin, "an array of arrays or sequences is not possible");
      }
      type.many = Many::kArray;
      type.count = size();
      in_.expect("]");
    }
  }

  std::size_t size() {
    const Literal value = literal();
    std::size_t size = 0;
    const char* const end = value.yaml.data() + value.yaml.size();
    const auto [stop, error] = std::from_chars(value.yaml.data(), end, size);
    if (value.is_text || error != std::errc() || stop != end || size == 0) {
      in_.fail(value.token, "the size must be a number above 0");
    }
    return size;
  }

  void constant() {
    FieldType type = parse_type();
    const std::string name = in_.take_name();
    in_.expect("=");
    const Literal value = literal();
    named_[name] = value;
    constexpr std::string_view kSuffix = "_Constants";
    if (!modules_.empty() && modules_.back().ends_with(kSuffix)) {
      const std::string& module = modules_.back();
      constants_[module.substr(0, module.size() - kSuffix.size())].push_back({name, type, value_of(value, type)});
    }
  }

  Literal literal() { return expression(0); }

  // A value that is computed from others. The operators of a later row bind more.
  Literal expression(std::size_t row) {
    static const std::vector<std::vector<std::string_view>> kOperators = {{"|"},  {"^"},      {"&"},
                                                                          {"<<"}, {"+", "-"}, {"*", "/", "%"}};
    if (row == kOperators.size()) {
      return operand();
    }
    Literal left = expression(row + 1);
    const auto is_next = [this](std::string_view sign) {
      return in_.next().kind == IdlToken::Kind::kSign && in_.next().text == sign;
    };
    while (std::any_of(kOperators[row].begin(), kOperators[row].end(), is_next)) {
      const IdlToken sign = in_.take();
      left.yaml = computed(left, sign.text.front(), expression(row + 1));
    }
    return left;
  }

  template <typename Number>
  static std::optional<Number> number_of(const Literal& value) {
    Number number{};
    const char* const end = value.yaml.data() + value.yaml.size();
    const auto [stop, error] = std::from_chars(value.yaml.data(), end, number);
    return !value.is_text && error == std::errc() && stop == end ? std::optional(number) : std::nullopt;
  }

  // Integers are divided as the generator does it: rounded down.
  std::string computed(const Literal& left, char sign, const Literal& right) const {
    const auto a = number_of<std::int64_t>(left);
    const auto b = number_of<std::int64_t>(right);
    const auto x = number_of<double>(left);
    const auto y = number_of<double>(right);
    if (a && b) {
      const auto text = [](auto number) { return std::to_string(static_cast<std::int64_t>(number)); };
      const auto from = static_cast<std::uint64_t>(*a);  // without sign, nothing overflows
      const auto by = static_cast<std::uint64_t>(*b);
      const std::uint64_t quotient =
          *b == 0 || *b == -1 ? 0 - from
                              : static_cast<std::uint64_t>(*a / *b - (*a % *b != 0 && (*a < 0) != (*b < 0) ? 1 : 0));
      switch (sign) {
        case '|':
          return text(from | by);
        case '^':
          return text(from ^ by);
        case '&':
          return text(from & by);
        case '<':
          return text(by < 64 ? from << by : 0);
        case '+':
          return text(from + by);
        case '-':
          return text(from - by);
        case '*':
          return text(from * by);
        default:
          if (by != 0) {
            return text(sign == '/' ? quotient : from - by * quotient);
          }
      }
    } else if (x && y && std::string_view("+-*/").find(sign) != std::string_view::npos && (sign != '/' || *y != 0)) {
      return fmt::format("{}", sign == '+' ? *x + *y : sign == '-' ? *x - *y : sign == '*' ? *x * *y : *x / *y);
    }
    in_.fail(left.token, "expected a value");
  }

  Literal operand() {
    const IdlToken token = in_.take();
    switch (token.kind) {
      case IdlToken::Kind::kText: {
        std::string text = unquoted(token.text);
        while (in_.next().kind == IdlToken::Kind::kText) {
          text += unquoted(in_.take().text);
        }
        return {token, std::move(text), true};
      }
      case IdlToken::Kind::kNumber:
        return {token, number(token)};
      case IdlToken::Kind::kName:
        if (token.text == "TRUE" || token.text == "FALSE") {
          return {token, token.text == "TRUE" ? "true" : "false"};
        }
        return named(token);
      case IdlToken::Kind::kSign:
        if (token.text == "(") {
          const Literal value = literal();
          in_.expect(")");
          return {token, value.yaml, value.is_text};
        }
        if (token.text == "-" && in_.next().kind == IdlToken::Kind::kNumber) {
          return {token, "-" + operand().yaml};
        }
        if (token.text == "-" || token.text == "+") {
          return {token, computed({token, "0"}, token.text.front(), operand())};
        }
        if (token.text == "~") {
          return {token, computed({token, "-1"}, '-', operand())};
        }
        [[fallthrough]];
      default:
        in_.fail(token, fmt::format("expected a value and not '{}'", token.text));
    }
  }

  // A constant of this file, with or without its module.
  Literal named(const IdlToken& token) {
    std::string name(token.text);
    while (in_.accept("::")) {
      name = in_.take_name();
    }
    const auto found = named_.find(name);
    if (found == named_.end()) {
      in_.fail(token, fmt::format("unknown constant '{}'", name));
    }
    return {token, found->second.yaml, found->second.is_text};
  }

  std::string number(const IdlToken& token) const {
    const bool is_hexadecimal = token.text.starts_with("0x") || token.text.starts_with("0X");
    const bool is_octal = token.text.size() > 1 && token.text[0] == '0' &&
                          token.text.find_first_not_of("01234567") == std::string_view::npos;
    if (!is_hexadecimal && !is_octal) {
      return std::string(token.text.substr(0, token.text.find_last_not_of("dD") + 1));
    }
    std::uint64_t value = 0;
    const std::string_view digits = token.text.substr(is_hexadecimal ? 2 : 1);
    const auto [stop, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), value, is_hexadecimal ? 16 : 8);
    if (error != std::errc() || stop != digits.data() + digits.size()) {
      in_.fail(token, fmt::format("'{}' is not a number", token.text));
    }
    return std::to_string(value);
  }

  MessageValue value_of(const Literal& value, const FieldType& type) const {
    const bool is_string = type.kind == FieldKind::kString || type.kind == FieldKind::kWstring;
    if (type.many == Many::kOne && is_string) {
      if (!value.is_text) {
        in_.fail(value.token, "expected a string");
      }
      return {value.yaml};
    }
    std::string yaml = value.yaml;
    if (type.many != Many::kOne && yaml.starts_with('(') && yaml.ends_with(')')) {
      // The default of many elements is a string with a list of Python. Its last comma may have no value behind it.
      yaml = "[" + yaml.substr(1, yaml.size() - 2) + "]";
    }
    return read_value(type, LocatedText(yaml, in_.range(value.token)));
  }

  IdlTokens in_;
  const std::string& package_;
  const FindMessage& find_message_;
  std::vector<std::string> modules_;
  std::map<std::string, MessageType> structs_;
  std::map<std::string, std::vector<MessageConstant>> constants_;
  std::map<std::string, FieldType> typedefs_;
  std::map<std::string, Literal> named_;
};

}  // namespace

std::vector<MessageType> parse_idl_file(const std::shared_ptr<const SourceFile>& file, const std::string& package,
                                        const std::vector<std::string>& parts, const FindMessage& find_message) {
  return IdlParser(file, package, find_message).parse(parts);
}

}  // namespace launch
