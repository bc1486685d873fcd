// SPDX-License-Identifier: Apache-2.0
// An entity that is activated and deactivated with its node.
#pragma once

#include <atomic>

namespace rclcpp_lifecycle {

// LifecycleNode::on_activate() and on_deactivate() call these functions for every entity that was added to the node.
class ManagedEntityInterface {
 public:
  virtual ~ManagedEntityInterface() = default;
  virtual void on_activate() = 0;
  virtual void on_deactivate() = 0;
};

// A managed entity that only knows whether it is active. It starts inactive.
class SimpleManagedEntity : public ManagedEntityInterface {
 public:
  void on_activate() override { activated_ = true; }
  void on_deactivate() override { activated_ = false; }
  bool is_activated() const { return activated_; }

 private:
  std::atomic_bool activated_{false};
};

}  // namespace rclcpp_lifecycle
