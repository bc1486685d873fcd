// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/selection/field_expression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <compare>
#include <optional>
#include <regex>
#include <utility>
#include <variant>
#include <vector>

namespace tracing {
namespace {

// An integer keeps all 64 bits, with or without sign. Real numbers are compared as real numbers.
using Number = std::variant<std::int64_t, std::uint64_t, double>;
using Value = std::variant<Number, std::string>;

enum class Operator { kIsTrue, kEqual, kNotEqual, kLess, kLessOrEqual, kGreater, kGreaterOrEqual, kMatches };

std::partial_ordering compare(const Number& a, const Number& b) {
  return std::visit(
      [](auto x, auto y) -> std::partial_ordering {
        if constexpr (std::is_same_v<decltype(x), double> || std::is_same_v<decltype(y), double>) {
          return static_cast<double>(x) <=> static_cast<double>(y);
        } else {
          return std::cmp_less(x, y)    ? std::partial_ordering::less
                 : std::cmp_equal(x, y) ? std::partial_ordering::equivalent
                                        : std::partial_ordering::greater;
        }
      },
      a, b);
}

bool accepts(Operator comparison, std::partial_ordering order) {
  switch (comparison) {
    case Operator::kEqual:
      return order == std::partial_ordering::equivalent;
    case Operator::kNotEqual:
      return order != std::partial_ordering::equivalent;
    case Operator::kLess:
      return order == std::partial_ordering::less;
    case Operator::kLessOrEqual:
      return order == std::partial_ordering::less || order == std::partial_ordering::equivalent;
    case Operator::kGreater:
      return order == std::partial_ordering::greater;
    case Operator::kGreaterOrEqual:
      return order == std::partial_ordering::greater || order == std::partial_ordering::equivalent;
    default:
      return false;
  }
}

std::optional<FieldValue> inside(FieldValue field, const FieldPath::Part& part) {
  if (field.is_variant()) {
    field = field[0];
  }
  if (const auto* const index = std::get_if<std::size_t>(&part)) {
    return field.is_array() && *index < field.size() ? std::optional(field[*index]) : std::nullopt;
  }
  if (!field.is_structure()) {
    return std::nullopt;
  }
  for (std::size_t i = 0; i < field.size(); ++i) {
    if (field.member_name(i) == std::get<std::string>(part)) {
      return field[i];
    }
  }
  return std::nullopt;
}

FieldContent content_of(const FieldValue& field) {
  FieldContent content;
  content.label = field.enumeration_label();
  if (const auto number = field.integer()) {
    content.value = *number;
  } else if (const auto large = field.unsigned_integer()) {
    content.value = *large;
  } else if (const auto real = field.real()) {
    content.value = *real;
  } else if (const auto text = field.string()) {
    content.value = *text;
  } else {
    content.value = FieldParts{field.size()};
  }
  return content;
}

std::optional<FieldContent> look_up_in(const Event& event, const FieldPath& path) {
  if (path.rest.empty()) {
    if (path.first == "procname") {
      return event.procname ? std::optional(FieldContent{*event.procname, {}}) : std::nullopt;
    }
    const auto* const context = path.first == "vpid"     ? &event.vpid
                                : path.first == "vtid"   ? &event.vtid
                                : path.first == "cpu_id" ? &event.cpu_id
                                                         : nullptr;
    if (context != nullptr) {
      return *context ? std::optional(FieldContent{**context, {}}) : std::nullopt;
    }
  }
  std::optional<FieldValue> field = event.field(path.first);
  if (!field) {
    field = event.context(path.first);
  }
  for (const FieldPath::Part& part : path.rest) {
    if (!field) {
      return std::nullopt;
    }
    field = inside(*field, part);
  }
  if (!field) {
    return std::nullopt;
  }
  if (field->is_variant()) {
    field = (*field)[0];
  }
  return content_of(*field);
}

}  // namespace

struct FieldExpression::Node {
  enum class Kind { kOr, kAnd, kNot, kComparison };
  Kind kind = Kind::kComparison;
  std::vector<std::unique_ptr<const Node>> parts;  // all nodes but comparisons have parts

  FieldPath path;
  Operator comparison = Operator::kIsTrue;
  Value value;
  std::regex pattern;

