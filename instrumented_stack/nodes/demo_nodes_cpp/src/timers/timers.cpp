// SPDX-License-Identifier: Apache-2.0
// A periodic timer starts another one, which runs once. It is created each time, or reused.
#include <chrono>
#include <memory>

#include "rclcpp/rclcpp.hpp"
#include "rclcpp_components/register_node_macro.hpp"

namespace demo_nodes_cpp {

using std::chrono::seconds;

// Calls start_one_off() on every third tick.
class TimersNode : public rclcpp::Node {
 protected:
  TimersNode(const char* name, const rclcpp::NodeOptions& options) : Node(name, options) {
    periodic_timer_ = create_wall_timer(seconds(2), [this] { tick(); });
  }

  virtual void start_one_off() = 0;

  rclcpp::TimerBase::SharedPtr make_one_off() {
    return create_wall_timer(seconds(1), [this](rclcpp::TimerBase& self) {
      RCLCPP_INFO(get_logger(), "in one_off_timer callback");
      self.cancel();
    });
  }

 private:
  void tick() {
    RCLCPP_INFO(get_logger(), "in periodic_timer callback");
    if (count_++ % 3 == 0) {
      RCLCPP_INFO(get_logger(), "  resetting one off timer");
      start_one_off();
    } else {
      RCLCPP_INFO(get_logger(), "  not resetting one off timer");
    }
  }

  size_t count_ = 0;
  rclcpp::TimerBase::SharedPtr periodic_timer_;
};

class OneOffTimerNode : public TimersNode {
 public:
  explicit OneOffTimerNode(const rclcpp::NodeOptions& options) : TimersNode("one_off_timer", options) {}

 private:
  void start_one_off() override { timer_ = make_one_off(); }

  rclcpp::TimerBase::SharedPtr timer_;
};

class ReuseTimerNode : public TimersNode {
 public:
  explicit ReuseTimerNode(const rclcpp::NodeOptions& options) : TimersNode("reuse_timer", options) {
    timer_ = make_one_off();
    timer_->cancel();  // started later
  }

 private:
  void start_one_off() override { timer_->reset(); }

  rclcpp::TimerBase::SharedPtr timer_;
};

}  // namespace demo_nodes_cpp

RCLCPP_COMPONENTS_REGISTER_NODE(demo_nodes_cpp::OneOffTimerNode)
RCLCPP_COMPONENTS_REGISTER_NODE(demo_nodes_cpp::ReuseTimerNode)
