// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "lifecycle_msgs/msg/transition.hpp"
#include "rosidl_typesupport_fastrtps_cpp/identifier.hpp"
#include "rosidl_typesupport_fastrtps_cpp/message_type_support.h"
#include "rosidl_typesupport_fastrtps_cpp/service_type_support.h"
#include "std_msgs/msg/string.hpp"
#include "test_interfaces/srv/add_two_ints.hpp"
#include "type_description_interfaces/msg/field_type.hpp"
#include "type_description_interfaces/srv/get_type_description.hpp"

namespace {

using rosidl_typesupport_cpp::get_message_type_support_handle;
using rosidl_typesupport_cpp::get_service_type_support_handle;
using rosidl_typesupport_fastrtps_cpp::typesupport_identifier;

TEST(TypeSupport, HandleLeadsToTheNamesOfTheMessage) {
  const auto* handle = get_message_type_support_handle<std_msgs::msg::String>();
  EXPECT_STREQ(handle->typesupport_identifier, typesupport_identifier);
  const auto& callbacks = *static_cast<const message_type_support_callbacks_t*>(handle->data);
  EXPECT_STREQ(callbacks.message_namespace_, "std_msgs::msg");
  EXPECT_STREQ(callbacks.message_name_, "String");
}

TEST(TypeSupport, HandleIsFoundByItsIdentifierOnly) {
  const auto* handle = get_message_type_support_handle<std_msgs::msg::String>();
  EXPECT_EQ(get_message_typesupport_handle(handle, "rosidl_typesupport_fastrtps_cpp"), handle);
  EXPECT_EQ(get_message_typesupport_handle(handle, "rosidl_typesupport_introspection_cpp"), nullptr);
  EXPECT_EQ(get_message_type_support_handle<std_msgs::msg::String>(), handle);
}

TEST(TypeSupport, ServiceLeadsToItsRequestAndResponse) {
  using test_interfaces::srv::AddTwoInts;
  const auto* handle = get_service_type_support_handle<AddTwoInts>();
  EXPECT_EQ(get_service_typesupport_handle(handle, typesupport_identifier), handle);
  const auto& callbacks = *static_cast<const service_type_support_callbacks_t*>(handle->data);
  EXPECT_STREQ(callbacks.service_namespace_, "test_interfaces::srv");
  EXPECT_STREQ(callbacks.service_name_, "AddTwoInts");
  EXPECT_EQ(callbacks.request_members_, get_message_type_support_handle<AddTwoInts::Request>());
  EXPECT_EQ(callbacks.response_members_, get_message_type_support_handle<AddTwoInts::Response>());
  EXPECT_EQ(handle->request_typesupport, callbacks.request_members_);
  const auto& request = *static_cast<const message_type_support_callbacks_t*>(callbacks.request_members_->data);
  EXPECT_STREQ(request.message_name_, "AddTwoInts_Request");
}

TEST(TypeSupport, ConstantsOfShippedPackagesAreThoseOfRos2) {
  using type_description_interfaces::msg::FieldType;
  EXPECT_EQ(FieldType::FIELD_TYPE_BOUNDED_WSTRING, 22);
  EXPECT_EQ(FieldType::FIELD_TYPE_NESTED_TYPE_ARRAY, 49);
  EXPECT_EQ(FieldType::FIELD_TYPE_INT8_BOUNDED_SEQUENCE, 98);
  EXPECT_EQ(FieldType::FIELD_TYPE_BOUNDED_WSTRING_UNBOUNDED_SEQUENCE, 166);
  using lifecycle_msgs::msg::Transition;
  EXPECT_EQ(Transition::TRANSITION_ON_DEACTIVATE_FAILURE, 41);
  EXPECT_EQ(Transition::TRANSITION_ON_ERROR_ERROR, 62);
  EXPECT_TRUE(type_description_interfaces::srv::GetTypeDescription::Request().include_type_sources);
}

}  // namespace
