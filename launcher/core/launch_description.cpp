#include "launcher/core/launch_description.hpp"

#include <filesystem>

#include "launcher/core/action_parser.hpp"
#include "launcher/core/python_launch_file.hpp"
#include "launcher/frontend/frontend.hpp"

namespace launch {

std::shared_ptr<const LaunchDescription> load_launch_description(const std::string& path, const Registry& registry,
                                                                 const Scope& scope, SourceRange included_from) {
  const std::string absolute = std::filesystem::absolute(path).lexically_normal().string();
  return parse_launch_description(SourceFile::read(absolute, std::move(included_from)), registry, scope);
}

std::shared_ptr<const LaunchDescription> parse_launch_description(std::shared_ptr<const SourceFile> file,
                                                                  const Registry& registry, const Scope& scope) {
  if (file->path().ends_with(".py")) {
    return load_python_launch_file(std::move(file), registry, scope);
  }
  const Entity root = load_entity_tree(file);
  auto description = std::make_shared<LaunchDescription>();
  if (const Attribute* const deprecated = root.find("deprecated");
      deprecated != nullptr && deprecated->value.scalar() != nullptr) {
    description->deprecated = deprecated->value.scalar()->text.text();
  }
  description->actions = ActionParser(registry).parse(root.children);
  description->file = std::move(file);
  return description;
}

}  // namespace launch
