// SPDX-License-Identifier: Apache-2.0
#include "launcher/substitution/foreign_substitutions.hpp"

#include <utility>

namespace launch {

namespace {

ForeignSubstitutions& known() {
  static ForeignSubstitutions substitutions;
  return substitutions;
}

}  // namespace

void use_foreign_substitutions(ForeignSubstitutions substitutions) {
  known() = std::move(substitutions);
}

const ForeignSubstitutions& foreign_substitutions() {
  return known();
}

}  // namespace launch
