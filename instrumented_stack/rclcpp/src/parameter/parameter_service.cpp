// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/parameter_service.hpp"

#include <algorithm>
#include <rcl_interfaces/srv/describe_parameters.hpp>
#include <rcl_interfaces/srv/get_parameter_types.hpp>
#include <rcl_interfaces/srv/get_parameters.hpp>
#include <rcl_interfaces/srv/list_parameters.hpp>
#include <rcl_interfaces/srv/set_parameters.hpp>
#include <rcl_interfaces/srv/set_parameters_atomically.hpp>
#include <utility>

#include "parameter/parameter_service_names.hpp"
#include "rclcpp/create_service.hpp"
#include "rclcpp/exceptions.hpp"
#include "rclcpp/logging.hpp"
#include "rclcpp/node_interfaces/node_parameters_interface.hpp"

namespace rclcpp {

namespace {

namespace srv = rcl_interfaces::srv;
namespace names = parameter_service_names;

std::vector<Parameter> from_messages(const std::vector<rcl_interfaces::msg::Parameter>& messages) {
  std::vector<Parameter> parameters;
  std::transform(messages.begin(), messages.end(), std::back_inserter(parameters), Parameter::from_parameter_msg);
  return parameters;
}

rcl_interfaces::msg::SetParametersResult set(node_interfaces::NodeParametersInterface& node_parameters,
                                             const std::vector<Parameter>& parameters) {
  try {
    return node_parameters.set_parameters_atomically(parameters);
  } catch (const std::exception& error) {
    rcl_interfaces::msg::SetParametersResult refused;
    refused.reason = error.what();
    return refused;
  }
}

// Runs `answer`. If it throws, the response stays empty.
template <typename AnswerT>
void answer_or_warn(const char* what, AnswerT answer) {
  try {
    answer();
  } catch (const exceptions::ParameterNotDeclaredException& error) {
    RCLCPP_WARN(get_logger("rclcpp"), "Failed to %s parameters: %s", what, error.what());
  } catch (const exceptions::ParameterUninitializedException& error) {
    RCLCPP_WARN(get_logger("rclcpp"), "Failed to %s parameters: %s", what, error.what());
  }
}

// Makes services of one node whose callbacks take references.
class ServiceFactory {
 public:
  ServiceFactory(node_interfaces::NodeBaseInterface::SharedPtr node_base,
                 node_interfaces::NodeServicesInterface::SharedPtr node_services, const QoS& qos)
      : node_base_(std::move(node_base)), node_services_(std::move(node_services)), qos_(qos) {}

  template <typename ServiceT, typename AnswerT>
  ServiceBase::SharedPtr make(const char* name, AnswerT answer) const {
    return create_service<ServiceT>(
        node_base_, node_services_, names::of(node_base_->get_name(), name),
        [answer](std::shared_ptr<typename ServiceT::Request> request,
                 std::shared_ptr<typename ServiceT::Response> response) { answer(*request, *response); },
        qos_, nullptr);
  }

 private:
  node_interfaces::NodeBaseInterface::SharedPtr node_base_;
  node_interfaces::NodeServicesInterface::SharedPtr node_services_;
  QoS qos_;
};

}  // namespace

ParameterService::ParameterService(const node_interfaces::NodeBaseInterface::SharedPtr& node_base,
                                   const node_interfaces::NodeServicesInterface::SharedPtr& node_services,
                                   node_interfaces::NodeParametersInterface* node_parameters, const QoS& qos) {
  const ServiceFactory factory(node_base, node_services, qos);
  // The order of creation is visible in the trace.
  services_.push_back(
      factory.make<srv::GetParameters>(names::kGetParameters, [node_parameters](const auto& request, auto& response) {
        answer_or_warn("get", [&] {
          for (const Parameter& parameter : node_parameters->get_parameters(request.names)) {
            response.values.push_back(parameter.get_value_message());
          }
        });
      }));
  services_.push_back(factory.make<srv::GetParameterTypes>(
      names::kGetParameterTypes, [node_parameters](const auto& request, auto& response) {
        answer_or_warn("get types of", [&] { response.types = node_parameters->get_parameter_types(request.names); });
      }));
  services_.push_back(
      factory.make<srv::SetParameters>(names::kSetParameters, [node_parameters](const auto& request, auto& response) {
        for (const Parameter& parameter : from_messages(request.parameters)) {
          response.results.push_back(set(*node_parameters, {parameter}));
        }
      }));
  services_.push_back(factory.make<srv::SetParametersAtomically>(
      names::kSetParametersAtomically, [node_parameters](const auto& request, auto& response) {
        try {
          response.result = node_parameters->set_parameters_atomically(from_messages(request.parameters));
        } catch (const exceptions::ParameterNotDeclaredException&) {
          response.result.successful = false;
          response.result.reason = "One or more parameters were not declared before setting";
        } catch (const std::exception& error) {
          response.result.successful = false;
          response.result.reason = error.what();
        }
      }));
  services_.push_back(factory.make<srv::DescribeParameters>(
      names::kDescribeParameters, [node_parameters](const auto& request, auto& response) {
        answer_or_warn("describe", [&] { response.descriptors = node_parameters->describe_parameters(request.names); });
      }));
  services_.push_back(
      factory.make<srv::ListParameters>(names::kListParameters, [node_parameters](const auto& request, auto& response) {
        response.result = node_parameters->list_parameters(request.prefixes, request.depth);
      }));
}

}  // namespace rclcpp
