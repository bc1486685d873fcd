// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/rewrite/yaml_block_tokens.hpp"

#include <algorithm>
#include <string_view>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/frontend/yaml_events.hpp"
#include "launcher/frontend/yaml_scalar_place.hpp"

namespace launch {

namespace {

using EventKind = YamlEvent::Kind;

constexpr std::size_t kYamlStep = 2;

class BlockWalk {
 public:
  explicit BlockWalk(const std::shared_ptr<const SourceFile>& file)
      : source_(file->text(), {file, 0, static_cast<std::uint32_t>(file->text().size())}),
        text_(source_.text()),
        events_(read_yaml_events(source_).document) {}

  YamlBlocks walk() {
    if (!events_.list.empty()) {
      node(0, 0);
    }
    return std::move(blocks_);
  }

 private:
  [[noreturn]] void unknown(std::size_t at, const char* help) const {
    throw LaunchError("this form is not formatted", source_.range(at, 1), help);
  }

  // `column` is that of a mapping, `list_column` that of a list.
  void node(std::size_t column, std::size_t list_column) {
    const YamlEvent& event = events_.list[next_++];
    switch (event.kind) {
      case EventKind::kScalar:
        scalar(event);
        return;
      case EventKind::kSequence:
      case EventKind::kMapping:
        if (event.is_flow) {
          flow(event);
        } else if (event.kind == EventKind::kMapping) {
          mapping(column);
        } else {
          sequence(list_column);
        }
        return;
      default:
        return;
    }
  }

  std::size_t scalar(const YamlEvent& event) {
    const std::size_t end = locate_yaml_scalar(source_, event.at, events_.text(event)).end;
    if (text_.substr(event.at, end - event.at).find('\n') != std::string_view::npos) {
      blocks_.scalars.push_back({event.at, end});
    }
    return end;
  }

  void flow(const YamlEvent& event) {
    std::size_t depth = 0;
    do {
      const EventKind kind = events_.list[next_ - 1].kind;
      depth += kind == EventKind::kSequence || kind == EventKind::kMapping ? 1 : 0;
      depth -= kind == EventKind::kEnd ? 1 : 0;
      next_ += depth == 0 ? 0 : 1;
    } while (depth != 0);
    blocks_.flows.push_back({event.at, end_of_flow(event.at)});
  }

  std::size_t end_of_flow(std::size_t at) const {
    std::size_t depth = 0;
    at = text_.find_first_of("[{", at);  // behind a tag or an anchor
    for (; at < text_.size(); ++at) {
      const char c = text_[at];
      const char before = at == 0 ? ' ' : text_[at - 1];
      if (c == '[' || c == '{') {
        ++depth;
      } else if (c == ']' || c == '}') {
        if (--depth == 0) {
          return at + 1;
        }
      } else if (begins_quoted(text_, at)) {
        at = end_of_quoted(at) - 1;
      } else if (c == '#' && (before == ' ' || before == '\t' || before == '\n')) {
        at = std::min(text_.find('\n', at), text_.size());
      }
    }
    return text_.size();
  }

  std::size_t end_of_quoted(std::size_t at) const {
    const char quote = text_[at];
    for (++at; at < text_.size() && text_[at] != quote; ++at) {
      at += text_[at] == '\\' && quote == '"' ? 1 : 0;
    }
    return std::min(at + 1, text_.size());
  }

  bool at_end() const { return next_ >= events_.list.size() || events_.list[next_].kind == EventKind::kEnd; }

  void mapping(std::size_t column) {
    while (!at_end()) {
      const YamlEvent& key = events_.list[next_++];
      if (key.kind != EventKind::kScalar) {
        unknown(key.at, "write a text as key");
      }
      const std::size_t end = scalar(key);
      const std::size_t colon = text_.find_first_not_of(" \t", end);
      if (colon == std::string_view::npos || text_[colon] != ':') {
        unknown(key.at, "write KEY: VALUE");
      }
      blocks_.tokens.push_back({YamlBlockToken::Kind::kKey, key.at, colon + 1, column});
      if (!at_end()) {
        node(column + kYamlStep, column);
      }
    }
    ++next_;
  }

  void sequence(std::size_t column) {
    while (!at_end()) {
      const std::size_t at = events_.list[next_].at;
      const std::size_t dash = at == 0 ? std::string_view::npos : text_.find_last_not_of(" \t", at - 1);
      if (dash == std::string_view::npos || text_[dash] != '-') {
        unknown(at, "write the item behind its dash");
      }
      blocks_.tokens.push_back({YamlBlockToken::Kind::kDash, dash, dash + 1, column});
      node(column + kYamlStep, column + kYamlStep);
    }
    ++next_;
  }

  LocatedText source_;
  std::string_view text_;
  YamlEvents events_;
  std::size_t next_ = 0;
  YamlBlocks blocks_;
};

}  // namespace

bool begins_quoted(std::string_view text, std::size_t at) {
  if (text[at] != '"' && text[at] != '\'') {
    return false;
  }
  const char before = at == 0 ? ' ' : text[at - 1];
  const bool behind_quoted_key = before == ':' && at > 1 && (text[at - 2] == '"' || text[at - 2] == '\'');
  return behind_quoted_key || std::string_view(" \t\n,[{").find(before) != std::string_view::npos;
}

YamlBlocks yaml_blocks(const std::shared_ptr<const SourceFile>& file) {
  return BlockWalk(file).walk();
}

}  // namespace launch
