// SPDX-License-Identifier: Apache-2.0
// Finds where each character of a decoded YAML scalar stands in the source.
#pragma once

#include <cstddef>
#include <string_view>

#include "launcher/base/source.hpp"

namespace launch {

struct YamlScalarPlace {
  LocatedText text;     // the decoded text with the place of each of its characters, quotes left out
  std::size_t end = 0;  // byte of the source behind the scalar and its closing quote
  // False when the text ends before the closing quote, which yaml-cpp lets pass.
  bool closed = true;
};

// `decoded` is the value of the scalar that begins (with its tag, anchor, quote or block indicator) at byte `begin` of
// `source`.
YamlScalarPlace locate_yaml_scalar(const LocatedText& source, std::size_t begin, std::string_view decoded);

}  // namespace launch