  template <class Find>
  bool holds(const Find& find) const {
    switch (kind) {
      case Kind::kOr:
        return std::any_of(parts.begin(), parts.end(), [&](const auto& part) { return part->holds(find); });
      case Kind::kAnd:
        return std::all_of(parts.begin(), parts.end(), [&](const auto& part) { return part->holds(find); });
      case Kind::kNot:
        return !parts.front()->holds(find);
      case Kind::kComparison:
        return compares(find(path));
    }
    return false;
  }

  void add_fields(std::vector<std::string>& names) const {
    for (const auto& part : parts) {
      part->add_fields(names);
    }
    if (kind == Kind::kComparison && std::find(names.begin(), names.end(), path.first) == names.end()) {
      names.push_back(path.first);
    }
  }

 private:
  bool compares(const std::optional<FieldContent>& content) const {
    if (!content) {
      return false;
    }
    if (content->label && std::holds_alternative<std::string>(value)) {
      return accepts_text(*content->label);
    }
    return std::visit(
        [this]<class Content>(const Content& held) {
          if constexpr (std::is_same_v<Content, std::string_view>) {
            return accepts_text(held);
          } else if constexpr (std::is_same_v<Content, FieldParts>) {
            return comparison == Operator::kIsTrue && held.count > 0;
          } else {
            return accepts_number(Number(held));
          }
        },
        content->value);
  }

  bool accepts_number(const Number& number) const {
    if (comparison == Operator::kIsTrue) {
      return std::is_neq(compare(number, Number(std::int64_t{0})));
    }
    const auto* const expected = std::get_if<Number>(&value);
    return expected != nullptr && accepts(comparison, compare(number, *expected));
  }

  bool accepts_text(std::string_view text) const {
    if (comparison == Operator::kIsTrue) {
      return !text.empty();
    }
    if (comparison == Operator::kMatches) {
      return std::regex_search(text.begin(), text.end(), pattern);
    }
    const auto* const expected = std::get_if<std::string>(&value);
    return expected != nullptr && accepts(comparison, text <=> std::string_view(*expected));
  }
};

namespace {

using Node = FieldExpression::Node;
using NodePtr = std::unique_ptr<const Node>;

class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  NodePtr parse() {
    NodePtr root = parse_list(Node::Kind::kOr);
    skip_space();
    if (at_ < text_.size()) {
      fail(fmt::format("unexpected '{}'", text_.substr(at_)));
    }
    return root;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw ExpressionError(what, at_); }

