// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <charconv>
#include <regex>
#include <utility>

#include "base/conditions/field_condition.hpp"
#include "base/diagnostics/diagnostic.hpp"

namespace launch {

namespace {

class FieldConditionParser {
 public:
  using Relation = FieldCondition::Relation;
  using Operand = FieldCondition::Operand;
  using Node = FieldCondition::Node;

  FieldConditionParser(const LocatedText& text, FieldCondition::Of of, std::vector<FieldPath>& fields)
      : located_(text), text_(text.text()), of_(of), fields_(fields) {}

  Node parse() {
    Node root = list(Node::Kind::kOr);
    skip_blanks();
    if (at_ < text_.size()) {
      fail(at_, text_.size() - at_, fmt::format("unexpected '{}'", text_.substr(at_)),
           "conditions are joined by 'and' and 'or'");
    }
    return root;
  }

 private:
  [[noreturn]] void fail(std::size_t at, std::size_t length, std::string what, std::string help = {}) const {
    throw LaunchError(std::move(what), located_.range(at, length), std::move(help));
  }

  static bool is_digit(char c) { return c >= '0' && c <= '9'; }
  static bool is_word(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || is_digit(c) || c == '_'; }

  char next(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }

  void skip_blanks() {
    while (at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos) {
      ++at_;
    }
  }

  bool take(std::string_view symbol) {
    skip_blanks();
    if (!text_.substr(at_).starts_with(symbol) || (is_word(symbol.back()) && is_word(next(symbol.size())))) {
      return false;
    }
    at_ += symbol.size();
    return true;
  }

  Node list(Node::Kind kind) {
    const bool is_or = kind == Node::Kind::kOr;
    Node node;
    node.kind = kind;
    do {
      node.parts.push_back(is_or ? list(Node::Kind::kAnd) : negation());
    } while (is_or ? take("||") || take("or") : take("&&") || take("and"));
    if (node.parts.size() > 1) {
      return node;
    }
    Node only = std::move(node.parts.front());
    return only;
  }

  Node negation() {
    if (take("!") || take("not")) {
      Node node;
      node.kind = Node::Kind::kNot;
      node.parts.push_back(negation());
      return node;
    }
    if (take("(")) {
      Node node = list(Node::Kind::kOr);
      close();
      return node;
    }
    return comparison();
  }

  void close() {
    if (!take(")")) {
      fail(at_, 1, "expected ')'");
    }
  }

  Node comparison() {
    Node node;
    node.operands.push_back(operand(nullptr, false));
    while (const auto relation = take_relation()) {
      const bool is_pattern = *relation == Relation::kMatches;
      Operand right = operand(&node.operands.back(), is_pattern);
      if (is_pattern) {
        set_pattern(right);
      }
      node.relations.push_back(*relation);
      node.operands.push_back(std::move(right));
    }
    return node;
  }

  std::optional<Relation> take_relation() {
    constexpr std::array<std::pair<std::string_view, Relation>, 7> kRelations{{{"==", Relation::kEqual},
                                                                               {"!=", Relation::kNotEqual},
                                                                               {"<=", Relation::kLessOrEqual},
                                                                               {">=", Relation::kGreaterOrEqual},
                                                                               {"=~", Relation::kMatches},
                                                                               {"<", Relation::kLess},
                                                                               {">", Relation::kGreater}}};
    for (const auto& [symbol, relation] : kRelations) {
      if (take(symbol)) {
        return relation;
      }
    }
    if (next() == '=') {
      fail(at_, 1, of_ == FieldCondition::Of::kMessages ? "'=' is no comparison" : "expected '==' to compare",
           "write '=='");
    }
    return std::nullopt;
  }

