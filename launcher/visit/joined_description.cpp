// SPDX-License-Identifier: Apache-2.0
#include "launcher/visit/joined_description.hpp"

#include <utility>

#include "launcher/visit/launch_context.hpp"

namespace launch {

namespace {

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

std::shared_ptr<const LaunchDescription> join_launch_descriptions(
    std::vector<std::shared_ptr<const LaunchDescription>> descriptions) {
  auto joined = std::make_shared<LaunchDescription>();
  for (auto& description : descriptions) {
    joined->actions.push_back(std::make_shared<WholeFile>(std::move(description)));
  }
  return joined;
}

}  // namespace launch
