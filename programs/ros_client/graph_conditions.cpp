// SPDX-License-Identifier: Apache-2.0
// Waits until the graph shows something: a node, a publisher, a service.
#include <algorithm>
#include <functional>
#include <string>
#include <utility>

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
  return std::make_unique<GraphCondition>(request, std::move(answer),
                                          [&node, name = request.service] { return node.count_services(name) != 0; });
}

}  // namespace launch
