// SPDX-License-Identifier: Apache-2.0
// Substitutions that are not among the built-in ones: those of Python packages.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "launcher/substitution/substitution.hpp"

namespace launch {

struct ForeignNames {
  std::vector<std::string> names;
  std::string problem;  // why some may be missing; empty when none is
};

struct ForeignSubstitutions {
  // The substitution of a call; null when nothing knows its name. Throws LaunchError.
  std::function<SubstitutionPtr(const std::string& name, std::vector<Template> arguments, const SourceRange& where)>
      make;
  std::function<ForeignNames()> names;
};

// From now on every template of this program may call them.
void use_foreign_substitutions(ForeignSubstitutions substitutions);
// Without functions when there are none.
const ForeignSubstitutions& foreign_substitutions();

}  // namespace launch
