// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/node_interfaces/node_parameters.hpp"

#include <algorithm>
#include <rcl/parameter_overrides.hpp>
#include <stdexcept>
#include <utility>
#include <variant>

#include "parameter/parameter_changes.hpp"
#include "rclcpp/detail/qos_parameters.hpp"
#include "rclcpp/exceptions.hpp"

namespace rclcpp::node_interfaces {

namespace {

using rcl_interfaces::msg::ParameterEvent;

// Later sources replace earlier ones: the process's command line, the node's own arguments, the program's options.
std::map<std::string, ParameterValue> collect_overrides(NodeBaseInterface& node_base, const NodeOptions& options,
                                                        const rcl_node_options_t& rcl_options) {
  std::map<std::string, ParameterValue> overrides;
  const auto add = [&](const rcl_arguments_t& arguments) {
    try {
      for (const auto& [name, value] :
           rcl::parameter_overrides(arguments).for_node(node_base.get_fully_qualified_name())) {
        overrides[name] = std::visit([](const auto& typed) { return ParameterValue(typed); }, value);
      }
    } catch (const std::invalid_argument& error) {
      throw exceptions::InvalidParameterValueException(error.what());
    }
  };
  if (rcl_options.use_global_arguments) {
    add(node_base.get_context()->get_rcl_context()->global_arguments);
  }
  add(rcl_options.arguments);
  for (const Parameter& parameter : options.parameter_overrides()) {
    overrides[parameter.get_name()] = parameter.get_parameter_value();
  }
  return overrides;
}

template <typename HandleT>
void remove_handle(std::list<std::weak_ptr<HandleT>>& handles, const HandleT* handle, const std::string& kind) {
  const auto found =
      std::find_if(handles.begin(), handles.end(), [handle](const auto& weak) { return weak.lock().get() == handle; });
  if (found == handles.end()) {
    throw std::runtime_error(kind + " set parameter callback doesn't exist");
  }
  handles.erase(found);
}

std::string in_quotes(const std::string& name) {
  return "parameter '" + name + "'";
}

}  // namespace

NodeParameters::NodeParameters(NodeBaseInterface::SharedPtr node_base,
                               const NodeServicesInterface::SharedPtr& node_services, Clock::SharedPtr clock,
                               const NodeOptions& options, const rcl_node_options_t& rcl_options)
    : node_base_(std::move(node_base)),
      clock_(std::move(clock)),
      allow_undeclared_(options.allow_undeclared_parameters()),
      overrides_(collect_overrides(*node_base_, options, rcl_options)) {
  if (options.start_parameter_services()) {
    services_ = std::make_unique<ParameterService>(node_base_, node_services, this);
  }
  const QoS events_qos = detail::declare_qos_parameters(
      {QosPolicyKind::Depth, QosPolicyKind::Durability, QosPolicyKind::History, QosPolicyKind::Reliability}, *this,
      node_base_->resolve_topic_or_service_name("/parameter_events", false), options.parameter_event_qos(),
      detail::QosEntity::Publisher);
  if (options.start_parameter_event_publisher()) {
    PublisherOptions events_options(options.parameter_event_publisher_options());
    events_options.use_default_callbacks = false;
    events_publisher_ =
        std::make_shared<Publisher<ParameterEvent>>(node_base_.get(), "/parameter_events", events_qos, events_options);
  }
  if (options.automatically_declare_parameters_from_overrides()) {
    for (const auto& [name, value] : overrides_) {
      if (has_parameter(name)) {
        continue;
      }
      Descriptor descriptor;
      descriptor.dynamic_typing = true;
      declare_parameter(name, value, descriptor, true);
    }
  }
}

NodeParameters::~NodeParameters() = default;

const ParameterValue& NodeParameters::declare_parameter(const std::string& name, const ParameterValue& default_value,
                                                        const Descriptor& descriptor, bool ignore_override) {
  return declare(name, &default_value, descriptor, ignore_override);
}

const ParameterValue& NodeParameters::declare_parameter(const std::string& name, ParameterType type,
                                                        const Descriptor& descriptor, bool ignore_override) {
  if (type == PARAMETER_NOT_SET) {
    throw std::invalid_argument("declare_parameter(): the provided parameter type cannot be rclcpp::PARAMETER_NOT_SET");
  }
  if (descriptor.dynamic_typing) {
    throw std::invalid_argument(
        "declare_parameter(): cannot declare parameter of specific type and pass descriptor with "
        "`dynamic_typing=true`");
  }
  Descriptor typed = descriptor;
  typed.type = type;
  return declare(name, nullptr, typed, ignore_override);
}

const ParameterValue& NodeParameters::declare(const std::string& name, const ParameterValue* default_value,
                                              Descriptor descriptor, bool ignore_override) {
  const ChangeScope scope(*this);
  if (name.empty()) {
    throw exceptions::InvalidParametersException("parameter name must not be empty");
  }
  if (parameters_.count(name) > 0) {
    throw exceptions::ParameterAlreadyDeclaredException(in_quotes(name) + " has already been declared");
  }
  descriptor.name = name;
  if (default_value && !descriptor.dynamic_typing) {
    if (default_value->get_type() == PARAMETER_NOT_SET) {
      throw exceptions::InvalidParameterTypeException(
          name, "cannot declare a statically typed parameter with an uninitialized value");
    }
    descriptor.type = default_value->get_type();
  }

  const auto override = overrides_.find(name);
  const bool overridden = override != overrides_.end() && !ignore_override;
  const ParameterValue* value = overridden ? &override->second : default_value;
  if (!value || value->get_type() == PARAMETER_NOT_SET) {
    // Declared, but without a value until one is set. The event tells no parameter, as in ROS 2.
    const Declared& declared = parameters_[name] = {ParameterValue(), descriptor};
    publish(new_event());
    return declared.value;
  }

  const Parameter parameter(name, *value);
  Result result = check_constraints(descriptor, *value);
  if (!result.successful && !descriptor.dynamic_typing && descriptor.type != value->get_type()) {
    throw exceptions::InvalidParameterTypeException(name, result.reason);
  }
  if (result.successful) {
    result = call_on_set_callbacks({parameter});
  }
  if (!result.successful) {
    throw exceptions::InvalidParameterValueException(in_quotes(name) + " could not be set: " + result.reason);
  }
  descriptor.type = value->get_type();
  Declared& declared = parameters_[name] = {*value, descriptor};
  for (const auto& handle : detail::living(post_set_callbacks_)) {
    handle->callback({parameter});
  }

  ParameterEvent event = new_event();
  event.new_parameters.push_back(parameter.to_parameter_msg());
  publish(event);
  return declared.value;
}

void NodeParameters::undeclare_parameter(const std::string& name) {
  const ChangeScope scope(*this);
  const auto found = parameters_.find(name);
  if (found == parameters_.end()) {
    throw exceptions::ParameterNotDeclaredException("cannot undeclare " + in_quotes(name) +
                                                    " which has not yet been declared");
  }
  if (found->second.descriptor.read_only) {
    throw exceptions::ParameterImmutableException("cannot undeclare " + in_quotes(name) + " because it is read-only");
  }
  if (!found->second.descriptor.dynamic_typing) {
    throw exceptions::InvalidParameterTypeException(name, "cannot undeclare a statically typed parameter");
  }
  parameters_.erase(found);
}

OnSetParametersCallbackHandle::SharedPtr NodeParameters::add_on_set_parameters_callback(
    OnSetParametersCallbackType callback) {
  const ChangeScope scope(*this);
  return detail::add_handle(on_set_callbacks_, std::move(callback));
}

PreSetParametersCallbackHandle::SharedPtr NodeParameters::add_pre_set_parameters_callback(
    PreSetParametersCallbackType callback) {
  const ChangeScope scope(*this);
  return detail::add_handle(pre_set_callbacks_, std::move(callback));
}

PostSetParametersCallbackHandle::SharedPtr NodeParameters::add_post_set_parameters_callback(
    PostSetParametersCallbackType callback) {
  const ChangeScope scope(*this);
  return detail::add_handle(post_set_callbacks_, std::move(callback));
}

void NodeParameters::remove_on_set_parameters_callback(const OnSetParametersCallbackHandle* handle) {
  const ChangeScope scope(*this);
  remove_handle(on_set_callbacks_, handle, "On");
}

void NodeParameters::remove_pre_set_parameters_callback(const PreSetParametersCallbackHandle* handle) {
  const ChangeScope scope(*this);
  remove_handle(pre_set_callbacks_, handle, "Pre");
}

void NodeParameters::remove_post_set_parameters_callback(const PostSetParametersCallbackHandle* handle) {
  const ChangeScope scope(*this);
  remove_handle(post_set_callbacks_, handle, "Post");
}

void NodeParameters::enable_parameter_modification() {
  const std::lock_guard lock(mutex_);  // another thread's callback comes to its end first
  changing_ = false;
}

NodeParameters::Result NodeParameters::call_on_set_callbacks(const std::vector<Parameter>& parameters) {
  for (const auto& handle : detail::living(on_set_callbacks_)) {
    Result result = handle->callback(parameters);
    if (!result.successful) {
      return result;
    }
  }
  Result success;
  success.successful = true;
  return success;
}

ParameterEvent NodeParameters::new_event() const {
  ParameterEvent event;
  event.node = node_base_->get_fully_qualified_name();
  event.stamp = clock_->now();
  return event;
}

void NodeParameters::publish(const ParameterEvent& event) {
  if (events_publisher_) {
    events_publisher_->publish(event);
  }
}

}  // namespace rclcpp::node_interfaces
