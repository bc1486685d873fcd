// SPDX-License-Identifier: Apache-2.0
// The descriptions that a node gives of the types that it uses.
#include <rmw/type_description.h>

#include <example_interfaces/srv/add_two_ints.hpp>
#include <std_msgs/msg/header.hpp>
#include <std_msgs/msg/string.hpp>
#include <type_description_interfaces/msg/field_type.hpp>
#include <type_description_interfaces/srv/get_type_description.hpp>

#include "tests/unit/rclcpp/ros_test.hpp"

namespace {

using example_interfaces::srv::AddTwoInts;
using type_description_interfaces::msg::FieldType;
using type_description_interfaces::srv::GetTypeDescription;
using Names = std::vector<std::string>;

// The hashes that every ROS 2 system has.
constexpr const char* kStringHash = "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18";
constexpr const char* kAddTwoIntsHash = "RIHS01_e118de6bf5eeb66a2491b5bda11202e7b68f198d6f67922cf30364858239c81a";

class TypeDescription : public RosTest {
 protected:
  TypeDescription() { executor_.add_node(node_); }

  // The answer of /ns/node.
  GetTypeDescription::Response::SharedPtr ask(const std::string& type_hash, bool with_sources = true) {
    const auto client = node_->create_client<GetTypeDescription>("/ns/node/get_type_description");
    EXPECT_TRUE(client->wait_for_service(kPatience));
    auto request = std::make_shared<GetTypeDescription::Request>();
    request->type_hash = type_hash;
    request->include_type_sources = with_sources;
    auto future = client->async_send_request(request);
    EXPECT_EQ(executor_.spin_until_future_complete(future, kPatience), rclcpp::FutureReturnCode::SUCCESS);
    return future.get();
  }

  rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("node", "ns");
  rclcpp::executors::SingleThreadedExecutor executor_;
};

template <typename ItemsT>
Names type_names(const ItemsT& items) {
  Names names;
  for (const auto& item : items) {
    names.push_back(item.type_name);
  }
  return names;
}

TEST_F(TypeDescription, MessageOfAPublisherIsDescribedWithItsSource) {
  const auto publisher = node_->create_publisher<std_msgs::msg::String>("topic", 1);
  const auto answer = ask(kStringHash);
  ASSERT_TRUE(answer->successful) << answer->failure_reason;
  const auto& type = answer->type_description.type_description;
  EXPECT_EQ(type.type_name, "std_msgs/msg/String");
  ASSERT_EQ(type.fields.size(), 1u);
  EXPECT_EQ(type.fields[0].name, "data");
  EXPECT_EQ(type.fields[0].type.type_id, FieldType::FIELD_TYPE_STRING);
  EXPECT_TRUE(answer->type_description.referenced_type_descriptions.empty());
  ASSERT_EQ(answer->type_sources.size(), 1u);
  EXPECT_EQ(answer->type_sources[0].type_name, "std_msgs/msg/String");
  EXPECT_EQ(answer->type_sources[0].encoding, "msg");
  EXPECT_NE(answer->type_sources[0].raw_file_contents.find("string data\n"), std::string::npos);
}

TEST_F(TypeDescription, MessagesWithinAreDescribedByName) {
  const auto subscription =
      node_->create_subscription<std_msgs::msg::Header>("topic", 1, [](const std_msgs::msg::Header&) {});
  const auto answer = ask(rmw_message_type_description(&subscription->get_message_type_support_handle())->type_hash);
  ASSERT_TRUE(answer->successful) << answer->failure_reason;
  const auto& fields = answer->type_description.type_description.fields;
  ASSERT_EQ(fields.size(), 2u);
  EXPECT_EQ(fields[0].type.type_id, FieldType::FIELD_TYPE_NESTED_TYPE);
  EXPECT_EQ(fields[0].type.nested_type_name, "builtin_interfaces/msg/Time");
  EXPECT_EQ(type_names(answer->type_description.referenced_type_descriptions), Names{"builtin_interfaces/msg/Time"});
  EXPECT_EQ(type_names(answer->type_sources), (Names{"std_msgs/msg/Header", "builtin_interfaces/msg/Time"}));
}

TEST_F(TypeDescription, ServiceIsAnInterfaceOfThreeMessages) {
  const auto client = node_->create_client<AddTwoInts>("add");
  const auto answer = ask(kAddTwoIntsHash);
  ASSERT_TRUE(answer->successful) << answer->failure_reason;
  EXPECT_EQ(answer->type_description.type_description.type_name, "example_interfaces/srv/AddTwoInts");
  EXPECT_EQ(type_names(answer->type_description.referenced_type_descriptions),
            (Names{"builtin_interfaces/msg/Time", "example_interfaces/srv/AddTwoInts_Event",
                   "example_interfaces/srv/AddTwoInts_Request", "example_interfaces/srv/AddTwoInts_Response",
                   "service_msgs/msg/ServiceEventInfo"}));
  EXPECT_EQ(answer->type_sources.at(0).encoding, "srv");
  EXPECT_EQ(answer->type_sources.at(2).encoding, "implicit");
  EXPECT_EQ(answer->type_sources.at(2).raw_file_contents, "");
}

TEST_F(TypeDescription, DefaultsOfFieldsAreTold) {
  const auto* type =
      rmw_service_type_description(rosidl_typesupport_cpp::get_service_type_support_handle<GetTypeDescription>());
  const auto answer = ask(type->type_hash, false);  // the service of the node itself
  ASSERT_TRUE(answer->successful) << answer->failure_reason;
  EXPECT_TRUE(answer->type_sources.empty());
  for (const auto& described : answer->type_description.referenced_type_descriptions) {
    if (described.type_name == "type_description_interfaces/srv/GetTypeDescription_Request") {
      EXPECT_EQ(described.fields.at(2).name, "include_type_sources");
      EXPECT_EQ(described.fields.at(2).default_value, "True");
      return;
    }
  }
  FAIL() << "the request is not described";
}

TEST_F(TypeDescription, OnlyTypesInUseAreKnown) {
  EXPECT_EQ(ask(kStringHash)->failure_reason, "Type not currently in use by this node");
  auto one = node_->create_publisher<std_msgs::msg::String>("topic", 1);
  auto other = node_->create_publisher<std_msgs::msg::String>("other", 1);
  one.reset();
  EXPECT_TRUE(ask(kStringHash)->successful);
  other.reset();
  EXPECT_FALSE(ask(kStringHash)->successful);
}

TEST_F(TypeDescription, WhatIsNoHashIsRefused) {
  for (const std::string text : {"", "std_msgs/msg/String", "RIHS01_df", "RIHS02_"}) {
    const auto answer = ask(text);
    EXPECT_FALSE(answer->successful) << text;
    EXPECT_EQ(answer->failure_reason, "Failed to parse type hash") << text;
  }
}

}  // namespace
