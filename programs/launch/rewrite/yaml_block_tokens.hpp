// SPDX-License-Identifier: Apache-2.0
// Where the block style of a YAML text has its keys and dashes, and in which column each of them belongs.
#pragma once

#include <cstddef>
#include <memory>
#include <string_view>
#include <vector>

#include "base/diagnostics/source.hpp"

namespace launch {

struct YamlBlockToken {
  enum class Kind { kKey, kDash };

  Kind kind = Kind::kKey;
  std::size_t begin = 0;
  std::size_t end = 0;     // behind the colon or the dash
  std::size_t column = 0;  // from 0: where the token belongs
};

// A piece that goes over several lines: a text, or a collection in brackets.
struct YamlSpan {
  std::size_t begin = 0;
  std::size_t end = 0;
};

struct YamlBlocks {
  std::vector<YamlBlockToken> tokens;  // in the order of the text
  std::vector<YamlSpan> flows;         // collections in brackets, the outer ones
  std::vector<YamlSpan> scalars;       // texts over several lines
};

// Whether a quote at this place of a line begins a text; elsewhere it is a character of a plain text.
bool begins_quoted(std::string_view text, std::size_t at);

// The text must be one that parse_yaml() takes. Throws LaunchError at a form that is not known.
YamlBlocks yaml_blocks(const std::shared_ptr<const SourceFile>& file);

}  // namespace launch
