// SPDX-License-Identifier: Apache-2.0
// Takes a managed node through its life: configure, activate, deactivate, cleanup, shutdown.
//
// Parameters: node       name of the managed node (default lc_talker)
//             period_ms  how long the node stays in each state (default 1000)
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <string>

#include "lifecycle_msgs/msg/transition.hpp"
#include "lifecycle_msgs/srv/change_state.hpp"
#include "lifecycle_msgs/srv/get_state.hpp"
#include "rclcpp/rclcpp.hpp"

using lifecycle_msgs::msg::Transition;
using lifecycle_msgs::srv::ChangeState;
using lifecycle_msgs::srv::GetState;

class ServiceClient : public rclcpp::Node {
 public:
  ServiceClient() : Node("lc_client") {
    const std::string node = declare_parameter("node", "lc_talker");
    period_ = std::chrono::milliseconds(declare_parameter("period_ms", 1000));
    get_state_ = create_client<GetState>(node + "/get_state");
    change_state_ = create_client<ChangeState>(node + "/change_state");
  }

  std::chrono::milliseconds period() const { return period_; }

  // Returns false if the program was interrupted before the answer came.
  bool print_state() {
    const auto response = ask<GetState>(*get_state_, std::make_shared<GetState::Request>());
    if (response) {
      RCLCPP_INFO(get_logger(), "Node %s has current state %s.", get_state_->get_service_name(),
                  response->current_state.label.c_str());
    }
    return response != nullptr;
  }

  // Returns false if the transition failed or the program was interrupted.
  bool change_state(uint8_t transition) {
    auto request = std::make_shared<ChangeState::Request>();
    request->transition.id = transition;
    const auto response = ask<ChangeState>(*change_state_, request);
    if (response && !response->success) {
      RCLCPP_WARN(get_logger(), "Failed to trigger transition %u", unsigned{transition});
    }
    return response && response->success;
  }

 private:
  template <typename ServiceT>
  std::shared_ptr<typename ServiceT::Response> ask(rclcpp::Client<ServiceT>& client,
                                                   std::shared_ptr<typename ServiceT::Request> request) {
    while (!client.wait_for_service(std::chrono::seconds(1))) {
      if (!rclcpp::ok()) {
        return nullptr;
      }
      RCLCPP_INFO(get_logger(), "waiting for service %s", client.get_service_name());
    }
    auto future = client.async_send_request(std::move(request));
    if (rclcpp::spin_until_future_complete(shared_from_this(), future) != rclcpp::FutureReturnCode::SUCCESS) {
      return nullptr;
    }
    return future.get();
  }

  std::chrono::milliseconds period_;
  rclcpp::Client<GetState>::SharedPtr get_state_;
  rclcpp::Client<ChangeState>::SharedPtr change_state_;
};

bool lead(ServiceClient& client) {
  if (!client.print_state()) {
    return false;
  }
  for (const uint8_t transition :
       {Transition::TRANSITION_CONFIGURE, Transition::TRANSITION_ACTIVATE, Transition::TRANSITION_DEACTIVATE,
        Transition::TRANSITION_ACTIVATE, Transition::TRANSITION_DEACTIVATE, Transition::TRANSITION_CLEANUP,
        Transition::TRANSITION_UNCONFIGURED_SHUTDOWN}) {
    if (!rclcpp::sleep_for(client.period()) || !client.change_state(transition) || !client.print_state()) {
      return false;
    }
  }
  return true;
}

int main(int argc, char** argv) {
  try {
    rclcpp::init(argc, argv);
    const bool done = lead(*std::make_shared<ServiceClient>());
    rclcpp::shutdown();
    return done ? EXIT_SUCCESS : EXIT_FAILURE;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "lifecycle_service_client: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
