// SPDX-License-Identifier: Apache-2.0
// The messages that describe the calls of a service.
#include <gtest/gtest.h>

#include <rosidl_typesupport_cpp/service_type_support.hpp>
#include <stdexcept>
#include <type_traits>

#include "cdr_bytes.hpp"
#include "service_msgs/msg/service_event_info.hpp"
#include "test_interfaces/srv/add_two_ints.hpp"

namespace {

using service_msgs::msg::ServiceEventInfo;
using test_interfaces::srv::AddTwoInts;

rosidl_service_introspection_info_t some_info(uint8_t event_type) {
  rosidl_service_introspection_info_t info{};
  info.event_type = event_type;
  info.stamp_sec = 3;
  info.stamp_nanosec = 4;
  for (uint8_t i = 0; i < 16; ++i) {
    info.client_gid[i] = static_cast<uint8_t>(0xf0 + i);
  }
  info.sequence_number = 5;
  return info;
}

// Made as by code that knows the type only by its handle.
AddTwoInts::Event make_event(uint8_t event_type, const AddTwoInts::Request* request,
                             const AddTwoInts::Response* response) {
  const auto* handle = rosidl_typesupport_cpp::get_service_type_support_handle<AddTwoInts>();
  const rosidl_service_introspection_info_t info = some_info(event_type);
  void* made = handle->event_message_create_handle_function(&info, request, response);
  AddTwoInts::Event event = *static_cast<AddTwoInts::Event*>(made);
  handle->event_message_destroy_handle_function(made);
  return event;
}

AddTwoInts::Request some_request() {
  AddTwoInts::Request request;
  request.a = 1;
  request.b = 2;
  return request;
}

TEST(ServiceEvent, HasAtMostOneRequestAndOneResponse) {
  AddTwoInts::Event event;
  EXPECT_TRUE((std::is_same_v<decltype(event.info), ServiceEventInfo>));
  EXPECT_TRUE((std::is_same_v<AddTwoInts::Event, test_interfaces::srv::AddTwoInts_Event>));
  EXPECT_EQ(event.request.max_size(), 1u);
  EXPECT_EQ(event.response.max_size(), 1u);
  event.request.resize(1);
  EXPECT_THROW(event.request.push_back(some_request()), std::length_error);
}

TEST(ServiceEvent, IsMadeOfInfoAndWhatThereIsOfTheCall) {
  const AddTwoInts::Request request = some_request();
  const AddTwoInts::Event sent = make_event(ServiceEventInfo::REQUEST_SENT, &request, nullptr);
  EXPECT_EQ(sent.info.event_type, ServiceEventInfo::REQUEST_SENT);
  EXPECT_EQ(sent.info.stamp.sec, 3);
  EXPECT_EQ(sent.info.stamp.nanosec, 4u);
  EXPECT_EQ(sent.info.client_gid.front(), 0xf0);
  EXPECT_EQ(sent.info.client_gid.back(), 0xff);
  EXPECT_EQ(sent.info.sequence_number, 5);
  ASSERT_EQ(sent.request.size(), 1u);
  EXPECT_EQ(sent.request[0], request);
  EXPECT_TRUE(sent.response.empty());

  AddTwoInts::Response response;
  response.sum = 6;
  const AddTwoInts::Event answered = make_event(ServiceEventInfo::RESPONSE_SENT, nullptr, &response);
  EXPECT_TRUE(answered.request.empty());
  ASSERT_EQ(answered.response.size(), 1u);
  EXPECT_EQ(answered.response[0], response);
}

TEST(ServiceEvent, IsComparedWithItsContents) {
  const AddTwoInts::Request request = some_request();
  AddTwoInts::Event one = make_event(ServiceEventInfo::REQUEST_RECEIVED, &request, nullptr);
  const AddTwoInts::Event other = one;
  EXPECT_EQ(one, other);
  one.request[0].b = 7;
  EXPECT_NE(one, other);
  one = other;
  one.info.client_gid[3] = 0;
  EXPECT_NE(one, other);
}

TEST(ServiceEvent, IsPrintedAsYaml) {
  const AddTwoInts::Request request = some_request();
  const AddTwoInts::Event event = make_event(ServiceEventInfo::REQUEST_RECEIVED, &request, nullptr);
  EXPECT_EQ(to_yaml(event, true),
            "{info: {event_type: 1, stamp: {sec: 3, nanosec: 4}, client_gid: [240, 241, 242, 243, 244, 245, 246, 247, "
            "248, 249, 250, 251, 252, 253, 254, 255], sequence_number: 5}, request: [{a: 1, b: 2}], response: []}");
}

TEST(ServiceEvent, HasTheBytesOfItsMembers) {
  const AddTwoInts::Request request = some_request();
  const AddTwoInts::Event event = make_event(ServiceEventInfo::RESPONSE_RECEIVED, &request, nullptr);
  const std::vector<char> bytes = bytes_of(
      "03 00 00 00  03 00 00 00 04 00 00 00  f0 f1 f2 f3 f4 f5 f6 f7 f8 f9 fa fb fc fd fe ff  00 00 00 00"
      "05 00 00 00 00 00 00 00  01 00 00 00 00 00 00 00  01 00 00 00 00 00 00 00 02 00 00 00 00 00 00 00  00 00 00 00");
  EXPECT_EQ(serialized(event), text_of(bytes.data(), bytes.size()));
  AddTwoInts::Event read;
  EXPECT_TRUE(deserialize(bytes, read));
  EXPECT_EQ(read, event);
  std::vector<char> two_requests = bytes;
  two_requests[40] = 2;
  EXPECT_FALSE(deserialize(two_requests, read));
}

TEST(ServiceEvent, TypeSupportIsThatOfAMessage) {
  const auto* handle = rosidl_typesupport_cpp::get_service_type_support_handle<AddTwoInts>();
  EXPECT_EQ(handle->event_typesupport, rosidl_typesupport_cpp::get_message_type_support_handle<AddTwoInts::Event>());
  EXPECT_STREQ(callbacks<AddTwoInts::Event>().message_namespace_, "test_interfaces::srv");
  EXPECT_STREQ(callbacks<AddTwoInts::Event>().message_name_, "AddTwoInts_Event");
  EXPECT_STREQ(rosidl_generator_traits::name<AddTwoInts::Event>(), "test_interfaces/srv/AddTwoInts_Event");
  EXPECT_TRUE(rosidl_generator_traits::is_message<AddTwoInts::Event>::value);
  EXPECT_FALSE(rosidl_generator_traits::has_fixed_size<AddTwoInts::Event>::value);
  EXPECT_TRUE(rosidl_generator_traits::has_bounded_size<AddTwoInts::Event>::value);
}

}  // namespace
