// SPDX-License-Identifier: Apache-2.0
// A layer of a map of costs. Layers are plugins.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "rclcpp_lifecycle/lifecycle_node.hpp"
#include "track_frames_ros/listener.hpp"

namespace track_navigator {

using Costs = std::vector<unsigned char>;

class Layer {
 public:
  using Ptr = std::shared_ptr<Layer>;
  virtual ~Layer() = default;
  virtual void configure(const rclcpp_lifecycle::LifecycleNode::WeakPtr& parent, const std::string& name,
                         const std::shared_ptr<track_frames_ros::Buffer>& frames) = 0;
  virtual void activate() = 0;
  virtual void deactivate() = 0;
  virtual void cleanup() = 0;
  virtual void update(Costs& costs) = 0;
};

}  // namespace track_navigator
