// SPDX-License-Identifier: Apache-2.0
// Joins several launch files that are given together.
#pragma once

#include <memory>
#include <vector>

#include "launcher/language/launch_description.hpp"

namespace launch {

// A description that visits the given ones, one after another in one scope.
std::shared_ptr<const LaunchDescription> join_launch_descriptions(
    std::vector<std::shared_ptr<const LaunchDescription>> descriptions);

}  // namespace launch
