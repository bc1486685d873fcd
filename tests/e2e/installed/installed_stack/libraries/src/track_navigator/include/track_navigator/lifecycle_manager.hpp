// SPDX-License-Identifier: Apache-2.0
// Brings nodes up one after the other, and down again when the bond to one of them breaks.
#pragma once

#include <lifecycle_msgs/srv/change_state.hpp>
#include <lifecycle_msgs/srv/get_state.hpp>
#include <map>
#include <memory>
#include <std_srvs/srv/trigger.hpp>
#include <string>
#include <vector>

#include "track_bond/bond.hpp"

namespace track_navigator {

// A client that spins an executor of its own for an answer.
template <class ServiceT>
class ServiceClient {
 public:
  ServiceClient(const std::string& name, const rclcpp::Node::SharedPtr& node) {
    group_ = node->create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive, false);
    executor_.add_callback_group(group_, node->get_node_base_interface());
    client_ = node->create_client<ServiceT>(name, rclcpp::SystemDefaultsQoS(), group_);
  }
  typename ServiceT::Response::SharedPtr invoke(typename ServiceT::Request::SharedPtr request) {
    while (!client_->wait_for_service(std::chrono::seconds(1))) {
      if (!rclcpp::ok()) {
        throw std::runtime_error(std::string(client_->get_service_name()) + ": interrupted");
      }
    }
    auto answer = client_->async_send_request(request);
    if (executor_.spin_until_future_complete(answer) != rclcpp::FutureReturnCode::SUCCESS) {
      client_->remove_pending_request(answer);
      throw std::runtime_error(std::string(client_->get_service_name()) + ": no answer");
    }
    return answer.get();
  }

 private:
  rclcpp::CallbackGroup::SharedPtr group_;
  rclcpp::executors::SingleThreadedExecutor executor_;
  typename rclcpp::Client<ServiceT>::SharedPtr client_;
};

class LifecycleManager : public rclcpp::Node {
 public:
  explicit LifecycleManager(const rclcpp::NodeOptions& options = rclcpp::NodeOptions());

  bool startup();
  bool shutdown();
  unsigned char state_of(const std::string& node);

 private:
  bool change(const std::string& node, unsigned char transition);

  std::vector<std::string> node_names_;
  std::map<std::string, std::unique_ptr<ServiceClient<lifecycle_msgs::srv::ChangeState>>> change_;
  std::map<std::string, std::unique_ptr<ServiceClient<lifecycle_msgs::srv::GetState>>> get_;
  std::map<std::string, std::shared_ptr<track_bond::Bond>> bonds_;
  rclcpp::Service<std_srvs::srv::Trigger>::SharedPtr is_active_;
  bool is_up_ = false;
};

}  // namespace track_navigator
