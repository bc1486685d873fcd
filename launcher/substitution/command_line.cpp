// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <utility>

#include "launcher/substitution/template_parser.hpp"

namespace launch {

namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

// A text split as Python's shlex.split() does.
struct Words {
  std::vector<std::string> words;
  // The text begins or ends with blanks outside quotes, so its first or last word does not join the text beside it.
  bool starts_apart = false;
  bool ends_apart = false;
};

Words split_words(std::string_view text, const SourceRange& where, const std::string& quotation_help) {
  Words result;
  bool in_word = false;
  const auto word = [&]() -> std::string& {
    if (!in_word) {
      result.words.emplace_back();
      in_word = true;
    }
    return result.words.back();
  };
  result.starts_apart = !text.empty() && is_blank(text.front());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (is_blank(c)) {
      in_word = false;
    } else if (c == '\'' || c == '"') {
      std::string& quoted = word();
      for (++i; i < text.size() && text[i] != c; ++i) {
        const bool escape =
            c == '"' && text[i] == '\\' && i + 1 < text.size() && (text[i + 1] == '"' || text[i + 1] == '\\');
        i += escape ? 1 : 0;
        quoted += text[i];
      }
      if (i == text.size()) {
        throw LaunchError("no closing quotation in the command line", where, quotation_help,
                          Finding::kMalformedSubstitution);
      }
    } else if (c == '\\') {
      if (++i == text.size()) {
        throw LaunchError("nothing follows the last backslash of the command line", where, {},
                          Finding::kMalformedSubstitution);
      }
      word() += text[i];
    } else {
      word() += c;
    }
  }
  result.ends_apart = !text.empty() && !in_word;
  return result;
}

}  // namespace

std::vector<Template> split_command_line(const Template& command_line) {
  const std::string quotation_help =
      command_line.is_literal() ? std::string()
                                : "quotes can't enclose a substitution; its result is never split, so it needs none";
  std::vector<Template> arguments;
  std::vector<SubstitutionPtr> argument;
  const auto finish = [&] {
    if (!argument.empty()) {
      SourceRange where = argument.front()->where();
      where.end = argument.back()->where().end;
      arguments.emplace_back(std::exchange(argument, {}), std::move(where));
    }
  };
  for (const SubstitutionPtr& part : command_line.parts()) {
    const auto* text = dynamic_cast<const Text*>(part.get());
    if (text == nullptr) {
      argument.push_back(part);
      continue;
    }
    Words run = split_words(text->text(), text->where(), quotation_help);
    if (run.starts_apart) {
      finish();
    }
    for (std::size_t i = 0; i < run.words.size(); ++i) {
      if (i > 0) {
        finish();
      }
      argument.push_back(std::make_shared<Text>(std::move(run.words[i]), text->where()));
    }
    if (run.ends_apart) {
      finish();
    }
  }
  finish();
  return arguments;
}

std::vector<std::string> split_shell_words(std::string_view text, const SourceRange& where) {
  return split_words(text, where, {}).words;
}

}  // namespace launch