  // `left` is null for the first operand of a comparison.
  Operand operand(const Operand* left, bool is_pattern) {
    skip_blanks();
    const std::size_t begin = at_;
    if (next() == '\'' || next() == '"') {
      return quoted(is_pattern || of_ == FieldCondition::Of::kEvents);
    }
    if (is_digit(next()) || next() == '-' || next() == '+' || (next() == '.' && is_digit(next(1)))) {
      return number();
    }
    for (const std::string_view word : {"true", "True", "false", "False"}) {
      if (take(word)) {
        return {Operand::Kind::kBool, std::int64_t{word == "true" || word == "True"},
                located_.range(begin, at_ - begin)};
      }
    }
    if (take("len") && take("(")) {
      Operand length = field(begin, "expected the name of a field");
      length.kind = Operand::Kind::kLength;
      close();
      length.where = located_.range(begin, at_ - begin);
      return length;
    }
    at_ = begin;  // `len` without a bracket is a field, too
    if (of_ == FieldCondition::Of::kEvents && left != nullptr && left->kind == Operand::Kind::kField) {
      return number();
    }
    return field(begin, left == nullptr ? "expected the name of a field" : "expected a value");
  }

  Operand field(std::size_t begin, const char* missing) {
    skip_blanks();
    const std::size_t from = at_;
    FieldPath path = FieldPath::take(located_, at_);
    if (path.parts.empty() || std::holds_alternative<std::size_t>(path.parts.front().step)) {
      fail(from, 1, missing);
    }
    fields_.push_back(std::move(path));
    return {Operand::Kind::kField, {}, located_.range(begin, at_ - begin), fields_.size() - 1};
  }

  Operand quoted(bool keeps_backslashes) {
    const std::size_t begin = at_++;
    const char quote = text_[begin];
    std::string value;
    for (; at_ < text_.size() && text_[at_] != quote; ++at_) {
      const bool is_escape =
          text_[at_] == '\\' && at_ + 1 < text_.size() && (!keeps_backslashes || next(1) == quote || next(1) == '\\');
      at_ += is_escape ? 1 : 0;
      value += text_[at_];
    }
    if (at_ == text_.size()) {
      fail(at_, 1, "a text has no closing quote");
    }
    ++at_;
    return {Operand::Kind::kText, std::move(value), located_.range(begin, at_ - begin)};
  }

  Operand number() {
    const std::size_t begin = at_;
    at_ += next() == '+' || next() == '-' ? 1 : 0;
    while (is_word(next()) || next() == '.' || ((next() == '-' || next() == '+') && (text_[at_ - 1] | 0x20) == 'e')) {
      ++at_;
    }
    const std::string_view whole = text_.substr(begin, at_ - begin);
    const std::string_view digits = whole.substr(whole.starts_with('+') ? 1 : 0);
    Operand number{Operand::Kind::kNumber, {}, located_.range(begin, whole.size())};
    const auto reads = [&]<class T>(T value, std::string_view text, auto... base) {
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base...);
      number.value = value;
      return error == std::errc() && end == text.data() + text.size();
    };
    if (digits.starts_with("0x")
            ? reads(std::uint64_t{}, digits.substr(2), 16)
            : reads(std::int64_t{}, digits) || reads(std::uint64_t{}, digits) || reads(double{}, digits)) {
      return number;
    }
    fail(begin, std::max<std::size_t>(whole.size(), 1),
         whole.empty() ? "expected a value" : fmt::format("'{}' is no number; texts stand in quotes", whole));
  }

  void set_pattern(Operand& operand) const {
    const auto* const pattern = std::get_if<std::string>(&operand.value);
    if (pattern == nullptr) {
      throw LaunchError("'=~' needs a text in quotes", operand.where);
    }
    try {
      operand.matches = [regex = std::regex(*pattern, std::regex::ECMAScript | std::regex::optimize)](
                            std::string_view text) { return std::regex_search(text.begin(), text.end(), regex); };
    } catch (const std::regex_error&) {
      throw LaunchError(fmt::format("'{}' is no regular expression", *pattern), operand.where);
    }
  }

  const LocatedText& located_;
  const std::string_view text_;
  const FieldCondition::Of of_;
  std::vector<FieldPath>& fields_;
  std::size_t at_ = 0;
};

}  // namespace

FieldCondition::FieldCondition(const LocatedText& text, Of of)
    : root_(FieldConditionParser(text, of, fields_).parse()) {}

}  // namespace launch
