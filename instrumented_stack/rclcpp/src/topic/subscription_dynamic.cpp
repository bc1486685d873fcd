// SPDX-License-Identifier: Apache-2.0
// Types that are made at run time, which no subscription has.
#include <string>

#include "rclcpp/exceptions.hpp"
#include "rclcpp/subscription_base.hpp"

namespace rclcpp {

using dynamic_typesupport::DynamicMessage;
using dynamic_typesupport::DynamicMessageType;
using dynamic_typesupport::DynamicSerializationSupport;

namespace {

[[noreturn]] void throw_unimplemented(const std::string& function) {
  throw exceptions::UnimplementedError(function + " is not implemented for subscriptions");
}

}  // namespace

DynamicMessageType::SharedPtr SubscriptionBase::get_shared_dynamic_message_type() {
  throw_unimplemented("get_shared_dynamic_message_type");
}

DynamicMessage::SharedPtr SubscriptionBase::get_shared_dynamic_message() {
  throw_unimplemented("get_shared_dynamic_message");
}

DynamicSerializationSupport::SharedPtr SubscriptionBase::get_shared_dynamic_serialization_support() {
  throw_unimplemented("get_shared_dynamic_serialization_support");
}

DynamicMessage::SharedPtr SubscriptionBase::create_dynamic_message() {
  throw_unimplemented("create_dynamic_message");
}

void SubscriptionBase::return_dynamic_message(DynamicMessage::SharedPtr& /*message*/) {
  throw_unimplemented("return_dynamic_message");
}

void SubscriptionBase::handle_dynamic_message(const DynamicMessage::SharedPtr& /*message*/,
                                              const MessageInfo& /*message_info*/) {
  throw_unimplemented("handle_dynamic_message");
}

bool SubscriptionBase::take_dynamic_message(DynamicMessage& /*message_out*/, MessageInfo& /*message_info_out*/) {
  throw_unimplemented("take_dynamic_message");
}

}  // namespace rclcpp
