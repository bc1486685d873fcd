// SPDX-License-Identifier: Apache-2.0
// Waits until the graph shows something: a node, a publisher, a service; or for the first message on a topic of any
// type, which is what the graph says.
#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "programs/rclcpp_versions/rclcpp_versions.hpp"
#include "programs/ros_client/opaque_subscription.hpp"
#include "programs/ros_client/operation.hpp"

namespace launch {

namespace {

class GraphCondition final : public Operation {
 public:
  GraphCondition(const RosRequest& request, Answer answer, std::function<bool()> holds)
      : Operation(std::move(answer)), request_(request), holds_(std::move(holds)) {}

  void look() override {
    if (holds_()) {
      RosAnswer answer;
      answer.ok = true;
      end(answer);
    }
  }
  std::string waits_for() const override { return describe(request_); }

 private:
  const RosRequest request_;
  std::function<bool()> holds_;
};

}  // namespace

std::unique_ptr<Operation> wait_for(const NodePresent& request, rclcpp::Node& node, Operation::Answer answer) {
  return std::make_unique<GraphCondition>(request, std::move(answer), [&node, name = request.node] {
    const std::vector<std::string> names = node.get_node_names();
    return std::find(names.begin(), names.end(), name) != names.end();
  });
}

std::unique_ptr<Operation> wait_for(const TopicPresent& request, rclcpp::Node& node, Operation::Answer answer) {
  return std::make_unique<GraphCondition>(request, std::move(answer),
                                          [&node, name = request.topic] { return node.count_publishers(name) != 0; });
}

std::unique_ptr<Operation> wait_for(const ServicePresent& request, rclcpp::Node& node, Operation::Answer answer) {
  return std::make_unique<GraphCondition>(request, std::move(answer), [&node, name = request.service] {
    return rclcpp_versions::count_services(node, name) != 0;
  });
}

namespace {

class FirstMessage final : public Operation {
 public:
  FirstMessage(const MessagePublished& request, rclcpp::Node& node, Answer answer)
      : Operation(std::move(answer)), request_(request), node_(node) {}

  void look() override {
    if (subscriptions_.empty()) {
      subscribe();
    }
    for (const auto& subscription : subscriptions_) {
      if (subscription->take()) {
        RosAnswer answer;
        answer.ok = true;
        end(answer);
        return;
      }
    }
  }
  void add_to(WakeUps& wake_ups) const override {
    for (const auto& subscription : subscriptions_) {
      wake_ups.subscriptions.push_back(subscription->handle());
    }
  }
  std::string waits_for() const override { return describe(request_); }

 private:
  // Makes one subscription whose quality of service fits every publisher, and one for messages that publishers keep for
  // late subscribers.
  void subscribe() {
    const auto topics = node_.get_topic_names_and_types();
    const auto found = topics.find(request_.topic);
    if (found == topics.end() || found->second.empty() || node_.count_publishers(request_.topic) == 0) {
      return;
    }
    for (const rclcpp::QoS& qos : {rclcpp::QoS(1).best_effort(), rclcpp::QoS(1).reliable().transient_local()}) {
      subscriptions_.push_back(std::make_unique<OpaqueSubscription>(node_, request_.topic, found->second.front(), qos));
    }
  }

  const MessagePublished request_;
  rclcpp::Node& node_;
  std::vector<std::unique_ptr<OpaqueSubscription>> subscriptions_;
};

}  // namespace

std::unique_ptr<Operation> wait_for(const MessagePublished& request, rclcpp::Node& node, Operation::Answer answer) {
  return std::make_unique<FirstMessage>(request, node, std::move(answer));
}

}  // namespace launch
