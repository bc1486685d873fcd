// SPDX-License-Identifier: Apache-2.0
#include "launcher/language/launch_description.hpp"

#include <filesystem>

#include "launcher/frontend/frontend.hpp"
#include "launcher/language/action_parser.hpp"
#include "launcher/python/python_launch_file.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

namespace {

// One of several launch files that were given together.
class WholeFile : public Action {
 public:
  explicit WholeFile(std::shared_ptr<const LaunchDescription> description)
      : Action({description->file, 0, 0}, Condition()), description_(std::move(description)) {}

  Introspection introspect() const override { return {.description = &description_}; }

 protected:
  void execute(LaunchContext& context) const override { context.visit(*description_); }

 private:
  std::shared_ptr<const LaunchDescription> description_;
};

}  // namespace

std::shared_ptr<const LaunchDescription> load_launch_description(const std::string& path, const Registry& registry,
                                                                 const Scope& scope, SourceRange included_from) {
  if (path.empty()) {
    throw LaunchError("the path of the launch file is empty", included_from);
  }
  const std::string absolute = std::filesystem::absolute(path).lexically_normal().string();
  return parse_launch_description(SourceFile::read(absolute, std::move(included_from)), registry, scope);
}

std::shared_ptr<const LaunchDescription> parse_launch_description(std::shared_ptr<const SourceFile> file,
                                                                  const Registry& registry, const Scope& scope) {
  if (file->path().ends_with(".py")) {
    return load_python_launch_file(std::move(file), registry, scope);
  }
  Entity root = load_entity_tree(file);
  auto description = std::make_shared<LaunchDescription>();
  if (const Attribute* const deprecated = root.find("deprecated");
      deprecated != nullptr && deprecated->value.scalar() != nullptr) {
    description->deprecated = deprecated->value.scalar()->text.text();
  }
  description->actions = ActionParser(registry).parse(std::move(root.children));
  description->file = std::move(file);
  return description;
}

std::shared_ptr<const LaunchDescription> join_launch_descriptions(
    std::vector<std::shared_ptr<const LaunchDescription>> descriptions) {
  auto joined = std::make_shared<LaunchDescription>();
  for (auto& description : descriptions) {
    joined->actions.push_back(std::make_shared<WholeFile>(std::move(description)));
  }
  return joined;
}

}  // namespace launch
