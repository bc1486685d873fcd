// SPDX-License-Identifier: Apache-2.0
// The reference page of the launch language, made from the declarations.
#pragma once

#include <string>

#include "launcher/language/registry.hpp"

namespace launch {

// Markdown: every action with its attributes and items, every substitution. docs/launch_reference.md holds it.
std::string reference_page(const Registry& registry);

}  // namespace launch
