// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/objects/callback_symbol.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace tracing {

namespace {

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

// One past the bracket that closes the one at `open`; npos when there is none.
std::size_t after_closing(std::string_view text, std::size_t open, char opening, char closing) {
  int depth = 0;
  for (std::size_t i = open; i < text.size(); ++i) {
    if (text[i] == opening) {
      ++depth;
    }
    if (text[i] == closing && --depth == 0) {
      return i + 1;
    }
  }
  return std::string_view::npos;
}

// Removes `prefix` and the template arguments after it.
void remove_template(std::string& text, std::string_view prefix) {
  for (std::size_t at = text.find(prefix); at != std::string::npos; at = text.find(prefix, at)) {
    const std::size_t end = after_closing(text, at + prefix.size() - 1, '<', '>');
    if (end == std::string::npos) {
      return;
    }
    text.erase(at, end - at);
  }
}

// Turns "void (C::*(C*, std::_Placeholder<1>))(Arguments)" into "C::?(Arguments)"; other text stays as it is.
std::string method_of_bind(std::string_view bound) {
  constexpr std::string_view kPointerToMember = "::*";
  const std::size_t star = bound.find(kPointerToMember);
  const std::size_t open = star == std::string_view::npos ? star : bound.rfind('(', star);
  if (open == std::string_view::npos) {
    return std::string(bound);
  }
  const std::size_t after = after_closing(bound, open, '(', ')');
  if (after == std::string_view::npos) {
    return std::string(bound);
  }
  const std::string_view class_name = bound.substr(open + 1, star - open - 1);
  return std::string(class_name) + "::?" + std::string(bound.substr(after));
}

}  // namespace

std::string readable_symbol(std::string_view symbol) {
  std::string text(symbol);
  replace_all(text, "__cxx11::", "");
  replace_all(text, "> >", ">>");
  replace_all(text, "> >", ">>");  // the call before leaves one of three in a row
  replace_all(text, "std::basic_string<char, std::char_traits<char>, std::allocator<char>>", "std::string");
  replace_all(text, "_<std::allocator<void>>", "");
  remove_template(text, ", std::allocator<");
  remove_template(text, ", std::default_delete<");

  constexpr std::string_view kBind = "std::_Bind<";
  if (text.starts_with(kBind) && text.ends_with('>')) {
    text = method_of_bind(std::string_view(text).substr(kBind.size(), text.size() - kBind.size() - 1));
  }
  return text;
}

namespace {

// The parts between "::" that are outside of brackets.
std::vector<std::string_view> name_parts(std::string_view name) {
  std::vector<std::string_view> parts;
  int depth = 0;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name[i] == '<' || name[i] == '(' || name[i] == '{') {
      ++depth;
    }
    if (name[i] == '>' || name[i] == ')' || name[i] == '}') {
      --depth;
    }
    if (depth == 0 && name.substr(i, 2) == "::") {
      parts.push_back(name.substr(begin, i - begin));
      begin = i + 2;
      ++i;
    }
  }
  parts.push_back(name.substr(begin));
  return parts;
}

// Without parameters and template arguments.
std::string_view bare(std::string_view part) {
  return part.substr(0, part.find_first_of("(<"));
}

}  // namespace

std::string short_symbol(std::string_view readable) {
  std::string_view name = readable;
  // The return type of a function template: "void (anonymous namespace)::f<int>(int)".
  if (name.starts_with("void ")) {
    name.remove_prefix(5);
  }
  std::vector<std::string_view> parts = name_parts(name);
  // A lambda is named after the function that it stands in.
  const auto first_lambda =
      std::find_if(parts.begin() + 1, parts.end(), [](std::string_view part) { return part.starts_with("{lambda"); });
  const bool lambda = first_lambda != parts.end();
  parts.erase(first_lambda, parts.end());
  std::string_view last = bare(parts.back());
  if (last.empty()) {
    last = parts.back();
  }
  std::string text(last);
  if (parts.size() > 1 && !parts[parts.size() - 2].starts_with("(anonymous")) {
    const std::string_view scope = bare(parts[parts.size() - 2]);
    if (!scope.empty()) {
      text = fmt::format("{}::{}", scope, last);
    }
  }
  return lambda ? text + " lambda" : text;
}

}  // namespace tracing
