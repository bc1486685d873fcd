// SPDX-License-Identifier: Apache-2.0
#include "launcher/frontend/yaml_events.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <istream>
#include <streambuf>
#include <string_view>
#include <utility>

#include "launcher/frontend/input_text.hpp"

namespace launch {

namespace {

using EventKind = YamlEvent::Kind;

// Reads a text as a stream without a copy.
class TextBuffer : public std::streambuf {
 public:
  explicit TextBuffer(const std::string& text) {
    char* const begin = const_cast<char*>(text.data());  // only read: no function that writes is overridden
    setg(begin, begin, begin + text.size());
  }
};

// The positions of yaml-cpp do not count a byte order mark.
std::size_t place_of(const YAML::Mark& mark, const std::string& text) {
  const std::size_t offset = text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
  return std::min(static_cast<std::size_t>(std::max(mark.pos, 0)) + offset, text.size());
}

class Recorder : public YAML::EventHandler {
 public:
  Recorder(const std::string& text, YamlEvents& events) : text_(text), events_(events) {}

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { add(EventKind::kNull, mark, anchor); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override { add(EventKind::kAlias, mark, anchor); }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    YamlEvent& event = add(EventKind::kScalar, mark, anchor);
    event.is_plain = tag.size() == 1 && tag.front() == '?';
    event.text = size();
    events_.texts += value;
    event.tag = size();
    if (!event.is_plain) {
      events_.texts += tag;
    }
    event.tag_end = size();
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value style) override {
    add_collection(EventKind::kSequence, mark, tag, anchor, style);
  }
  void OnSequenceEnd() override { events_.list.push_back({EventKind::kEnd}); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value style) override {
    add_collection(EventKind::kMapping, mark, tag, anchor, style);
  }
  void OnMapEnd() override { events_.list.push_back({EventKind::kEnd}); }

 private:
  std::uint32_t size() const { return static_cast<std::uint32_t>(events_.texts.size()); }

  YamlEvent& add(EventKind kind, const YAML::Mark& mark, YAML::anchor_t anchor) {
    YamlEvent& event = events_.list.emplace_back();
    event.kind = kind;
    event.at = static_cast<std::uint32_t>(place_of(mark, text_));
    event.anchor = anchor;
    return event;
  }

  void add_collection(EventKind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                      YAML::EmitterStyle::value style) {
    YamlEvent& event = add(kind, mark, anchor);
    event.is_flow = style == YAML::EmitterStyle::Flow;
    if (tag.size() > 1) {
      event.text = event.tag = size();
      events_.texts += tag;
      event.tag_end = size();
    }
  }

