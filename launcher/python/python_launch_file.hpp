// SPDX-License-Identifier: Apache-2.0
// Python launch files. The launcher's CPython (launcher/python/) runs them; they give the same actions as XML and YAML.
#pragma once

#include <memory>

#include "launcher/language/launch_description.hpp"
#include "launcher/language/registry.hpp"
#include "launcher/substitution/foreign_substitutions.hpp"
#include "launcher/substitution/scope.hpp"

namespace launch {

// Runs the file's generate_launch_description() and makes the actions of what it returns. `scope` gives the environment
// and the packages that the file sees. Changes that the file makes to its environment take effect when the description
// is visited. A file runs once for each include that asks for it in the same environment, however often the description
// is looked at. Throws LaunchError at the place in the Python file.
std::shared_ptr<const LaunchDescription> load_python_launch_file(std::shared_ptr<const SourceFile> file,
                                                                 const Registry& registry, const Scope& scope);

// Actions and substitutions that Python packages offer to XML and YAML files: expose_action() and expose_substitution()
// of launch.frontend. Python is started by the first name that the launcher does not know itself.
ForeignActions exposed_actions();

ForeignSubstitutions exposed_substitutions();

}  // namespace launch