  void skip_space() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) {
      ++at_;
    }
  }
  bool take(std::string_view symbol) {
    skip_space();
    if (!text_.substr(at_).starts_with(symbol)) {
      return false;
    }
    at_ += symbol.size();
    return true;
  }

  NodePtr parse_list(Node::Kind kind) {
    const bool is_or = kind == Node::Kind::kOr;
    auto node = std::make_unique<Node>();
    node->kind = kind;
    do {
      node->parts.push_back(is_or ? parse_list(Node::Kind::kAnd) : parse_not());
    } while (take(is_or ? "||" : "&&"));
    if (node->parts.size() == 1) {
      return std::move(node->parts.front());
    }
    return node;
  }

  NodePtr parse_not() {
    skip_space();
    if (take("!")) {
      auto node = std::make_unique<Node>();
      node->kind = Node::Kind::kNot;
      node->parts.push_back(parse_not());
      return node;
    }
    if (take("(")) {
      NodePtr node = parse_list(Node::Kind::kOr);
      if (!take(")")) {
        fail("expected ')'");
      }
      return node;
    }
    return parse_comparison();
  }

  NodePtr parse_comparison() {
    auto node = std::make_unique<Node>();
    node->path = parse_path();
    constexpr std::array<std::pair<std::string_view, Operator>, 7> kOperators{{{"==", Operator::kEqual},
                                                                               {"!=", Operator::kNotEqual},
                                                                               {"<=", Operator::kLessOrEqual},
                                                                               {">=", Operator::kGreaterOrEqual},
                                                                               {"=~", Operator::kMatches},
                                                                               {"<", Operator::kLess},
                                                                               {">", Operator::kGreater}}};
    for (const auto& [symbol, comparison] : kOperators) {
      if (!take(symbol)) {
        continue;
      }
      node->comparison = comparison;
      skip_space();
      const std::size_t begin = at_;
      node->value = parse_value();
      if (comparison == Operator::kMatches) {
        set_pattern(*node, begin);
      }
      return node;
    }
    skip_space();
    if (at_ < text_.size() && text_[at_] == '=') {
      fail("expected '==' to compare");
    }
    return node;
  }

  void set_pattern(Node& node, std::size_t begin) {
    const auto* const pattern = std::get_if<std::string>(&node.value);
    try {
      if (pattern != nullptr) {
        node.pattern = std::regex(*pattern, std::regex::ECMAScript | std::regex::optimize);
        return;
      }
    } catch (const std::regex_error&) {
      // reported below
    }
    at_ = begin;
    fail(pattern == nullptr ? "'=~' needs a text in quotes" : fmt::format("'{}' is no regular expression", *pattern));
  }

  static bool continues_name(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  }

  std::string parse_name() {
    skip_space();
    const std::size_t begin = at_;
    while (at_ < text_.size() && continues_name(text_[at_])) {
      ++at_;
    }
    if (at_ == begin) {
      fail("expected the name of a field");
    }
    return std::string(text_.substr(begin, at_ - begin));
  }

  FieldPath parse_path() {
    FieldPath path;
    path.first = parse_name();
    for (;;) {
      if (take(".")) {
        path.rest.emplace_back(parse_name());
      } else if (take("[")) {
        std::size_t index = 0;
        const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), index);
        if (error != std::errc()) {
          fail("expected the number of an element");
        }
        at_ = static_cast<std::size_t>(end - text_.data());
        if (!take("]")) {
          fail("expected ']'");
        }
        path.rest.emplace_back(index);
      } else {
        return path;
      }
    }
  }

  Value parse_value() {
    skip_space();
    if (at_ == text_.size()) {
      fail("expected a value");
    }
    const char quote = text_[at_];
    if (quote == '"' || quote == '\'') {
      return parse_text(quote);
    }
    const std::size_t begin = at_;
    while (at_ < text_.size() &&
           (continues_name(text_[at_]) || text_[at_] == '.' || text_[at_] == '-' || text_[at_] == '+')) {
      ++at_;
    }
    const std::string_view word = text_.substr(begin, at_ - begin);
    if (word == "true") {
      return Number(std::int64_t{1});
    }
    if (word == "false") {
      return Number(std::int64_t{0});
    }
    if (const auto number = parse_number(word)) {
      return *number;
    }
    at_ = begin;
    fail(word.empty() ? "expected a value" : fmt::format("'{}' is no number; texts stand in quotes", word));
  }

  Value parse_text(char quote) {
    std::string value;
    for (++at_; at_ < text_.size(); ++at_) {
      char c = text_[at_];
      if (c == quote) {
        ++at_;
        return value;
      }
      // Only the quote and the backslash need a backslash; other backslashes belong to regular expressions.
      if (c == '\\' && at_ + 1 < text_.size() && (text_[at_ + 1] == quote || text_[at_ + 1] == '\\')) {
        c = text_[++at_];
      }
      value += c;
    }
    fail("a text has no closing quote");
  }

  static std::optional<Number> parse_number(std::string_view word) {
    const char* const end = word.data() + word.size();
    if (word.starts_with("0x")) {
      std::uint64_t value = 0;
      const auto [parsed, error] = std::from_chars(word.data() + 2, end, value, 16);
      return error == std::errc() && parsed == end ? std::optional(Number(value)) : std::nullopt;
    }
    std::int64_t whole = 0;
    if (const auto [parsed, error] = std::from_chars(word.data(), end, whole); error == std::errc() && parsed == end) {
      return Number(whole);
    }
    std::uint64_t large = 0;
    if (const auto [parsed, error] = std::from_chars(word.data(), end, large); error == std::errc() && parsed == end) {
      return Number(large);
    }
    double real = 0;
    if (const auto [parsed, error] = std::from_chars(word.data(), end, real); error == std::errc() && parsed == end) {
      return Number(real);
    }
    return std::nullopt;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

FieldExpression::FieldExpression(std::string_view text) : root_(Parser(text).parse()) {}
FieldExpression::FieldExpression(FieldExpression&&) noexcept = default;
FieldExpression& FieldExpression::operator=(FieldExpression&&) noexcept = default;
FieldExpression::~FieldExpression() = default;

bool FieldExpression::holds(const Event& event) const {
  return root_->holds([&event](const FieldPath& path) { return look_up_in(event, path); });
}

bool FieldExpression::holds(const LookUp& look_up) const {
  return root_->holds(look_up);
}

std::vector<std::string> FieldExpression::fields() const {
  std::vector<std::string> names;
  root_->add_fields(names);
  return names;
}

}  // namespace tracing
