#include "rclcpp/node_interfaces/node_type_descriptions.hpp"

#include <type_description_interfaces/srv/get_type_description.hpp>

#include "rclcpp/create_service.hpp"

namespace rclcpp::node_interfaces {

namespace {

using type_description_interfaces::srv::GetTypeDescription;

constexpr const char* kParameter = "start_type_description_service";

}  // namespace

NodeTypeDescriptions::NodeTypeDescriptions(const NodeBaseInterface::SharedPtr& node_base,
                                           const NodeParametersInterface::SharedPtr& parameters,
                                           const NodeServicesInterface::SharedPtr& services) {
  if (!parameters->has_parameter(kParameter)) {
    NodeParameters::Descriptor descriptor;
    descriptor.name = kParameter;
    descriptor.type = PARAMETER_BOOL;
    descriptor.description = "Start the ~/get_type_description service for this node.";
    descriptor.read_only = true;
    parameters->declare_parameter(kParameter, ParameterValue(true), descriptor);
  }
  if (!parameters->get_parameter(kParameter).as_bool()) {
    return;
  }
  service_ = create_service<GetTypeDescription>(
      node_base, services, "~/get_type_description",
      [](std::shared_ptr<GetTypeDescription::Request> request, std::shared_ptr<GetTypeDescription::Response> response) {
        response->successful = false;
        response->failure_reason = "this node has no description of type '" + request->type_name + "'";
      },
      ServicesQoS(), nullptr);
}

}  // namespace rclcpp::node_interfaces
