// SPDX-License-Identifier: Apache-2.0
#include "launcher/substitution/template_parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "launcher/substitution/foreign_substitutions.hpp"

namespace launch {

namespace {

// Far above what a person writes, far below what would exhaust the stack.
constexpr int kMaximumNesting = 200;

// Names of substitutions in ROS 1, and the substitutions that replace them.
constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kFormerNames = {{
    {"arg", "$(var NAME)"},
    {"find", "$(find-pkg-share PKG)"},
    {"optenv", "$(env NAME DEFAULT)"},
}};

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
bool is_name_character(char c) {
  return is_letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

std::string argument_count(const SubstitutionType& type) {
  const int minimum = type.minimum_arguments;
  const int maximum = type.maximum_arguments;
  if (maximum == 0) {
    return "no arguments";
  }
  if (maximum == SubstitutionType::kAnyNumber) {
    return fmt::format("at least {} argument{}", minimum, minimum == 1 ? "" : "s");
  }
  if (minimum == maximum) {
    return fmt::format("{} argument{}", minimum, minimum == 1 ? "" : "s");
  }
  return fmt::format("{} {} {} arguments", minimum, minimum + 1 == maximum ? "or" : "to", maximum);
}

// Recursive descent over the grammar of the reference, section "Substitutions". A character counts as escaped when a
// backslash stands directly before it, even if that backslash is itself preceded by another.
class TemplateParser {
 public:
  explicit TemplateParser(const LocatedText& source) : source_(source), text_(source.text()) {}

  Template parse() {
    if (text_.find("$(") == std::string::npos) {
      return text_.empty() ? Template(std::vector<SubstitutionPtr>(), source_.range())
                           : Template(unescape(text_), source_.range());
    }
    std::vector<SubstitutionPtr> parts;
    while (position_ < text_.size()) {
      parts.push_back(at_substitution() ? substitution(kNone) : literal(text_run_end()));
    }
    return {std::move(parts), source_.range()};
  }

 private:
  // Inside a quoted argument, substitutions have bare arguments only and the other quote is an ordinary character.
  enum Quote : char { kNone = 0, kSingle = '\'', kDouble = '"' };

  bool at_end() const { return position_ >= text_.size(); }
  bool at(char c) const { return !at_end() && text_[position_] == c; }
  bool is_escaped(std::size_t position) const { return position > 0 && text_[position - 1] == '\\'; }
  bool starts_substitution(std::size_t position) const {
    return text_.compare(position, 2, "$(") == 0 && !is_escaped(position);
  }
  bool at_substitution() const { return !at_end() && starts_substitution(position_); }

  [[noreturn]] void fail(std::string message, std::size_t begin, std::size_t length, std::string help = {}) const {
    throw LaunchError(std::move(message), source_.range(begin, length), std::move(help),
                      Finding::kMalformedSubstitution);
  }

  // End of the literal run that starts here at the top level.
  std::size_t text_run_end() const {
    std::size_t end = text_.find("$(", position_);
    while (end != std::string::npos && is_escaped(end)) {
      end = text_.find("$(", end + 1);
    }
    return std::min(end, text_.size());
  }

  SubstitutionPtr literal(std::size_t end) {
    const std::size_t begin = std::exchange(position_, end);
    return std::make_shared<Text>(unescape(std::string_view(text_).substr(begin, end - begin)),
                                  source_.range(begin, end - begin));
  }

  SubstitutionPtr substitution(Quote quote) {
    const std::size_t begin = position_;
    if (++nesting_ > kMaximumNesting) {
      fail(fmt::format("substitutions are nested more than {} levels deep", kMaximumNesting), begin, 2);
    }
    position_ += 2;
    const std::size_t name_begin = position_;
    const std::string name = substitution_name(begin);
    std::vector<Template> arguments;
    while (!at(')')) {
      if (at_end()) {
        fail(fmt::format("the substitution '$({}' is not closed", name), begin, name_begin + name.size() - begin,
             "add ')' at its end");
      }
      if (!at(' ')) {
        fail_after_item(name, arguments.empty());
      }
      ++position_;
      arguments.push_back(argument(begin, name, quote));
    }
    ++position_;
    --nesting_;
    return make(name, source_.range(name_begin, name.size()), std::move(arguments),
                source_.range(begin, position_ - begin));
  }

  std::string substitution_name(std::size_t begin) {
    const std::size_t name_begin = position_;
    if (at(')')) {
      fail("empty substitution '$()'", begin, 3, "write \\$( for the characters themselves");
    }
    if (at(' ')) {
      fail("space after '$('", position_, 1, "write the name directly after '$('");
    }
    if (at_end()) {
      fail("the substitution '$(' is not closed", begin, 2, "write \\$( for the characters themselves");
    }
    if (!is_letter(text_[position_])) {
      fail(fmt::format("the name of a substitution can't start with '{}'", text_[position_]), position_, 1,
           "write \\$( for the characters themselves");
    }
    while (!at_end() && is_name_character(text_[position_])) {
      ++position_;
    }
    return text_.substr(name_begin, position_ - name_begin);
  }

  // Reports that something other than a space or ")" follows the name or an argument.
  [[noreturn]] void fail_after_item(const std::string& name, bool item_is_name) const {
    const char found = text_[position_];
    if (item_is_name) {
      fail(fmt::format("unexpected '{}' in the name of a substitution", found), position_, 1,
           fmt::format("one space separates the name from its arguments: $({} ...)", name));
    }
    if (found == '(') {
      fail("'(' inside an argument", position_, 1, "quote the argument, or write \\(");
    }
    if (found == '\'' || found == '"') {
      fail(fmt::format("quote {} in the middle of an argument", found), position_, 1,
           fmt::format("quote the whole argument, or write \\{}", found));
    }
    fail("text directly after a quoted argument", position_, 1, "put the whole argument inside the quotes");
  }

  Template argument(std::size_t begin, const std::string& name, Quote quote) {
    if (at(' ')) {
      fail("two spaces between the arguments of a substitution", position_ - 1, 2,
           "separate them by one space; '' is an empty argument");
    }
    if (at(')')) {
      fail("space before ')'", position_ - 1, 1, "remove the space; '' is an empty argument");
    }
    if (at_end()) {
      fail(fmt::format("the substitution '$({}' is not closed", name), begin, 2 + name.size(), "add ')' at its end");
    }
    if (quote == kNone && (at('\'') || at('"'))) {
      return quoted_argument(at('"') ? kDouble : kSingle);
    }
    return bare_argument(quote);
  }

  Template quoted_argument(Quote quote) {
    const std::size_t begin = position_++;
    std::vector<SubstitutionPtr> parts;
    while (true) {
      std::size_t end = position_;
      const auto closes = [&] { return text_[end] == quote && !is_escaped(end); };
      while (end < text_.size() && !closes() && !starts_substitution(end)) {
        ++end;
      }
      if (end > position_) {
        parts.push_back(literal(end));
      }
      if (at_end()) {
        fail(fmt::format("the argument that starts with {} is not closed", static_cast<char>(quote)), begin, 1,
             fmt::format("add {} at its end", static_cast<char>(quote)));
      }
      if (at(quote)) {
        break;
      }
      parts.push_back(substitution(quote));
    }
    ++position_;
    return {std::move(parts), source_.range(begin, position_ - begin)};
  }

  Template bare_argument(Quote quote) {
    const std::size_t begin = position_;
    std::vector<SubstitutionPtr> parts;
    while (true) {
      std::size_t end = position_;
      while (end < text_.size() && !ends_bare_run(end, quote)) {
        ++end;
      }
      if (end > position_) {
        parts.push_back(literal(end));
      }
      if (!at_substitution()) {
        break;
      }
      parts.push_back(substitution(quote));
    }
    if (parts.empty()) {
      fail_after_item({}, false);
    }
    return {std::move(parts), source_.range(begin, position_ - begin)};
  }

  bool ends_bare_run(std::size_t position, Quote quote) const {
    const char c = text_[position];
    if (c == ' ') {
      return true;
    }
    if (c == '$') {
      return starts_substitution(position);
    }
    const bool special =
        c == '(' || c == ')' || (quote == kNone ? c == '\'' || c == '"' : c == static_cast<char>(quote));
    return special && !is_escaped(position);
  }

  static SubstitutionPtr make(const std::string& name, const SourceRange& name_where, std::vector<Template> arguments,
                              SourceRange where) {
    const std::vector<SubstitutionType>& types = substitution_types();
    const auto type = std::find_if(types.begin(), types.end(), [&](const auto& t) { return t.name == name; });
    if (type == types.end()) {
      return make_foreign(name, name_where, std::move(arguments), where);
    }
    if (std::optional<std::string> wrong = wrong_number_of_arguments(*type, arguments.size())) {
      const bool too_many = static_cast<int>(arguments.size()) > type->minimum_arguments;
      throw LaunchError(
          std::move(*wrong), std::move(where),
          fmt::format("usage: {}{}", type->usage,
                      too_many && type->maximum_arguments > 0 ? "; quote an argument that has spaces" : ""),
          Finding::kMalformedSubstitution);
    }
    return type->make(std::move(arguments), std::move(where));
  }

  static SubstitutionPtr make_foreign(const std::string& name, const SourceRange& name_where,
                                      std::vector<Template> arguments, const SourceRange& where) {
    const std::string message = fmt::format("unknown substitution '{}'", name);
    for (const auto& [former, present] : kFormerNames) {
      if (name == former) {
        throw LaunchError(message, name_where, fmt::format("in ROS 2 it is {}", present), Finding::kUnknownName);
      }
    }
    const ForeignSubstitutions& foreign = foreign_substitutions();
    if (foreign.make) {
      if (SubstitutionPtr made = foreign.make(name, std::move(arguments), where)) {
        return made;
      }
    }
    ForeignNames others = foreign.names ? foreign.names() : ForeignNames();
    for (const SubstitutionType& type : substitution_types()) {
      others.names.push_back(type.name);
    }
    std::string help = did_you_mean(name, others.names);
    throw LaunchError(message, name_where, help.empty() ? others.problem : help, Finding::kUnknownName);
  }

  const LocatedText& source_;
  const std::string& text_;
  std::size_t position_ = 0;
  int nesting_ = 0;
};

ForeignSubstitutions& known_foreign_substitutions() {
  static ForeignSubstitutions substitutions;
  return substitutions;
}

}  // namespace

std::optional<std::string> wrong_number_of_arguments(const SubstitutionType& type, std::size_t count) {
  const int given = static_cast<int>(count);
  const bool too_many = type.maximum_arguments != SubstitutionType::kAnyNumber && given > type.maximum_arguments;
  if (given >= type.minimum_arguments && !too_many) {
    return std::nullopt;
  }
  return fmt::format("substitution '{}' takes {}, got {}", type.name, argument_count(type), given);
}

Template parse_template(const LocatedText& text) {
  return TemplateParser(text).parse();
}

std::string unescape(std::string_view text) {
  if (text.find('\\') == std::string_view::npos) {
    return std::string(text);
  }
  std::string result;
  result.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\\' && i + 1 < text.size() && text[i + 1] != '\n') {
      ++i;
    }
    result += text[i];
  }
  return result;
}

void use_foreign_substitutions(ForeignSubstitutions substitutions) {
  known_foreign_substitutions() = std::move(substitutions);
}

const ForeignSubstitutions& foreign_substitutions() {
  return known_foreign_substitutions();
}

}  // namespace launch
