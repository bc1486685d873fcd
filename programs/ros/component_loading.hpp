// SPDX-License-Identifier: Apache-2.0
// What the commands that load components have in common.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "programs/ros/graph_session.hpp"
#include "programs/ros/verb.hpp"

namespace launch {

// The classes that a package has registered, in the order of the index.
std::vector<std::string> component_types(const std::string& package);
std::vector<std::string> packages_with_components();

// A component, and how it is loaded.
class ComponentOptions {
 public:
  void declare(CLI::App& app);

  struct Loaded {
    std::int64_t id;
    std::string node;  // its full name
  };
  // `container` is a full name. Throws CommandError when the component can't be loaded.
  Loaded load_into(GraphSession& session, const std::string& container) const;

 private:
  std::string package_, plugin_, name_, namespace_, level_;
  std::vector<std::string> remaps_, parameters_, extra_;
};

}  // namespace launch
