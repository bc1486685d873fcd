// SPDX-License-Identifier: Apache-2.0
// What would go wrong only when a container loads a component, as remarks of a visit that explores.
#pragma once

#include "launcher/visit/launch_context.hpp"

namespace launch {

// The package must exist, and one of its libraries must register the plugin.
void find_missing_plugin(const ComposableNode& node, const Environment& environment, const SourceRange& package_where,
                         const SourceRange& plugin_where, LaunchContext& context);

}  // namespace launch
