// SPDX-License-Identifier: Apache-2.0
#include "launcher/message_types/message_condition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <compare>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/message_types/field_path.hpp"

namespace launch {

namespace {

using Test = std::function<bool(const MessageValue&)>;

enum class Kind { kNumber, kText, kBool };

std::string_view name_of(Kind kind) {
  return kind == Kind::kNumber ? "a number" : kind == Kind::kText ? "a text" : "a bool";
}

// Numbers keep their type, so that integers of 64 bits are compared exactly.
using Operand = std::variant<std::int64_t, std::uint64_t, double, std::string, bool>;

struct Expression {
  Kind kind = Kind::kNumber;
  std::function<std::optional<Operand>(const MessageValue&)> evaluate;
  SourceRange where;
};

std::partial_ordering compare(const Operand& left, const Operand& right) {
  return std::visit(
      [](const auto& a, const auto& b) -> std::partial_ordering {
        using A = std::decay_t<decltype(a)>;
        using B = std::decay_t<decltype(b)>;
        if constexpr (std::is_same_v<A, B>) {
          return a <=> b;
        } else if constexpr (std::is_same_v<A, std::string> || std::is_same_v<B, std::string>) {
          return std::partial_ordering::unordered;
        } else if constexpr (std::is_same_v<A, double> || std::is_same_v<B, double> || std::is_same_v<A, bool> ||
                             std::is_same_v<B, bool>) {
          return static_cast<double>(a) <=> static_cast<double>(b);
        } else {
          return std::cmp_less(a, b)    ? std::partial_ordering::less
                 : std::cmp_equal(a, b) ? std::partial_ordering::equivalent
                                        : std::partial_ordering::greater;
        }
      },
      left, right);
}

bool is_true(std::string_view relation, std::partial_ordering order) {
  if (relation == "==") {
    return std::is_eq(order);
  }
  if (relation == "!=") {
    return std::is_neq(order);
  }
  if (relation == "<") {
    return std::is_lt(order);
  }
  if (relation == "<=") {
    return std::is_lteq(order);
  }
  return relation == ">" ? std::is_gt(order) : std::is_gteq(order);
}

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

class Parser {
 public:
  Parser(std::shared_ptr<const MessageType> message, const LocatedText& text)
      : message_(std::move(message)), text_(text), view_(text.text()) {}

  Test parse() {
    Test test = disjunction();
    skip_blanks();
    if (at_ < view_.size()) {
      fail(at_, view_.size() - at_, fmt::format("unexpected '{}'", view_.substr(at_)),
           "conditions are joined by 'and' and 'or'");
    }
    return test;
  }

 private:
  [[noreturn]] void fail(std::size_t at, std::size_t length, std::string message, std::string help = {}) const {
    throw LaunchError(std::move(message), text_.range(at, std::max<std::size_t>(length, 1)), std::move(help));
  }

  void skip_blanks() {
    while (at_ < view_.size() && std::isspace(static_cast<unsigned char>(view_[at_])) != 0) {
      ++at_;
    }
  }

  bool take_word(std::string_view word) {
    skip_blanks();
    if (!view_.substr(at_).starts_with(word) ||
        (at_ + word.size() < view_.size() && is_word(view_[at_ + word.size()]))) {
      return false;
    }
    at_ += word.size();
    return true;
  }
  bool take(char c) {
    skip_blanks();
    if (at_ == view_.size() || view_[at_] != c) {
      return false;
    }
    ++at_;
    return true;
  }

  Test disjunction() {
    Test left = conjunction();
    while (take_word("or")) {
      left = [first = std::move(left), second = conjunction()](const MessageValue& message) {
        return first(message) || second(message);
      };
    }
    return left;
  }

  Test conjunction() {
    Test left = negation();
    while (take_word("and")) {
      left = [first = std::move(left), second = negation()](const MessageValue& message) {
        return first(message) && second(message);
      };
    }
    return left;
  }

  Test negation() {
    if (take_word("not")) {
      return [test = negation()](const MessageValue& message) { return !test(message); };
    }
    if (take('(')) {
      Test test = disjunction();
      if (!take(')')) {
        fail(at_, 1, "')' is missing");
      }
      return test;
    }
    return comparison();
  }

