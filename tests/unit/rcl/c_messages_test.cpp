// SPDX-License-Identifier: Apache-2.0
// What a client library with messages of C does with rcl, as rclpy does: its messages beside those of C++ in one
// process, the service of type descriptions, loggers below a node's, the graph without discovery.
#include <algorithm>
#include <cstdlib>
#include <memory>

#include "rcl_interfaces/msg/log.h"
#include "rcl_test.hpp"
#include "rosidl_runtime_c/string_functions.h"
#include "rosidl_typesupport_cpp/message_type_support.hpp"
#include "std_msgs/msg/header.h"
#include "std_msgs/msg/string.h"
#include "std_msgs/msg/string.hpp"
#include "tests/support/sandbox.hpp"
#include "type_description_interfaces/srv/get_type_description.h"

namespace {

using rcl_test::Context;
using rcl_test::kPatience;
using rcl_test::Node;
using rcl_test::take_error;

using Request = type_description_interfaces__srv__GetTypeDescription_Request;
using Response = type_description_interfaces__srv__GetTypeDescription_Response;

class CMessages : public testing::Test {
 protected:
  void subscribe(Context& context, Node& node, const rosidl_message_type_support_t* type, const char* topic,
                 const rmw_qos_profile_t& qos = rmw_qos_profile_default) {
    rcl_subscription_options_t options = rcl_subscription_get_default_options();
    options.qos = qos;
    ASSERT_EQ(rcl_subscription_init(&subscription_, &node.handle, type, topic, &options), RCL_RET_OK) << take_error();
    ASSERT_EQ(rcl_wait_set_init(&wait_set_, 1, 0, 0, 0, 0, 0, &context.handle, rcl_get_default_allocator()),
              RCL_RET_OK);
  }
  void take(void* message) {
    ASSERT_EQ(rcl_wait_set_clear(&wait_set_), RCL_RET_OK);
    ASSERT_EQ(rcl_wait_set_add_subscription(&wait_set_, &subscription_, nullptr), RCL_RET_OK);
    ASSERT_EQ(rcl_wait(&wait_set_, kPatience), RCL_RET_OK) << take_error();
    ASSERT_EQ(rcl_take(&subscription_, message, nullptr, nullptr), RCL_RET_OK) << take_error();
  }
  void end_subscription(Node& node) {
    EXPECT_EQ(rcl_wait_set_fini(&wait_set_), RCL_RET_OK);
    EXPECT_EQ(rcl_subscription_fini(&subscription_, &node.handle), RCL_RET_OK);
  }

  test_support::Sandbox sandbox_;
  rcl_subscription_t subscription_ = rcl_get_zero_initialized_subscription();
  rcl_wait_set_t wait_set_ = rcl_get_zero_initialized_wait_set();
};

// Fast DDS knows one type of a name, which the first endpoint has brought.
TEST_F(CMessages, ComeFromAPublisherOfCppInTheSameProcess) {
  Context context;
  Node node(context, "node");
  rcl_publisher_t publisher = rcl_get_zero_initialized_publisher();
  const rcl_publisher_options_t options = rcl_publisher_get_default_options();
  ASSERT_EQ(rcl_publisher_init(&publisher, &node.handle,
                               rosidl_typesupport_cpp::get_message_type_support_handle<std_msgs::msg::String>(),
                               "chatter", &options),
            RCL_RET_OK);
  subscribe(context, node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, String), "chatter");
  std_msgs::msg::String sent;
  sent.data = "a text that is longer than a short string";
  ASSERT_EQ(rcl_publish(&publisher, &sent, nullptr), RCL_RET_OK);
  const std::unique_ptr<std_msgs__msg__String, void (*)(std_msgs__msg__String*)> received(
      std_msgs__msg__String__create(), std_msgs__msg__String__destroy);
  take(received.get());
  EXPECT_STREQ(received->data.data, sent.data.c_str());
  end_subscription(node);
  EXPECT_EQ(rcl_publisher_fini(&publisher, &node.handle), RCL_RET_OK);
}

