// SPDX-License-Identifier: Apache-2.0
// Finds the place in the source of each character of a decoded YAML scalar.
#pragma once

#include <cstddef>
#include <string_view>

#include "base/diagnostics/source.hpp"

namespace launch {

struct YamlScalarPlace {
  LocatedText text;     // the decoded text without quotes, with the place of each of its characters
  std::size_t end = 0;  // byte of the source behind the scalar and its closing quote
  // False if the closing quote is missing. yaml-cpp accepts this.
  bool closed = true;
};

// `decoded` is the value of the scalar. `begin` is the byte of `source` where the scalar begins, with its tag, anchor,
// quote or block indicator.
YamlScalarPlace locate_yaml_scalar(const LocatedText& source, std::size_t begin, std::string_view decoded);

}  // namespace launch
