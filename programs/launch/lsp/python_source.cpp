// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/lsp/python_source.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "programs/launch/lsp/python_names.hpp"

namespace launch::lsp {

namespace {

bool is_name_byte(char byte) {
  return std::isalnum(static_cast<unsigned char>(byte)) != 0 || byte == '_' || static_cast<unsigned char>(byte) >= 0x80;
}

// Words that begin a statement: an open bracket before them was forgotten.
bool begins_statement(std::string_view word) {
  constexpr std::array<std::string_view, 8> kWords = {"def",  "class", "return", "import",
                                                      "from", "with",  "raise",  "try"};
  return std::find(kWords.begin(), kWords.end(), word) != kWords.end();
}

class PythonScanner {
 public:
  explicit PythonScanner(std::string_view text) : text_(text) {}

  std::vector<PythonToken> tokens() {
    bool begins_line = true;
    while (at_ < text_.size()) {
      const char byte = text_[at_];
      if (byte == '\n') {
        add(PythonToken::Kind::kLineEnd, at_, at_ + 1);
        begins_line = true;
      } else if (byte == '#') {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else if (byte == '\\' || std::isspace(static_cast<unsigned char>(byte)) != 0) {
        at_ += byte == '\\' && at_ + 1 < text_.size() ? 2 : 1;
      } else {
        const std::size_t before = tokens_.size();
        word_or_other();
        tokens_[before].starts_statement = std::exchange(begins_line, false);
      }
    }
    return std::move(tokens_);
  }

 private:
  void add(PythonToken::Kind kind, std::size_t begin, std::size_t end, Span content = {}, bool is_format = false) {
    tokens_.push_back({kind, {begin, end}, content, is_format});
    at_ = end;
  }

  void word_or_other() {
    const std::size_t begin = at_;
    std::size_t end = begin;
    while (end < text_.size() && is_name_byte(text_[end])) {
      ++end;
    }
    const bool is_quote = end < text_.size() && (text_[end] == '"' || text_[end] == '\'');
    if (is_quote && end - begin <= 2) {
      string(begin, end);
    } else if (end > begin) {
      const bool is_number = std::isdigit(static_cast<unsigned char>(text_[begin])) != 0;
      add(is_number ? PythonToken::Kind::kNumber : PythonToken::Kind::kName, begin, end);
    } else {
      add(PythonToken::Kind::kOperator, begin, begin + 1);
    }
  }

  void string(std::size_t begin, std::size_t quote) {
    const std::string_view prefix = text_.substr(begin, quote - begin);
    const bool is_format = prefix.find_first_of("fF") != std::string_view::npos;
    const std::string three(3, text_[quote]);
    const bool is_long = text_.substr(quote, 3) == three;
    const std::size_t start = quote + (is_long ? 3 : 1);
    std::size_t end = start;
    while (end < text_.size() && (is_long ? text_.substr(end, 3) != three : text_[end] != text_[quote]) &&
           (is_long || text_[end] != '\n')) {
      end += text_[end] == '\\' && end + 1 < text_.size() ? 2 : 1;
    }
    end = std::min(end, text_.size());
    const bool closed = end < text_.size() && text_[end] == text_[quote];
    add(PythonToken::Kind::kString, begin, closed ? end + (is_long ? 3 : 1) : end, {start, end}, is_format);
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::vector<PythonToken> tokens_;
};

class PythonReader {
 public:
  explicit PythonReader(std::string_view text) : text_(text) {
    source_.tokens = PythonScanner(text).tokens();
    source_.opened.assign(source_.tokens.size(), -1);
  }

  PythonSource read() {
    for (std::size_t i = 0; i < tokens().size(); ++i) {
      const PythonToken& token = tokens()[i];
      if (token.starts_statement && begins_statement(word(i))) {
        while (!open_.empty()) {
          close(i, false);
        }
      }
      if (token.kind != PythonToken::Kind::kOperator) {
        if (token.starts_statement && open_.empty()) {
          statement(i);
        }
        continue;
      }
      switch (text_[token.span.begin]) {
        case '(':
        case '[':
        case '{':
          open(i);
          break;
        case ')':
        case ']':
        case '}':
          if (!open_.empty()) {
            close(i, true);
          }
          break;
        case ',':
          if (!open_.empty()) {
            end_argument(i);
          }
          break;
        default:
          break;
      }
    }
    while (!open_.empty()) {
      close(tokens().size(), false);
    }
    return std::move(source_);
  }

 private:
  const std::vector<PythonToken>& tokens() const { return source_.tokens; }
  std::string_view word(std::size_t token) const {
    const Span span = tokens()[token].span;
    return text_.substr(span.begin, span.end - span.begin);
  }
  bool is(std::size_t token, std::string_view what) const { return token < tokens().size() && word(token) == what; }
  bool is_name(std::size_t token) const {
    return token < tokens().size() && tokens()[token].kind == PythonToken::Kind::kName;
  }
  std::size_t begin_of(std::size_t token) const {
    return token < tokens().size() ? tokens()[token].span.begin : text_.size();
  }

  void open(std::size_t token) {
    PythonBrackets brackets;
    brackets.open = text_[tokens()[token].span.begin];
    brackets.parent = open_.empty() ? -1 : static_cast<int>(open_.back());
    brackets.first = token + 1;
    brackets.inside.begin = tokens()[token].span.end;
    std::size_t first = token;
    if (brackets.open == '(' && token > 0 && is_name(token - 1)) {
      first = token - 1;
      while (first >= 2 && is(first - 1, ".") && is_name(first - 2)) {
        first -= 2;
      }
      const bool defines = first > 0 && (is(first - 1, "def") || is(first - 1, "class"));
      const bool is_method = first > 0 && is(first - 1, ".");  // of a value: PathJoinSubstitution(…).perform(
      if (!defines && !is_method) {
        brackets.callee_span = {tokens()[first].span.begin, tokens()[token - 1].span.end};
        for (std::size_t i = first; i < token; ++i) {
          brackets.callee += word(i);
        }
      }
    }
    source_.opened[token] = static_cast<int>(source_.brackets.size());
    open_.push_back(source_.brackets.size());
    source_.brackets.push_back(std::move(brackets));
    begin_argument(token + 1);
  }

  void begin_argument(std::size_t token) {
    PythonArgument argument;
    argument.first = token;
    const PythonBrackets& brackets = source_.brackets[open_.back()];
    argument.whole.begin = brackets.arguments.empty() ? brackets.inside.begin : tokens()[token - 1].span.end;
    source_.brackets[open_.back()].arguments.push_back(std::move(argument));
  }

  void finish_argument(std::size_t token) {
    PythonArgument& argument = source_.brackets[open_.back()].arguments.back();
    argument.last = token;
    argument.whole.end = begin_of(token);
    while (argument.first < argument.last && tokens()[argument.first].kind == PythonToken::Kind::kLineEnd) {
      ++argument.first;
    }
    while (argument.last > argument.first && tokens()[argument.last - 1].kind == PythonToken::Kind::kLineEnd) {
      --argument.last;
    }
    if (argument.first + 1 < argument.last && is_name(argument.first) && is(argument.first + 1, "=") &&
        !is(argument.first + 2, "=")) {
      argument.keyword = word(argument.first);
      argument.keyword_span = tokens()[argument.first].span;
      argument.first += 2;
    }
  }

  void end_argument(std::size_t token) {
    finish_argument(token);
    begin_argument(token + 1);
  }

  void close(std::size_t token, bool closed) {
    finish_argument(token);
    PythonBrackets& brackets = source_.brackets[open_.back()];
    brackets.last = token;
    brackets.inside.end = begin_of(token);
    brackets.closed = closed;
    if (brackets.arguments.size() > 1 && brackets.arguments.back().first == brackets.arguments.back().last) {
      brackets.arguments.pop_back();  // behind the last comma
    }
    open_.pop_back();
  }

  // "a.b.c", and the token behind it.
  std::pair<std::string, std::size_t> dotted(std::size_t token) const {
    std::string name;
    while (is_name(token) || is(token, ".")) {
      if (is_name(token) && !name.empty() && name.back() != '.') {
        break;
      }
      name += word(token++);
    }
    return {name, token};
  }

  void statement(std::size_t token) {
    if (is(token, "from")) {
      from(token + 1);
    } else if (is(token, "import")) {
      import(token + 1);
    } else if (is(token, "def") && is_name(token + 1)) {
      source_.definitions.emplace(word(token + 1), tokens()[token + 1].span);
    } else if (is_name(token) && is(token + 1, "=") && !is(token + 2, "=")) {
      std::size_t end = token + 2;
      for (int depth = 0; end < tokens().size(); ++end) {
        depth += is(end, "(") || is(end, "[") || is(end, "{")   ? 1
                 : is(end, ")") || is(end, "]") || is(end, "}") ? -1
                                                                : 0;
        if (depth <= 0 && tokens()[end].kind == PythonToken::Kind::kLineEnd) {
          break;
        }
      }
      source_.values.insert_or_assign(std::string(word(token)), std::pair(token + 2, end));
      source_.definitions.emplace(word(token), tokens()[token].span);
    }
  }

  void from(std::size_t token) {
    const std::size_t first = token;
    std::string module;
    std::tie(module, token) = dotted(token);
    if (module.ends_with("import") && token > first) {  // "from launch.import": the name is being written
      return;
    }
    const Span span = token > first ? Span{tokens()[first].span.begin, tokens()[token - 1].span.end} : Span{};
    if (!is(token, "import")) {
      source_.imports.push_back({module, span, "", {}, ""});
      return;
    }
    const std::size_t start = source_.imports.size();
    if (is(token + 1, "*")) {
      source_.imports.push_back({module, span, "*", tokens()[token + 1].span, "*"});
      return;
    }
    for (++token; token < tokens().size(); ++token) {
      const bool in_brackets = is(token, "(") || is(token, ")") || is(token, ",");
      if (is_name(token)) {
        const bool renamed = is(token + 1, "as") && is_name(token + 2);
        source_.imports.push_back({module, span, std::string(word(token)), tokens()[token].span,
                                   std::string(word(renamed ? token + 2 : token))});
        token += renamed ? 2 : 0;
      } else if (is(token, ")") || (!in_brackets && tokens()[token].kind != PythonToken::Kind::kLineEnd) ||
                 (tokens()[token].kind == PythonToken::Kind::kLineEnd && !opened_before(token))) {
        break;
      }
    }
    if (source_.imports.size() == start) {
      source_.imports.push_back({module, span, "", {}, ""});
    }
  }

  // Whether the last bracket before the token is open.
  bool opened_before(std::size_t token) const {
    while (token-- > 0 && !tokens()[token].starts_statement) {
      if (is(token, "(") || is(token, ")")) {
        return is(token, "(");
      }
    }
    return false;
  }

  void import(std::size_t token) {
    while (is_name(token)) {
      const std::size_t first = token;
      std::string module;
      std::tie(module, token) = dotted(token);
      const Span span{tokens()[first].span.begin, tokens()[token - 1].span.end};
      std::string as = module;
      if (is(token, "as") && is_name(token + 1)) {
        as = word(token + 1);
        token += 2;
      }
      source_.imports.push_back({module, span, "", {}, as});
      token += is(token, ",") ? 1 : 0;
    }
  }

  std::string_view text_;
  PythonSource source_;
  std::vector<std::size_t> open_;  // numbers of the brackets that are open
};

}  // namespace

const PythonArgument* PythonBrackets::find(std::string_view keyword) const {
  const auto found = std::find_if(arguments.begin(), arguments.end(),
                                  [&](const PythonArgument& argument) { return argument.keyword == keyword; });
  return found == arguments.end() ? nullptr : &*found;
}

const PythonArgument* PythonBrackets::find(std::string_view keyword, std::size_t place) const {
  const PythonArgument* const named = find(keyword);
  const bool is_there =
      place < arguments.size() && arguments[place].keyword.empty() && arguments[place].first < arguments[place].last;
  return named != nullptr ? named : is_there ? &arguments[place] : nullptr;
}

int PythonSource::brackets_at(std::size_t offset) const {
  int found = -1;
  for (std::size_t i = 0; i < brackets.size(); ++i) {
    if (brackets[i].inside.holds(offset)) {
      found = static_cast<int>(i);
    }
  }
  return found;
}

int PythonSource::brackets_from(std::size_t token) const {
  return token < opened.size() ? opened[token] : -1;
}

const PythonToken* PythonSource::token_at(std::size_t offset) const {
  const PythonToken* found = nullptr;
  for (const PythonToken& token : tokens) {
    if (token.kind != PythonToken::Kind::kLineEnd && token.span.holds(offset) &&
        (found == nullptr || token.kind != PythonToken::Kind::kOperator)) {
      found = &token;
    }
  }
  return found;
}

std::string PythonSource::full_name(std::string_view written) const {
  const std::string_view first = written.substr(0, written.find('.'));
  for (const PythonImport& import : imports) {
    if (import.as == first && !import.name.empty()) {
      return import.module + "." + import.name + std::string(written.substr(first.size()));
    }
    const bool is_module = !import.as.empty() && import.name.empty() && written.starts_with(import.as) &&
                           (written.size() == import.as.size() || written[import.as.size()] == '.');
    if (is_module) {
      return import.module + std::string(written.substr(import.as.size()));
    }
  }
  for (const PythonImport& import : imports) {
    std::string full = import.module + "." + std::string(written);
    if (import.name == "*" && PythonNames::of_installation().find(full) != nullptr) {
      return full;
    }
  }
  return {};
}

PythonSource python_source_of(std::string_view text) {
  return PythonReader(text).read();
}

}  // namespace launch::lsp
