// SPDX-License-Identifier: Apache-2.0
// Computes Fibonacci sequences for clients of action fibonacci, one number at a time, for several goals at once.
//
// Parameter: period_ms  time between two numbers (default 1000)
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <list>
#include <memory>

#include "example_interfaces/action/fibonacci.hpp"
#include "rclcpp/rclcpp.hpp"
#include "rclcpp_action/rclcpp_action.hpp"

using Fibonacci = example_interfaces::action::Fibonacci;
using Goal = rclcpp_action::ServerGoalHandle<Fibonacci>;

class FibonacciActionServer : public rclcpp::Node {
 public:
  FibonacciActionServer() : Node("fibonacci_action_server") {
    server_ = rclcpp_action::create_server<Fibonacci>(
        this, "fibonacci",
        [this](const rclcpp_action::GoalUUID&, std::shared_ptr<const Fibonacci::Goal> goal) {
          RCLCPP_INFO(get_logger(), "Received goal request with order %d", static_cast<int>(goal->order));
          // The 47th number is the last one that fits.
          const bool is_possible = goal->order > 0 && goal->order <= 46;
          return is_possible ? rclcpp_action::GoalResponse::ACCEPT_AND_EXECUTE : rclcpp_action::GoalResponse::REJECT;
        },
        [this](const std::shared_ptr<Goal>&) {
          RCLCPP_INFO(get_logger(), "Received request to cancel goal");
          return rclcpp_action::CancelResponse::ACCEPT;
        },
        [this](const std::shared_ptr<Goal>& goal) {
          computations_.push_back({goal, {0, 1}});
        });
    timer_ = create_wall_timer(std::chrono::milliseconds(declare_parameter("period_ms", 1000)), [this] { step(); });
  }

 private:
  struct Computation {
    std::shared_ptr<Goal> goal;
    std::vector<int32_t> sequence;
  };

  void step() {
    computations_.remove_if([this](Computation& computation) { return is_ended(computation); });
  }

  // Computes the next number. Returns whether the goal has ended.
  bool is_ended(Computation& computation) {
    auto& [goal, sequence] = computation;
    const auto order = static_cast<std::size_t>(goal->get_goal()->order);
    const bool is_canceled = goal->is_canceling();
    if (is_canceled || sequence.size() > order) {
      auto result = std::make_shared<Fibonacci::Result>();
      result->sequence = sequence;
      is_canceled ? goal->canceled(result) : goal->succeed(result);
      RCLCPP_INFO(get_logger(), is_canceled ? "Goal canceled" : "Goal succeeded");
      return true;
    }
    sequence.push_back(sequence[sequence.size() - 1] + sequence[sequence.size() - 2]);
    auto feedback = std::make_shared<Fibonacci::Feedback>();
    feedback->sequence = sequence;
    goal->publish_feedback(feedback);
    return false;
  }

  std::list<Computation> computations_;
  rclcpp_action::Server<Fibonacci>::SharedPtr server_;
  rclcpp::TimerBase::SharedPtr timer_;
};

int main(int argc, char** argv) {
  try {
    rclcpp::init(argc, argv);
    rclcpp::spin(std::make_shared<FibonacciActionServer>());
    rclcpp::shutdown();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "fibonacci_action_server: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
