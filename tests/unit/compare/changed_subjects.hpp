// SPDX-License-Identifier: Apache-2.0
// What a comparison names.
#pragma once

#include <string>
#include <vector>

#include "tracing/model/compare/comparison.hpp"

namespace tracing::compare {

// The subjects that have changed, each once, in the order of the comparison.
inline std::vector<std::string> subjects(const Comparison& comparison) {
  std::vector<std::string> names;
  for (const Change& change : comparison.changes) {
    if (names.empty() || names.back() != change.subject) {
      names.push_back(change.subject);
    }
  }
  return names;
}

}  // namespace tracing::compare