TEST_F(CMessages, ReachLocalEndpointsWithoutDiscovery) {
  setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "OFF", 1);
  Context context;
  unsetenv("ROS_AUTOMATIC_DISCOVERY_RANGE");
  Node node(context, "node");
  Context other_context;
  Node other_node(other_context, "other_node");
  rcl_publisher_t publisher = rcl_get_zero_initialized_publisher();
  const rcl_publisher_options_t options = rcl_publisher_get_default_options();
  const rosidl_message_type_support_t* type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, String);
  ASSERT_EQ(rcl_publisher_init(&publisher, &node.handle, type, "chatter", &options), RCL_RET_OK);
  subscribe(context, node, type, "chatter");
  const std::unique_ptr<std_msgs__msg__String, void (*)(std_msgs__msg__String*)> message(
      std_msgs__msg__String__create(), std_msgs__msg__String__destroy);
  ASSERT_EQ(rcl_publish(&publisher, message.get(), nullptr), RCL_RET_OK);
  take(message.get());
  size_t count = 99;
  ASSERT_EQ(rcl_count_publishers(&other_node.handle, "/chatter", &count), RCL_RET_OK);
  EXPECT_EQ(count, 0u);
  end_subscription(node);
  EXPECT_EQ(rcl_publisher_fini(&publisher, &node.handle), RCL_RET_OK);
}

TEST_F(CMessages, DescribeTheTypesOfANode) {
  Context context;
  Node node(context, "node", "/ns");
  rcl_service_t service = rcl_get_zero_initialized_service();
  ASSERT_EQ(rcl_node_type_description_service_init(&service, &node.handle), RCL_RET_OK) << take_error();
  EXPECT_STREQ(rcl_service_get_service_name(&service), "/ns/node/get_type_description");
  subscribe(context, node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Header), "header");
  rcl_topic_endpoint_info_array_t infos = rcl_get_zero_initialized_topic_endpoint_info_array();
  rcl_allocator_t allocator = rcl_get_default_allocator();
  ASSERT_EQ(rcl_get_subscriptions_info_by_topic(&node.handle, &allocator, "/ns/header", false, &infos), RCL_RET_OK);
  ASSERT_EQ(infos.size, 1u);
  char* hash = nullptr;
  ASSERT_EQ(rosidl_stringify_type_hash(&infos.info_array[0].topic_type_hash, allocator, &hash), RCUTILS_RET_OK);
  ASSERT_EQ(rcl_topic_endpoint_info_array_fini(&infos, &allocator), RCL_RET_OK);

  const std::unique_ptr<Request, void (*)(Request*)> request(
      type_description_interfaces__srv__GetTypeDescription_Request__create(),
      type_description_interfaces__srv__GetTypeDescription_Request__destroy);
  ASSERT_TRUE(rosidl_runtime_c__String__assign(&request->type_hash, hash));
  allocator.deallocate(hash, allocator.state);
  const rmw_request_id_t id{};
  Response response;  // its memory comes from the call
  rcl_node_type_description_service_handle_request(&node.handle, &id, request.get(), &response);
  EXPECT_TRUE(response.successful) << response.failure_reason.data;
  const auto& described = response.type_description.type_description;
  EXPECT_STREQ(described.type_name.data, "std_msgs/msg/Header");
  ASSERT_EQ(described.fields.size, 2u);
  EXPECT_STREQ(described.fields.data[0].type.nested_type_name.data, "builtin_interfaces/msg/Time");
  ASSERT_EQ(response.type_description.referenced_type_descriptions.size, 1u);
  ASSERT_EQ(response.type_sources.size, 2u);
  EXPECT_STREQ(response.type_sources.data[1].type_name.data, "builtin_interfaces/msg/Time");
  type_description_interfaces__srv__GetTypeDescription_Response__fini(&response);

  ASSERT_TRUE(rosidl_runtime_c__String__assign(&request->type_hash, "RIHS01_"));
  rcl_node_type_description_service_handle_request(&node.handle, &id, request.get(), &response);
  EXPECT_FALSE(response.successful);
  EXPECT_STREQ(response.failure_reason.data, "Failed to parse type hash");
  type_description_interfaces__srv__GetTypeDescription_Response__fini(&response);
  end_subscription(node);
  EXPECT_EQ(rcl_service_fini(&service, &node.handle), RCL_RET_OK);
}

