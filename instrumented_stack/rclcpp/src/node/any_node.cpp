// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/detail/any_node.hpp"

#include <rmw/validate_namespace.h>

#include "rclcpp/exceptions.hpp"
#include "rclcpp/node.hpp"
#include "rclcpp/node_interfaces/node_time_source.hpp"

namespace rclcpp::detail {

namespace {

// The level holds for what the other parts of the node log when they are made.
std::shared_ptr<node_interfaces::NodeLogging> make_logging(
    const node_interfaces::NodeBaseInterface::SharedPtr& node_base, Logger::Level level) {
  auto logging = std::make_shared<node_interfaces::NodeLogging>(node_base);
  if (level != Logger::Level::Unset) {
    logging->get_logger().set_level(level);
  }
  return logging;
}

}  // namespace

AnyNode::AnyNode(const std::string& node_name, const std::string& node_namespace, const NodeOptions& options)
    : AnyNode(node_name, node_namespace, options, *options.make_rcl_node_options()) {}

// The order is visible in the trace: the rcl node with /rosout, the parameter services, /parameter_events,
// get_type_description, /clock.
AnyNode::AnyNode(const std::string& node_name, const std::string& node_namespace, const NodeOptions& options,
                 const rcl_node_options_t& rcl_options)
    : options_(options),
      node_base_(std::make_shared<node_interfaces::NodeBase>(node_name, node_namespace, options.context(), rcl_options,
                                                             options.use_intra_process_comms(),
                                                             options.enable_topic_statistics())),
      node_logging_(make_logging(node_base_, options.log_level())),
      node_graph_(std::make_shared<node_interfaces::NodeGraph>(node_base_)),
      node_timers_(std::make_shared<node_interfaces::NodeTimers>(node_base_)),
      node_topics_(std::make_shared<node_interfaces::NodeTopics>(node_base_, node_timers_)),
      node_services_(std::make_shared<node_interfaces::NodeServices>(node_base_)),
      node_waitables_(std::make_shared<node_interfaces::NodeWaitables>(node_base_)),
      node_clock_(std::make_shared<node_interfaces::NodeClock>(std::make_shared<Clock>(options.clock_type()))),
      node_parameters_(std::make_shared<node_interfaces::NodeParameters>(
          node_base_, node_services_, node_clock_->get_clock(), options_, rcl_options)),
      node_type_descriptions_(
          std::make_shared<node_interfaces::NodeTypeDescriptions>(node_base_, node_parameters_, node_services_)),
      node_time_source_(std::make_shared<node_interfaces::NodeTimeSource>(
          node_base_, node_topics_, node_graph_, node_services_, node_logging_, node_clock_, node_parameters_,
          options.clock_qos(), options.use_clock_thread())),
      effective_namespace_(node_base_->get_namespace()) {
  if (options.enable_logger_service()) {
    node_logging_->create_logger_services(node_services_);
  }
}

AnyNode::AnyNode(AnyNode& other, const std::string& sub_namespace)
    : options_(other.options_),
      node_base_(other.node_base_),
      node_logging_(other.node_logging_),
      node_graph_(other.node_graph_),
      node_timers_(other.node_timers_),
      node_topics_(other.node_topics_),
      node_services_(other.node_services_),
      node_waitables_(other.node_waitables_),
      node_clock_(other.node_clock_),
      node_parameters_(other.node_parameters_),
      node_type_descriptions_(other.node_type_descriptions_),
      node_time_source_(other.node_time_source_) {
  if (sub_namespace.empty()) {
    throw exceptions::NameValidationError("sub_namespace", "",
                                          "sub-nodes should not extend nodes by an empty sub-namespace", 0);
  }
  if (sub_namespace.front() == '/') {
    throw exceptions::NameValidationError("sub_namespace", sub_namespace.c_str(),
                                          "a sub-namespace should not have a leading /", 0);
  }
  sub_namespace_ = other.sub_namespace_.empty() ? sub_namespace : other.sub_namespace_ + "/" + sub_namespace;
  if (sub_namespace_.back() == '/') {
    sub_namespace_.pop_back();
  }
  const std::string node_namespace = node_base_->get_namespace();
  effective_namespace_ = (node_namespace.back() == '/' ? node_namespace : node_namespace + "/") + sub_namespace_;
  int result = RMW_NAMESPACE_VALID;
  size_t index = 0;
  if (rmw_validate_namespace(effective_namespace_.c_str(), &result, &index) != RMW_RET_OK) {
    exceptions::throw_from_rcl_error(RCL_RET_ERROR, "failed to validate a namespace");
  }
  if (result != RMW_NAMESPACE_VALID) {
    throw exceptions::InvalidNamespaceError(effective_namespace_.c_str(),
                                            rmw_namespace_validation_result_string(result), index);
  }
}

AnyNode::~AnyNode() = default;

std::string AnyNode::extend_name(const std::string& name) const {
  if (sub_namespace_.empty() || name.empty() || name.front() == '/' || name.front() == '~') {
    return name;
  }
  return sub_namespace_ + "/" + name;
}

CallbackGroup::SharedPtr AnyNode::create_callback_group(CallbackGroupType group_type,
                                                        bool automatically_add_to_executor_with_node) {
  return node_base_->create_callback_group(group_type, automatically_add_to_executor_with_node);
}

void AnyNode::for_each_callback_group(const std::function<void(CallbackGroup::SharedPtr)>& function) {
  node_base_->for_each_callback_group(function);
}

const ParameterValue& AnyNode::declare_parameter(const std::string& name, const ParameterValue& default_value,
                                                 const rcl_interfaces::msg::ParameterDescriptor& descriptor,
                                                 bool ignore_override) {
  return node_parameters_->declare_parameter(name, default_value, descriptor, ignore_override);
}

const ParameterValue& AnyNode::declare_parameter(const std::string& name, ParameterType type,
                                                 const rcl_interfaces::msg::ParameterDescriptor& descriptor,
                                                 bool ignore_override) {
  return node_parameters_->declare_parameter(name, type, descriptor, ignore_override);
}

void AnyNode::undeclare_parameter(const std::string& name) {
  node_parameters_->undeclare_parameter(name);
}

bool AnyNode::has_parameter(const std::string& name) const {
  return node_parameters_->has_parameter(name);
}

rcl_interfaces::msg::SetParametersResult AnyNode::set_parameter(const Parameter& parameter) {
  return set_parameters_atomically({parameter});
}

std::vector<rcl_interfaces::msg::SetParametersResult> AnyNode::set_parameters(
    const std::vector<Parameter>& parameters) {
  return node_parameters_->set_parameters(parameters);
}

rcl_interfaces::msg::SetParametersResult AnyNode::set_parameters_atomically(const std::vector<Parameter>& parameters) {
  return node_parameters_->set_parameters_atomically(parameters);
}

Parameter AnyNode::get_parameter(const std::string& name) const {
  return node_parameters_->get_parameter(name);
}

std::vector<Parameter> AnyNode::get_parameters(const std::vector<std::string>& names) const {
  return node_parameters_->get_parameters(names);
}

bool AnyNode::get_parameter(const std::string& name, Parameter& parameter) const {
  return node_parameters_->get_parameter(name, parameter);
}

rcl_interfaces::msg::ParameterDescriptor AnyNode::describe_parameter(const std::string& name) const {
  return node_parameters_->describe_parameters({name}).front();
}

std::vector<rcl_interfaces::msg::ParameterDescriptor> AnyNode::describe_parameters(
    const std::vector<std::string>& names) const {
  return node_parameters_->describe_parameters(names);
}

std::vector<uint8_t> AnyNode::get_parameter_types(const std::vector<std::string>& names) const {
  return node_parameters_->get_parameter_types(names);
}

rcl_interfaces::msg::ListParametersResult AnyNode::list_parameters(const std::vector<std::string>& prefixes,
                                                                   uint64_t depth) const {
  return node_parameters_->list_parameters(prefixes, depth);
}

AnyNode::OnSetParametersCallbackHandle::SharedPtr AnyNode::add_on_set_parameters_callback(
    OnSetParametersCallbackType callback) {
  return node_parameters_->add_on_set_parameters_callback(std::move(callback));
}

AnyNode::PreSetParametersCallbackHandle::SharedPtr AnyNode::add_pre_set_parameters_callback(
    PreSetParametersCallbackType callback) {
  return node_parameters_->add_pre_set_parameters_callback(std::move(callback));
}

AnyNode::PostSetParametersCallbackHandle::SharedPtr AnyNode::add_post_set_parameters_callback(
    PostSetParametersCallbackType callback) {
  return node_parameters_->add_post_set_parameters_callback(std::move(callback));
}

void AnyNode::remove_on_set_parameters_callback(const OnSetParametersCallbackHandle* handle) {
  node_parameters_->remove_on_set_parameters_callback(handle);
}

void AnyNode::remove_pre_set_parameters_callback(const PreSetParametersCallbackHandle* handle) {
  node_parameters_->remove_pre_set_parameters_callback(handle);
}

void AnyNode::remove_post_set_parameters_callback(const PostSetParametersCallbackHandle* handle) {
  node_parameters_->remove_post_set_parameters_callback(handle);
}

}  // namespace rclcpp::detail

namespace rclcpp {

Node::Node(const std::string& node_name, const NodeOptions& options) : Node(node_name, "", options) {}

Node::Node(const std::string& node_name, const std::string& node_namespace, const NodeOptions& options)
    : AnyNode(node_name, node_namespace, options) {}

Node::Node(Node& other, const std::string& sub_namespace)
    : AnyNode(other, sub_namespace), parent_(other.shared_from_this()) {}

Node::~Node() = default;

std::shared_ptr<Node> Node::create_sub_node(const std::string& sub_namespace) {
  // std::make_shared cannot call the protected constructor.
  return std::shared_ptr<Node>(new Node(*this, sub_namespace));
}

}  // namespace rclcpp
