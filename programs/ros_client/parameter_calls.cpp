// SPDX-License-Identifier: Apache-2.0
// Sets parameters of a node that runs.
#include <memory>
#include <rcl_interfaces/srv/set_parameters_atomically.hpp>
#include <utility>

#include "programs/ros_client/parameter_messages.hpp"
#include "programs/ros_client/service_call.hpp"

namespace launch {

std::unique_ptr<Operation> call(const SetParameters& request, rclcpp::Node& node, Operation::Answer answer) {
  using rcl_interfaces::srv::SetParametersAtomically;
  auto message = std::make_shared<SetParametersAtomically::Request>();
  message->parameters = messages_of(request.parameters);
  return std::make_unique<CallOperation<SetParametersAtomically>>(
      std::move(answer),
      ServiceCall<SetParametersAtomically>(node, request.node + "/set_parameters_atomically", std::move(message)),
      [](const SetParametersAtomically::Response& response) {
        RosAnswer result;
        result.ok = response.result.successful;
        result.error = response.result.reason;
        return result;
      });
}

}  // namespace launch