TEST_F(CMessages, TellWhatLoggersBelowThatOfANodeLog) {
  Context context;
  const rcl_allocator_t allocator = rcl_get_default_allocator();
  ASSERT_EQ(rcl_logging_configure(&context.handle.global_arguments, &allocator), RCL_RET_OK);
  {
    Node node(context, "talker", "/ns");
    EXPECT_EQ(rcl_logging_rosout_add_sublogger("ns.nobody", "child"), RCL_RET_NOT_FOUND);
    EXPECT_EQ(take_error(), "no node has logger 'ns.nobody'");
    EXPECT_EQ(rcl_logging_rosout_add_sublogger("ns.talker", "child"), RCL_RET_OK);
    EXPECT_EQ(rcl_logging_rosout_add_sublogger("ns.talker", "child"), RCL_RET_OK);
    EXPECT_EQ(rcl_logging_rosout_add_sublogger("ns.talker.child", "grandchild"), RCL_RET_OK);
    testing::internal::CaptureStderr();
    rcutils_log(nullptr, RCUTILS_LOG_SEVERITY_WARN, "ns.talker.child.grandchild", "hello");
    testing::internal::GetCapturedStderr();
    subscribe(context, node, ROSIDL_GET_MSG_TYPE_SUPPORT(rcl_interfaces, msg, Log), "/rosout",
              rmw_qos_profile_rosout_default);
    const std::unique_ptr<rcl_interfaces__msg__Log, void (*)(rcl_interfaces__msg__Log*)> log(
        rcl_interfaces__msg__Log__create(), rcl_interfaces__msg__Log__destroy);
    take(log.get());
    EXPECT_STREQ(log->name.data, "ns.talker.child.grandchild");
    EXPECT_STREQ(log->msg.data, "hello");
    end_subscription(node);
    EXPECT_EQ(rcl_logging_rosout_remove_sublogger("ns.talker.child", "grandchild"), RCL_RET_OK);
    EXPECT_EQ(rcl_logging_rosout_remove_sublogger("ns.talker", "child"), RCL_RET_OK);
    EXPECT_EQ(rcl_logging_rosout_remove_sublogger("ns.talker", "child"), RCL_RET_OK);
    EXPECT_EQ(rcl_logging_rosout_remove_sublogger("ns.talker", "child"), RCL_RET_NOT_FOUND);
    EXPECT_EQ(take_error(), "logger 'ns.talker.child' is not in use");
  }
  EXPECT_EQ(rcl_logging_fini(), RCL_RET_OK);
}

TEST_F(CMessages, NamesOfNodesComeWithTheirEnclaves) {
  Context context({"program", "--ros-args", "-e", "/cell"});
  Node node(context, "node", "/ns");
  rcutils_string_array_t names = rcutils_get_zero_initialized_string_array();
  rcutils_string_array_t namespaces = rcutils_get_zero_initialized_string_array();
  rcutils_string_array_t enclaves = rcutils_get_zero_initialized_string_array();
  ASSERT_EQ(rcl_get_node_names_with_enclaves(&node.handle, rcl_get_default_allocator(), &names, &namespaces, &enclaves),
            RCL_RET_OK);
  ASSERT_EQ(names.size, 1u);
  EXPECT_STREQ(names.data[0], "node");
  EXPECT_STREQ(namespaces.data[0], "/ns");
  EXPECT_STREQ(enclaves.data[0], "/cell");
  for (rcutils_string_array_t* array : {&names, &namespaces, &enclaves}) {
    EXPECT_EQ(rcutils_string_array_fini(array), RCUTILS_RET_OK);
  }
}

}  // namespace
