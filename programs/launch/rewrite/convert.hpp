// SPDX-License-Identifier: Apache-2.0
// A launch file in another of the three languages.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/frontend/entity.hpp"
#include "launcher/language/registry.hpp"
#include "programs/launch/rewrite/comments.hpp"

namespace launch {

struct Converted {
  std::string text;
  std::vector<Diagnostic> errors;  // what has no like in the other language, at its place
};

// The trees are those of XML or YAML files. Comments stay; those behind an element go before it.
Converted convert_to_xml(const Entity& root, Comments comments, const Registry& registry);
Converted convert_to_yaml(const Entity& root, Comments comments, const Registry& registry);
Converted convert_to_python(const Entity& root, Comments comments, const Registry& registry);

}  // namespace launch