  const std::string& text_;
  YamlEvents& events_;
};

// The place of the innermost '[' or '{' that is still open.
std::optional<std::size_t> open_bracket(const YamlEvents& events) {
  std::size_t closed = 0;
  for (auto event = events.list.rbegin(); event != events.list.rend(); ++event) {
    if (event->kind == EventKind::kEnd) {
      ++closed;
    } else if (event->kind == EventKind::kSequence || event->kind == EventKind::kMapping) {
      if (closed == 0) {
        return event->is_flow ? std::optional<std::size_t>(event->at) : std::nullopt;
      }
      --closed;
    }
  }
  return std::nullopt;
}

// The place of a tab in the indentation of the line at `at`, or of the line before. Such a tab is the usual cause of an
// error at `at`.
std::optional<std::size_t> find_indenting_tab(std::string_view text, std::size_t at) {
  for (int lines = 0; lines < 2; ++lines) {
    const std::size_t line_begin = at == 0 ? 0 : text.rfind('\n', at - 1) + 1;
    const std::size_t content = std::min(text.find_first_not_of(" \t", line_begin), text.size());
    const std::size_t tab = text.find('\t', line_begin);
    if (tab < content) {
      return tab;
    }
    if (line_begin == 0) {
      break;
    }
    at = line_begin - 1;
  }
  return std::nullopt;
}

// The line above `line_begin`, if it should be an entry of a mapping and its ':' is missing. The parser then takes this
// line and the next one for one text, and reports the ':' of the next line.
std::optional<SourceRange> find_line_without_colon(const LocatedText& source, std::size_t line_begin) {
  const std::string_view text = source.text();
  // The next line above `end` that is not blank. Its content is [first, last). List dashes count as indentation.
  struct Line {
    std::size_t begin, first, last;
  };
  const auto line_above = [&](std::size_t end) -> std::optional<Line> {
    const std::size_t last = end == 0 ? std::string_view::npos : text.find_last_not_of(" \r\n", end - 1);
    if (last == std::string_view::npos) {
      return std::nullopt;
    }
    const std::size_t begin = text.rfind('\n', last) + 1;
    return Line{begin, text.find_first_not_of(" -", begin), last + 1};
  };
  const auto has_colon = [&](const Line& line) {
    const std::string_view content = text.substr(line.begin, line.last - line.begin);
    return content.find(": ") != std::string_view::npos || content.ends_with(':');
  };
  const std::optional<Line> line = line_above(line_begin);
  if (!line || has_colon(*line) || line->first >= line->last) {
    return std::nullopt;
  }
  const std::optional<Line> above = line_above(line->begin);
  // A line that is indented deeper than a line with a value is the second line of that value.
  const bool continues = above && has_colon(*above) && text[above->last - 1] != ':' &&
                         line->first - line->begin > above->first - above->begin;
  return continues ? std::nullopt : std::optional(source.range(line->first, line->last - line->first));
}

// The error at byte `at`, in terms of launch files. yaml-cpp tells only which rule was broken.
Diagnostic explain_rule(const std::string& rule, std::size_t at, const LocatedText& source,
                        const std::optional<std::size_t>& open_bracket) {
  using namespace YAML::ErrorMsg;
  const std::string_view text = source.text();
  const std::size_t line_begin = at == 0 ? 0 : text.rfind('\n', at - 1) + 1;
  const std::string_view before = text.substr(line_begin, at - line_begin);
  const bool starts_line = before.find_first_not_of(" -") == std::string_view::npos;
  const auto diagnostic = [&](std::string message, std::string help = {}) {
    return Diagnostic{Severity::kError, std::move(message), source.range(at, 1), std::move(help)};
  };

  if (open_bracket && (rule == END_OF_MAP_FLOW || rule == END_OF_SEQ_FLOW || rule == FLOW_END)) {
    const char opening = text[*open_bracket];
    const char closing = opening == '{' ? '}' : ']';
    if (line_begin <= *open_bracket) {
      return diagnostic(fmt::format("expected ',' or '{}'", closing));
    }
    return {Severity::kError, fmt::format("the '{}' is not closed", opening), source.range(*open_bracket, 1),
            fmt::format("add '{}' at its end", closing)};
  }
  if (rule == FLOW_END) {
    return diagnostic("a closing bracket without an opening one");
  }
  if (rule == MAP_VALUE) {
    if (const std::optional<SourceRange> line = find_line_without_colon(source, line_begin)) {
      return {Severity::kError, "expected 'KEY: VALUE'", *line, "a ':' with a space after it is missing"};
    }
    if (before.find(": ") != std::string_view::npos) {
      return diagnostic("': ' inside a text without quotes", "quote the text");
    }
    return diagnostic("a mapping can't start here", "align the key with its neighbours");
  }
  if (rule == END_OF_MAP || rule == END_OF_SEQ) {
    if (!starts_line) {
      return diagnostic("unexpected text after a value", "quote the whole value");
    }
    return diagnostic("the indentation of this line fits none of the lines above", "align it with its neighbours");
  }
  if (rule == MAP_KEY || rule == BLOCK_ENTRY) {
    return diagnostic(rule == MAP_KEY ? "a mapping key can't stand here" : "a list item can't start here",
                      "align it with its neighbours");
  }
  if (rule == UNKNOWN_TOKEN) {
    return diagnostic(fmt::format("a text can't start with '{}'", text.substr(at, 1)), "quote the text");
  }
  if (rule.starts_with(UNKNOWN_ANCHOR)) {  // yaml-cpp 0.8 adds its name
    return diagnostic("the alias refers to no anchor that stands before it", "define it with &NAME");
  }
  return diagnostic(fmt::format("invalid YAML: {}", rule));
}

// Explains the error of a text that can't be parsed, in terms of launch files. `rule` is the message of yaml-cpp
// (YAML::ErrorMsg). `at` is its place, a byte of `source`. `open_bracket` is the place of the innermost '[' or '{' that
// is still open at `at`.
Diagnostic explain_error(const std::string& rule, std::size_t at, const LocatedText& source,
                         const std::optional<std::size_t>& open_bracket) {
  const std::string& text = source.text();
  if (const std::optional<std::size_t> tab = find_indenting_tab(text, at)) {
    return {Severity::kError, "a tab can't indent YAML", source.range(*tab, 1), "indent with spaces"};
  }
  // An error at the end of the text is shown behind its last character.
  while (at == text.size() && at > 0 && (text[at - 1] == '\n' || text[at - 1] == '\r')) {
    --at;
  }
  return explain_rule(rule, at, source, open_bracket);
}

}  // namespace

YamlStream read_yaml_events(const LocatedText& source) {
  YamlStream result;
  TextBuffer buffer(source.text());
  std::istream stream(&buffer);
  try {
    YAML::Parser parser(stream);
    Recorder recorder(source.text(), result.document);
    if (parser.HandleNextDocument(recorder)) {
      Recorder second(source.text(), result.second_document);
      parser.HandleNextDocument(second);
    }
  } catch (const YAML::ParserException& error) {
    result.error = explain_error(error.msg, place_of(error.mark, source.text()), source, open_bracket(result.document));
  }
  return result;
}

}  // namespace launch
