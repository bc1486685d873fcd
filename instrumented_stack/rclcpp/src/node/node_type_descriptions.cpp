// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/node_interfaces/node_type_descriptions.hpp"

#include <rcl/described_types.hpp>
#include <type_description_interfaces/srv/get_type_description.hpp>

#include "rclcpp/create_service.hpp"
#include "rclcpp/exceptions.hpp"

namespace rclcpp::node_interfaces {

namespace {

using type_description_interfaces::srv::GetTypeDescription;

using type_description_interfaces::msg::Field;
using type_description_interfaces::msg::IndividualTypeDescription;
using type_description_interfaces::msg::TypeSource;

constexpr const char* kParameter = "start_type_description_service";

IndividualTypeDescription to_message(const rosidl_type_description_t& type) {
  IndividualTypeDescription message;
  message.type_name = type.type_name;
  message.fields.reserve(type.field_count);
  for (size_t i = 0; i < type.field_count; ++i) {
    const rosidl_field_description_t& field = type.fields[i];
    Field& added = message.fields.emplace_back();
    added.name = field.name;
    added.type.type_id = field.type_id;
    added.type.capacity = field.capacity;
    added.type.string_capacity = field.string_capacity;
    added.type.nested_type_name = field.nested_type != nullptr ? field.nested_type->type_name : "";
    added.default_value = field.default_value;
  }
  return message;
}

TypeSource source_of(const rosidl_type_description_t& type) {
  TypeSource message;
  message.type_name = type.type_name;
  message.encoding = type.encoding;
  message.raw_file_contents = type.source;
  return message;
}

void answer(const rcl_node_t* node, const GetTypeDescription::Request& request,
            GetTypeDescription::Response& response) {
  const rcl::DescribedTypes described = rcl::describe_type(node, request.type_hash);
  response.successful = !described.types.empty();
  response.failure_reason = described.failure_reason;
  for (const rosidl_type_description_t* type : described.types) {
    if (type == described.types.front()) {
      response.type_description.type_description = to_message(*type);
    } else {
      response.type_description.referenced_type_descriptions.push_back(to_message(*type));
    }
    if (request.include_type_sources) {
      response.type_sources.push_back(source_of(*type));
    }
  }
}

}  // namespace

NodeTypeDescriptions::NodeTypeDescriptions(const NodeBaseInterface::SharedPtr& node_base,
                                           const NodeParametersInterface::SharedPtr& parameters,
                                           const NodeServicesInterface::SharedPtr& services) {
  if (!parameters->has_parameter(kParameter)) {
    NodeParametersInterface::Descriptor descriptor;
    descriptor.name = kParameter;
    descriptor.type = PARAMETER_BOOL;
    descriptor.description = "Start the ~/get_type_description service for this node.";
    descriptor.read_only = true;
    parameters->declare_parameter(kParameter, ParameterValue(true), descriptor);
  }
  const Parameter parameter = parameters->get_parameter(kParameter);
  if (parameter.get_type() != PARAMETER_BOOL) {
    throw exceptions::InvalidParameterTypeException(kParameter,
                                                    "expected [bool] got [" + to_string(parameter.get_type()) + "]");
  }
  if (!parameter.as_bool()) {
    return;
  }
  service_ = create_service<GetTypeDescription>(
      node_base, services, "~/get_type_description",
      [node = node_base->get_shared_rcl_node_handle()](const std::shared_ptr<GetTypeDescription::Request> request,
                                                       std::shared_ptr<GetTypeDescription::Response> response) {
        answer(node.get(), *request, *response);
      },
      ServicesQoS(), nullptr);
}

}  // namespace rclcpp::node_interfaces
