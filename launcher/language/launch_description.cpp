// SPDX-License-Identifier: Apache-2.0
#include "launcher/language/launch_description.hpp"

#include <filesystem>

#include "base/diagnostics/read_source_file.hpp"
#include "launcher/frontend/frontend.hpp"
#include "launcher/language/action_parser.hpp"

namespace launch {

std::shared_ptr<const LaunchDescription> load_launch_description(const std::string& path, const Registry& registry,
                                                                 const Scope& scope, SourceRange included_from) {
  if (path.empty()) {
    throw LaunchError("the path of the launch file is empty", included_from, {}, Finding::kUnreadableFile);
  }
  const std::string absolute = std::filesystem::absolute(path).lexically_normal().string();
  return parse_launch_description(read_source_file(absolute, std::move(included_from)), registry, scope);
}

std::shared_ptr<const LaunchDescription> parse_launch_description(std::shared_ptr<const SourceFile> file,
                                                                  const Registry& registry, const Scope& scope) {
  if (const LaunchFileLoader* const loader = registry.find_loader(file->path())) {
    try {
      return (*loader)(std::move(file), registry, scope);
    } catch (LaunchError& error) {
      error.classify(Finding::kPython);
      throw;
    }
  }
  Entity root = load_entity_tree(file);
  auto description = std::make_shared<LaunchDescription>();
  if (const Attribute* const deprecated = root.find("deprecated");
      deprecated != nullptr && deprecated->value.scalar() != nullptr) {
    description->deprecated = deprecated->value.scalar()->text.text();
  }
  try {
    description->actions = ActionParser(registry).parse(std::move(root.children));
  } catch (LaunchError& error) {
    error.classify(Finding::kWrongValue);
    throw;
  }
  description->file = std::move(file);
  return description;
}

}  // namespace launch