  std::string_view take_relation() {
    skip_blanks();
    for (const std::string_view relation : {"==", "!=", "<=", ">=", "<", ">"}) {
      if (view_.substr(at_).starts_with(relation)) {
        at_ += relation.size();
        return relation;
      }
    }
    if (at_ < view_.size() && view_[at_] == '=') {
      fail(at_, 1, "'=' is no comparison", "write '=='");
    }
    return {};
  }

  Test comparison() {
    Expression left = operand();
    std::string_view relation = take_relation();
    if (relation.empty()) {
      if (left.kind != Kind::kBool) {
        throw LaunchError(fmt::format("{} is no condition", name_of(left.kind)), left.where,
                          "compare it, for instance with '> 0'");
      }
      return [value = std::move(left.evaluate)](const MessageValue& message) {
        const auto operand = value(message);
        return operand && std::get<bool>(*operand);
      };
    }
    std::vector<Test> tests;
    while (!relation.empty()) {
      Expression right = operand();
      if (left.kind != right.kind) {
        throw LaunchError(fmt::format("{} can't be compared with {}", name_of(left.kind), name_of(right.kind)),
                          right.where);
      }
      tests.emplace_back([relation, a = left.evaluate, b = right.evaluate](const MessageValue& message) {
        const auto first = a(message);
        const auto second = b(message);
        return first && second && is_true(relation, compare(*first, *second));
      });
      left = std::move(right);
      relation = take_relation();
    }
    return [tests = std::move(tests)](const MessageValue& message) {
      return std::all_of(tests.begin(), tests.end(), [&](const Test& test) { return test(message); });
    };
  }

  template <typename T>
  static Expression constant(Kind kind, T value, SourceRange where) {
    return {kind, [value = Operand(std::move(value))](const MessageValue&) { return std::optional<Operand>(value); },
            std::move(where)};
  }

  Expression operand() {
    skip_blanks();
    const std::size_t begin = at_;
    if (at_ == view_.size()) {
      fail(at_ == 0 ? 0 : at_ - 1, 1, "a field or a value is missing");
    }
    const char first = view_[at_];
    if (first == '\'' || first == '"') {
      return quoted(first);
    }
    if (std::isdigit(static_cast<unsigned char>(first)) != 0 || first == '-' || first == '+' ||
        (first == '.' && at_ + 1 < view_.size() && std::isdigit(static_cast<unsigned char>(view_[at_ + 1])) != 0)) {
      return number();
    }
    for (const std::string_view word : {"true", "True", "false", "False"}) {
      if (take_word(word)) {
        return constant(Kind::kBool, word == "true" || word == "True", text_.range(begin, word.size()));
      }
    }
    if (take_word("len")) {
      if (!take('(')) {
        fail(begin, 3, "len needs a field in brackets", "write len(field)");
      }
      FieldPath path = field();
      if (!take(')')) {
        fail(at_, 1, "')' is missing");
      }
      return length(std::move(path), text_.range(begin, at_ - begin));
    }
    FieldPath path = field();
    return value(std::move(path), text_.range(begin, at_ - begin));
  }

  FieldPath field() {
    skip_blanks();
    const std::size_t begin = at_;
    while (at_ < view_.size() && (is_word(view_[at_]) || std::string_view(".[]").find(view_[at_]) != view_.npos)) {
      ++at_;
    }
    if (at_ == begin) {
      fail(begin, 1, fmt::format("a field or a value is expected, found '{}'", view_.substr(begin, 1)));
    }
    std::size_t skipped = 0;
    const std::string_view word = view_.substr(begin, at_ - begin);
    if ((word == "m" || word.starts_with("m.")) && message_->find("m") == nullptr) {
      skipped = word == "m" ? 1 : 2;
    }
    LocatedText path;
    const SourceRange range = text_.range(begin + skipped, word.size() - skipped);
    path = LocatedText(std::string(word.substr(skipped)), range);
    return {message_, path};
  }

