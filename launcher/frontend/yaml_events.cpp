// SPDX-License-Identifier: Apache-2.0
#include "launcher/frontend/yaml_events.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <istream>
#include <streambuf>

#include "launcher/frontend/input_text.hpp"
#include "launcher/frontend/yaml_syntax_error.hpp"

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
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value style) override {
    add(EventKind::kSequence, mark, anchor).is_flow = style == YAML::EmitterStyle::Flow;
  }
  void OnSequenceEnd() override { events_.list.push_back({EventKind::kEnd}); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value style) override {
    add(EventKind::kMapping, mark, anchor).is_flow = style == YAML::EmitterStyle::Flow;
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
    result.error =
        explain_yaml_error(error.msg, place_of(error.mark, source.text()), source, open_bracket(result.document));
  }
  return result;
}

}  // namespace launch
