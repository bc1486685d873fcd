// SPDX-License-Identifier: Apache-2.0
// The <composable_node> items of <node_container> and <load_composable_node>.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "actions/ros/parameters.hpp"
#include "launcher/language/fields.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

class ComposableNodes {
 public:
  // The items composable_node and composable_lifecycle_node.
  static std::vector<ItemSpec> items();

  explicit ComposableNodes(const Fields& fields);

  bool empty() const { return nodes_.empty(); }
  // Asks that the nodes whose conditions hold are loaded into the container `target`. `environment` is the environment
  // of the container, as far as it is known.
  void request(LaunchContext& context, const std::string& target, const Environment& environment,
               const SourceRange& where) const;

 private:
  struct Description {
    Fields fields;
    std::vector<Parameters> parameters;
  };
  static ComposableNode evaluate(const Description& node, const Environment& environment, LaunchContext& context);

  std::vector<Description> nodes_;
};

}  // namespace launch
