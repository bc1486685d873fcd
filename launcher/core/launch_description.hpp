// A loaded launch file: its actions, made and checked, nothing visited yet.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "launcher/core/action.hpp"
#include "launcher/core/registry.hpp"

namespace launch {

struct LaunchDescription {
  std::shared_ptr<const SourceFile> file;  // null for several files together
  std::vector<ActionPtr> actions;
  std::string deprecated;  // the text of the root's `deprecated`, empty when there is none
};

// Reads and parses a launch file. `included_from` is the place of the include that asks for it. Throws LaunchError with
// every error of the file.
std::shared_ptr<const LaunchDescription> load_launch_description(const std::string& path, const Registry& registry,
                                                                 SourceRange included_from = {});

// The same for text that is already read.
std::shared_ptr<const LaunchDescription> parse_launch_description(std::shared_ptr<const SourceFile> file,
                                                                  const Registry& registry);

// One description that visits several, one after another in one scope.
std::shared_ptr<const LaunchDescription> join_launch_descriptions(
    std::vector<std::shared_ptr<const LaunchDescription>> descriptions);

}  // namespace launch
