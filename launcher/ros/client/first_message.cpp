// SPDX-License-Identifier: Apache-2.0
// Waits for the first message on a topic of any type.
//
// The message is not read, so its type need not be known when this program is built. DDS only asks a reader for the
// name of the type, and the graph has this name.
#include <rcl/subscription.h>
#include <rosidl_typesupport_fastrtps_cpp/message_type_support.h>

#include <cstring>
#include <map>
#include <rclcpp/exceptions.hpp>
#include <rosidl_typesupport_fastrtps_cpp/identifier.hpp>
#include <string>
#include <utility>
#include <vector>

#include "launcher/ros/client/operation.hpp"

namespace launch {

namespace {

// The type support of a type of which only the name is known.
class OpaqueType {
 public:
  // "std_msgs/msg/String"
  explicit OpaqueType(const std::string& type) {
    const std::size_t separator = type.rfind('/');
    name_ = type.substr(separator == std::string::npos ? 0 : separator + 1);
    for (std::size_t i = 0; separator != std::string::npos && i < separator; ++i) {
      name_space_ += type[i] == '/' ? std::string("::") : std::string(1, type[i]);
    }
    callbacks_.message_namespace_ = name_space_.c_str();
    callbacks_.message_name_ = name_.c_str();
    callbacks_.type_hash_ = "";  // the definition of the type is not known
    callbacks_.cdr_serialize = write;
    callbacks_.cdr_deserialize = read;
    callbacks_.get_serialized_size = size;
    callbacks_.max_serialized_size = max_size;
    handle_ = {rosidl_typesupport_fastrtps_cpp::typesupport_identifier, &callbacks_, itself};
  }
  OpaqueType(const OpaqueType&) = delete;
  OpaqueType& operator=(const OpaqueType&) = delete;

  const rosidl_message_type_support_t& handle() const { return handle_; }

 private:
  static bool write(const void*, eprosima::fastcdr::Cdr&) { return false; }
  static bool read(eprosima::fastcdr::Cdr&, void*) { return false; }
  static uint32_t size(const void*) { return 0; }
  static size_t max_size(char& bounds_info) {
    bounds_info = ROSIDL_TYPESUPPORT_FASTRTPS_UNBOUNDED_TYPE;
    return 0;
  }
  static const rosidl_message_type_support_t* itself(const rosidl_message_type_support_t* handle,
                                                     const char* identifier) {
    return std::strcmp(identifier, handle->typesupport_identifier) == 0 ? handle : nullptr;
  }

  std::string name_space_;  // "std_msgs::msg"
  std::string name_;
  message_type_support_callbacks_t callbacks_{};
  rosidl_message_type_support_t handle_{};
};

// Type supports live as long as the program.
const rosidl_message_type_support_t& opaque_type(const std::string& type) {
  static std::map<std::string, OpaqueType> types;
  return types.try_emplace(type, type).first->second.handle();
}

class OpaqueSubscription {
 public:
  OpaqueSubscription(rclcpp::Node& node, const std::string& topic, const std::string& type, const rclcpp::QoS& qos)
      : node_(node.get_node_base_interface()->get_shared_rcl_node_handle()) {
    rcl_subscription_options_t options = rcl_subscription_get_default_options();
    options.qos = qos.get_rmw_qos_profile();
    const rcl_ret_t ret =
        rcl_subscription_init(&subscription_, node_.get(), &opaque_type(type), topic.c_str(), &options);
    if (ret != RCL_RET_OK) {
      rclcpp::exceptions::throw_from_rcl_error(ret, "could not subscribe to '" + topic + "'");
    }
  }
  ~OpaqueSubscription() { (void)rcl_subscription_fini(&subscription_, node_.get()); }
  OpaqueSubscription(const OpaqueSubscription&) = delete;
  OpaqueSubscription& operator=(const OpaqueSubscription&) = delete;

  bool has_message() {
    rclcpp::SerializedMessage message;
    const rcl_ret_t ret =
        rcl_take_serialized_message(&subscription_, &message.get_rcl_serialized_message(), nullptr, nullptr);
    rcl_reset_error();
    return ret == RCL_RET_OK;
  }
  const rcl_subscription_t* handle() const { return &subscription_; }

 private:
  std::shared_ptr<rcl_node_t> node_;
  rcl_subscription_t subscription_ = rcl_get_zero_initialized_subscription();
};

class FirstMessage final : public Operation {
 public:
  FirstMessage(const MessagePublished& request, rclcpp::Node& node, Answer answer)
      : Operation(std::move(answer)), request_(request), node_(node) {}

  void look() override {
    if (subscriptions_.empty()) {
      subscribe();
    }
    for (const auto& subscription : subscriptions_) {
      if (subscription->has_message()) {
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
