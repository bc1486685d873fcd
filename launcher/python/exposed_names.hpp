// SPDX-License-Identifier: Apache-2.0
// Actions and substitutions that Python packages offer to XML and YAML files: expose_action() and expose_substitution()
// of launch.frontend. Python is started by the first name that the launcher does not know itself.
#pragma once

#include "launcher/language/registry.hpp"
#include "launcher/substitution/foreign_substitutions.hpp"

namespace launch {

ForeignActions exposed_actions();

ForeignSubstitutions exposed_substitutions();

}  // namespace launch
