// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/detail/qos_parameters.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

namespace rclcpp::detail {

namespace {

template <typename PolicyT>
struct Spelling {
  PolicyT policy;
  std::string_view name;
};

constexpr Spelling<HistoryPolicy> kHistory[] = {{HistoryPolicy::SystemDefault, "system_default"},
                                                {HistoryPolicy::KeepLast, "keep_last"},
                                                {HistoryPolicy::KeepAll, "keep_all"}};
constexpr Spelling<ReliabilityPolicy> kReliability[] = {{ReliabilityPolicy::SystemDefault, "system_default"},
                                                        {ReliabilityPolicy::Reliable, "reliable"},
                                                        {ReliabilityPolicy::BestEffort, "best_effort"},
                                                        {ReliabilityPolicy::BestAvailable, "best_available"}};
constexpr Spelling<DurabilityPolicy> kDurability[] = {{DurabilityPolicy::SystemDefault, "system_default"},
                                                      {DurabilityPolicy::TransientLocal, "transient_local"},
                                                      {DurabilityPolicy::Volatile, "volatile"},
                                                      {DurabilityPolicy::BestAvailable, "best_available"}};
constexpr Spelling<LivelinessPolicy> kLiveliness[] = {{LivelinessPolicy::SystemDefault, "system_default"},
                                                      {LivelinessPolicy::Automatic, "automatic"},
                                                      {LivelinessPolicy::ManualByTopic, "manual_by_topic"},
                                                      {LivelinessPolicy::BestAvailable, "best_available"}};

template <typename PolicyT, size_t n>
ParameterValue spelled(const Spelling<PolicyT> (&spellings)[n], PolicyT policy) {
  for (const Spelling<PolicyT>& spelling : spellings) {
    if (spelling.policy == policy) {
      return ParameterValue(std::string(spelling.name));
    }
  }
  return ParameterValue("unknown");
}

template <typename PolicyT, size_t n>
PolicyT policy_of(const Spelling<PolicyT> (&spellings)[n], const std::string& parameter, const ParameterValue& value) {
  const std::string& name = value.get<PARAMETER_STRING>();
  std::string known;
  for (const Spelling<PolicyT>& spelling : spellings) {
    if (spelling.name == name) {
      return spelling.policy;
    }
    known += (known.empty() ? "" : ", ") + std::string(spelling.name);
  }
  throw exceptions::InvalidQosOverridesException("parameter '" + parameter + "' has the unknown value '" + name +
                                                 "': it can be " + known);
}

ParameterValue default_value(QosPolicyKind kind, const QoS& qos) {
  switch (kind) {
    case QosPolicyKind::AvoidRosNamespaceConventions:
      return ParameterValue(qos.avoid_ros_namespace_conventions());
    case QosPolicyKind::Deadline:
      return ParameterValue(qos.deadline().nanoseconds());
    case QosPolicyKind::Depth:
      return ParameterValue(static_cast<int64_t>(qos.depth()));
    case QosPolicyKind::Durability:
      return spelled(kDurability, qos.durability());
    case QosPolicyKind::History:
      return spelled(kHistory, qos.history());
    case QosPolicyKind::Lifespan:
      return ParameterValue(qos.lifespan().nanoseconds());
    case QosPolicyKind::Liveliness:
      return spelled(kLiveliness, qos.liveliness());
    case QosPolicyKind::LivelinessLeaseDuration:
      return ParameterValue(qos.liveliness_lease_duration().nanoseconds());
    case QosPolicyKind::Reliability:
      return spelled(kReliability, qos.reliability());
    case QosPolicyKind::Invalid:
      break;
  }
  throw std::invalid_argument("unknown QoS policy kind");
}

void apply(QosPolicyKind kind, const std::string& parameter, const ParameterValue& value, QoS& qos) {
  const auto not_negative = [&parameter, &value] {
    const int64_t number = value.get<PARAMETER_INTEGER>();
    if (number < 0) {
      throw exceptions::InvalidQosOverridesException("parameter '" + parameter +
                                                     "' is negative: " + std::to_string(number));
    }
    return number;
  };
  switch (kind) {
    case QosPolicyKind::AvoidRosNamespaceConventions:
      qos.avoid_ros_namespace_conventions(value.get<PARAMETER_BOOL>());
      break;
    case QosPolicyKind::Deadline:
      qos.deadline(Duration::from_nanoseconds(not_negative()));
      break;
    case QosPolicyKind::Depth:
      qos.get_rmw_qos_profile().depth = static_cast<size_t>(not_negative());
      break;
    case QosPolicyKind::Durability:
      qos.durability(policy_of(kDurability, parameter, value));
      break;
    case QosPolicyKind::History:
      qos.history(policy_of(kHistory, parameter, value));
      break;
    case QosPolicyKind::Lifespan:
      qos.lifespan(Duration::from_nanoseconds(not_negative()));
      break;
    case QosPolicyKind::Liveliness:
      qos.liveliness(policy_of(kLiveliness, parameter, value));
      break;
    case QosPolicyKind::LivelinessLeaseDuration:
      qos.liveliness_lease_duration(Duration::from_nanoseconds(not_negative()));
      break;
    case QosPolicyKind::Reliability:
      qos.reliability(policy_of(kReliability, parameter, value));
      break;
    case QosPolicyKind::Invalid:
      break;
  }
}

}  // namespace

QoS declare_qos_parameters(const QosOverridingOptions& options, node_interfaces::NodeParametersInterface& parameters,
                           const std::string& topic_name, const QoS& qos, QosEntity entity) {
  const bool is_publisher = entity == QosEntity::Publisher;
  const std::string entity_name = is_publisher ? "publisher" : "subscription";
  const std::string suffix = options.get_id().empty() ? "" : "_" + options.get_id();
  const std::string prefix = "qos_overrides." + topic_name + "." + entity_name + suffix + ".";
  const std::string description_end = "} for " + entity_name + " {" + topic_name + "}" +
                                      (options.get_id().empty() ? "" : " with id {" + options.get_id() + "}");
  QoS overridden = qos;
  for (const QosPolicyKind kind : options.get_policy_kinds()) {
    if (kind == QosPolicyKind::Lifespan && !is_publisher) {
      continue;  // only for publishers
    }
    const std::string name = prefix + qos_policy_kind_to_cstr(kind);
    // A second entity of the node on the topic uses the same parameters.
    if (!parameters.has_parameter(name)) {
      rcl_interfaces::msg::ParameterDescriptor descriptor;
      descriptor.description = std::string("qos policy {") + qos_policy_kind_to_cstr(kind) + description_end;
      descriptor.read_only = true;
      parameters.enable_parameter_modification();
      parameters.declare_parameter(name, default_value(kind, qos), descriptor);
    }
    apply(kind, name, parameters.get_parameter(name).get_parameter_value(), overridden);
  }
  if (const QosCallback& validate = options.get_validation_callback()) {
    const QosCallbackResult result = validate(overridden);
    if (!result.successful) {
      throw exceptions::InvalidQosOverridesException("validation callback failed: " + result.reason);
    }
  }
  return overridden;
}

QoS overridden_qos(const QosOverridingOptions& options,
                   const std::shared_ptr<node_interfaces::NodeParametersInterface>& parameters,
                   const node_interfaces::NodeBaseInterface& node_base, const std::string& topic_name, const QoS& qos,
                   QosEntity entity) {
  if (options.get_policy_kinds().empty()) {
    return qos;
  }
  if (!parameters) {
    throw std::runtime_error("passed non-default qos overriding options without providing a parameters interface");
  }
  return declare_qos_parameters(options, *parameters, node_base.resolve_topic_or_service_name(topic_name, false), qos,
                                entity);
}

}  // namespace rclcpp::detail
