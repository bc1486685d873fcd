// SPDX-License-Identifier: Apache-2.0
// What stands for a Python launch file that may not run.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "launcher/language/launch_description.hpp"
#include "launcher/language/registry.hpp"

namespace launch::lsp {

struct PythonStandIn {
  // The arguments and configurations that the text of the file sets. Values that it does not tell are unknown.
  std::shared_ptr<const LaunchDescription> description;
  // Whether the file may set others: by a function, another file, a computed name, or variables of the environment.
  bool may_set_more = false;
};

// Runs nothing. `share` gives PREFIX/share/PACKAGE; "" if there is none.
PythonStandIn python_stand_in(const std::shared_ptr<const SourceFile>& file, const Registry& registry,
                              const std::function<std::string(const std::string& package)>& share);

}  // namespace launch::lsp