  Expression quoted(char quote) {
    const std::size_t begin = at_++;
    std::string value;
    for (; at_ < view_.size() && view_[at_] != quote; ++at_) {
      if (view_[at_] == '\\' && at_ + 1 < view_.size()) {
        ++at_;
      }
      value += view_[at_];
    }
    if (at_ == view_.size()) {
      fail(begin, view_.size() - begin, fmt::format("the text is not closed by {}", quote));
    }
    ++at_;
    return constant(Kind::kText, std::move(value), text_.range(begin, at_ - begin));
  }

  Expression number() {
    const std::size_t begin = at_;
    const std::size_t from = view_[begin] == '+' ? begin + 1 : begin;
    at_ = from + (view_[from] == '-' ? 1 : 0);
    while (at_ < view_.size() && (is_word(view_[at_]) || view_[at_] == '.' ||
                                  ((view_[at_] == '-' || view_[at_] == '+') && (view_[at_ - 1] | 0x20) == 'e'))) {
      ++at_;
    }
    const std::string_view word = view_.substr(from, at_ - from);
    const char* const end = word.data() + word.size();
    const SourceRange where = text_.range(begin, at_ - begin);
    const auto is_whole = [&](const auto& result) { return result.ec == std::errc() && result.ptr == end; };
    if (std::int64_t value = 0; is_whole(std::from_chars(word.data(), end, value))) {
      return constant(Kind::kNumber, value, where);
    }
    if (std::uint64_t value = 0; is_whole(std::from_chars(word.data(), end, value))) {
      return constant(Kind::kNumber, value, where);
    }
    double value = 0.0;
    if (!is_whole(std::from_chars(word.data(), end, value))) {
      fail(begin, at_ - begin, fmt::format("'{}' is not a number", view_.substr(begin, at_ - begin)));
    }
    return constant(Kind::kNumber, value, where);
  }

  static Expression length(FieldPath path, SourceRange where) {
    const FieldType& type = path.type();
    if (type.many == Many::kOne && type.kind != FieldKind::kString && type.kind != FieldKind::kWstring) {
      throw LaunchError(fmt::format("{} has no length", to_string(type)), std::move(where));
    }
    const auto evaluate = [path = std::move(path)](const MessageValue& message) -> std::optional<Operand> {
      const MessageValue* const value = path.find(message);
      if (value == nullptr) {
        return std::nullopt;
      }
      const auto* const text = std::get_if<std::string>(&value->data);
      return static_cast<std::int64_t>(text != nullptr ? text->size() : value->list().size());
    };
    return {Kind::kNumber, evaluate, std::move(where)};
  }

  static Expression value(FieldPath path, SourceRange where) {
    const FieldType& type = path.type();
    if (type.many != Many::kOne || type.kind == FieldKind::kMessage) {
      throw LaunchError(fmt::format("{} can't be compared as a whole", to_string(type)), std::move(where),
                        type.many != Many::kOne ? "choose an element, such as [0], or its length, len(field)"
                                                : "choose a field of it with a point");
    }
    const Kind kind = type.kind == FieldKind::kBool                                         ? Kind::kBool
                      : type.kind == FieldKind::kString || type.kind == FieldKind::kWstring ? Kind::kText
                                                                                            : Kind::kNumber;
    const auto evaluate = [path = std::move(path)](const MessageValue& message) -> std::optional<Operand> {
      const MessageValue* const found = path.find(message);
      if (found == nullptr) {
        return std::nullopt;
      }
      return std::visit(
          [](const auto& value) -> std::optional<Operand> {
            if constexpr (std::is_same_v<std::decay_t<decltype(value)>, MessageValue::List>) {
              return std::nullopt;
            } else {
              return value;
            }
          },
          found->data);
    };
    return {kind, evaluate, std::move(where)};
  }

  const std::shared_ptr<const MessageType> message_;
  const LocatedText& text_;
  const std::string_view view_;
  std::size_t at_ = 0;
};

}  // namespace

MessageCondition::MessageCondition(std::shared_ptr<const MessageType> message, const LocatedText& text)
    : holds_(Parser(std::move(message), text).parse()) {}

}  // namespace launch
