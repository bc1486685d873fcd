// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/node_interfaces/node_parameters.hpp"

#include <algorithm>
#include <rcl/parameter_overrides.hpp>
#include <stdexcept>
#include <utility>
#include <variant>

#include "parameter/parameter_constraints.hpp"
#include "rclcpp/exceptions.hpp"

namespace rclcpp::node_interfaces {

namespace {

using rcl_interfaces::msg::ParameterEvent;

// Later sources replace earlier ones: the process's command line, the node's own arguments, the program's options.
std::map<std::string, ParameterValue> collect_overrides(const NodeBaseInterface& node_base, const NodeOptions& options,
                                                        const rcl_node_options_t& rcl_options) {
  std::map<std::string, ParameterValue> overrides;
  const auto add = [&](const rcl_arguments_t& arguments) {
    for (const auto& [name, value] :
         rcl::parameter_overrides(arguments).for_node(node_base.get_fully_qualified_name())) {
      overrides[name] = std::visit([](const auto& typed) { return ParameterValue(typed); }, value);
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

// The living handles. They are held so that a callback can remove itself.
template <typename HandleT>
std::vector<std::shared_ptr<HandleT>> living(std::list<std::weak_ptr<HandleT>>& handles) {
  std::vector<std::shared_ptr<HandleT>> result;
  handles.remove_if([&result](const std::weak_ptr<HandleT>& weak) {
    auto handle = weak.lock();
    if (handle) {
      result.push_back(std::move(handle));
    }
    return weak.expired();
  });
  return result;
}

template <typename HandleT, typename CallbackT>
std::shared_ptr<HandleT> add_handle(std::list<std::weak_ptr<HandleT>>& handles, CallbackT callback) {
  auto handle = std::make_shared<HandleT>();
  handle->callback = std::move(callback);
  handles.push_front(handle);  // the newest is called first
  return handle;
}

template <typename HandleT>
void remove_handle(std::list<std::weak_ptr<HandleT>>& handles, const HandleT* handle) {
  const auto found =
      std::find_if(handles.begin(), handles.end(), [handle](const auto& weak) { return weak.lock().get() == handle; });
  if (found == handles.end()) {
    throw std::runtime_error("Callback doesn't exist");
  }
  handles.erase(found);
}

std::string in_quotes(const std::string& name) {
  return "parameter '" + name + "'";
}

}  // namespace

// Held while parameters change. If a callback tries to change parameters too, it is refused.
class NodeParameters::ChangeScope {
 public:
  explicit ChangeScope(NodeParameters& parameters) : lock_(parameters.mutex_), parameters_(parameters) {
    if (parameters_.changing_) {
      throw exceptions::ParameterModifiedInCallbackException(
          "cannot set or declare a parameter, or change the callback from within set callback");
    }
    parameters_.changing_ = true;
  }
  ~ChangeScope() { parameters_.changing_ = false; }
  RCLCPP_DISABLE_COPY(ChangeScope)

 private:
  std::lock_guard<std::recursive_mutex> lock_;
  NodeParameters& parameters_;
};

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
  if (options.start_parameter_event_publisher()) {
    PublisherOptions events_options(options.parameter_event_publisher_options());
    events_options.use_default_callbacks = false;
    events_publisher_ = std::make_shared<Publisher<ParameterEvent>>(node_base_.get(), "/parameter_events",
                                                                    options.parameter_event_qos(), events_options);
  }
  if (options.automatically_declare_parameters_from_overrides()) {
    for (const auto& [name, value] : overrides_) {
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
    throw std::invalid_argument("declare_parameter(): the provided parameter type cannot be PARAMETER_NOT_SET");
  }
  if (descriptor.dynamic_typing) {
    throw std::invalid_argument("declare_parameter(): cannot declare parameter of specific type and dynamically typed");
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
    // Declared, but without a value until one is set.
    return (parameters_[name] = {ParameterValue(), descriptor}).value;
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
  for (const auto& handle : living(post_set_callbacks_)) {
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

std::vector<NodeParameters::Result> NodeParameters::set_parameters(const std::vector<Parameter>& parameters) {
  std::vector<Result> results;
  for (const Parameter& parameter : parameters) {
    results.push_back(set_parameters_atomically({parameter}));
  }
  return results;
}

NodeParameters::Result NodeParameters::set_parameters_atomically(const std::vector<Parameter>& parameters_before) {
  const ChangeScope scope(*this);
  Result result;
  result.successful = false;

  std::vector<Parameter> parameters = parameters_before;
  for (const auto& handle : living(pre_set_callbacks_)) {
    handle->callback(parameters);
  }
  if (parameters.empty() && !parameters_before.empty()) {
    result.reason =
        "parameter list cannot be empty, this might be due to pre_set_parameters_callback modifying the original "
        "parameters list.";
    return result;
  }

  // Everything is checked on copies first, so that a refusal leaves nothing half set.
  std::map<std::string, Declared> changed;
  std::vector<std::string> deleted;
  for (const Parameter& parameter : parameters) {
    const std::string& name = parameter.get_name();
    if (name.empty()) {
      throw exceptions::InvalidParametersException("parameter name must not be empty");
    }
    const auto found = parameters_.find(name);
    Declared declared;
    if (found != parameters_.end()) {
      declared = found->second;
    } else if (allow_undeclared_) {
      declared.descriptor.name = name;
      declared.descriptor.dynamic_typing = true;
    } else {
      throw exceptions::ParameterNotDeclaredException(in_quotes(name) + " cannot be set because it was not declared");
    }
    if (declared.descriptor.read_only) {
      result.reason = in_quotes(name) + " cannot be set because it is read-only";
      return result;
    }
    if (parameter.get_type() == PARAMETER_NOT_SET && declared.descriptor.dynamic_typing) {
      deleted.push_back(name);
      continue;
    }
    Result allowed = check_constraints(declared.descriptor, parameter.get_parameter_value());
    if (!allowed.successful) {
      return allowed;
    }
    declared.value = parameter.get_parameter_value();
    declared.descriptor.type = declared.value.get_type();
    changed[name] = std::move(declared);
  }
  result = call_on_set_callbacks(parameters);
  if (!result.successful) {
    return result;
  }

  ParameterEvent event = new_event();
  for (auto& [name, declared] : changed) {
    const auto found = parameters_.find(name);
    const bool was_set = found != parameters_.end() && found->second.value.get_type() != PARAMETER_NOT_SET;
    (was_set ? event.changed_parameters : event.new_parameters)
        .push_back(Parameter(name, declared.value).to_parameter_msg());
    parameters_[name] = std::move(declared);
  }
  for (const std::string& name : deleted) {
    const auto found = parameters_.find(name);
    if (found != parameters_.end()) {
      event.deleted_parameters.push_back(Parameter(name, found->second.value).to_parameter_msg());
      parameters_.erase(found);
    }
  }
  for (const auto& handle : living(post_set_callbacks_)) {
    handle->callback(parameters);
  }
  if (!changed.empty() || !event.deleted_parameters.empty()) {
    publish(event);
  }
  return result;
}

OnSetParametersCallbackHandle::SharedPtr NodeParameters::add_on_set_parameters_callback(
    decltype(OnSetParametersCallbackHandle::callback) callback) {
  const ChangeScope scope(*this);
  return add_handle(on_set_callbacks_, std::move(callback));
}

PreSetParametersCallbackHandle::SharedPtr NodeParameters::add_pre_set_parameters_callback(
    decltype(PreSetParametersCallbackHandle::callback) callback) {
  const ChangeScope scope(*this);
  return add_handle(pre_set_callbacks_, std::move(callback));
}

PostSetParametersCallbackHandle::SharedPtr NodeParameters::add_post_set_parameters_callback(
    decltype(PostSetParametersCallbackHandle::callback) callback) {
  const ChangeScope scope(*this);
  return add_handle(post_set_callbacks_, std::move(callback));
}

void NodeParameters::remove_on_set_parameters_callback(const OnSetParametersCallbackHandle* handle) {
  const ChangeScope scope(*this);
  remove_handle(on_set_callbacks_, handle);
}

void NodeParameters::remove_pre_set_parameters_callback(const PreSetParametersCallbackHandle* handle) {
  const ChangeScope scope(*this);
  remove_handle(pre_set_callbacks_, handle);
}

void NodeParameters::remove_post_set_parameters_callback(const PostSetParametersCallbackHandle* handle) {
  const ChangeScope scope(*this);
  remove_handle(post_set_callbacks_, handle);
}

NodeParameters::Result NodeParameters::call_on_set_callbacks(const std::vector<Parameter>& parameters) {
  for (const auto& handle : living(on_set_callbacks_)) {
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
