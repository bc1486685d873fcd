// SPDX-License-Identifier: Apache-2.0
// What is switched on and off with its node.
#pragma once

#include <atomic>

namespace rclcpp_lifecycle {

// LifecycleNode::on_activate() and on_deactivate() call it for every entity that was added to the node.
class ManagedEntityInterface {
 public:
  virtual ~ManagedEntityInterface() = default;
  virtual void on_activate() = 0;
  virtual void on_deactivate() = 0;
};

// One that only knows whether it is on. Off at first.
class SimpleManagedEntity : public ManagedEntityInterface {
 public:
  void on_activate() override;
  void on_deactivate() override;
  bool is_activated() const { return activated_; }

 private:
  std::atomic_bool activated_{false};
};

}  // namespace rclcpp_lifecycle
