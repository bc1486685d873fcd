// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <example_interfaces/srv/add_two_ints.hpp>
#include <memory>
#include <std_msgs/msg/string.hpp>

#include "tests/unit/rclcpp/ros_test.hpp"

using std_msgs::msg::String;

namespace {

class SubNodeTest : public RosTest {
 protected:
  rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("node", "/outer");
};

TEST_F(SubNodeTest, ExtendsRelativeNamesOnly) {
  const auto inner = node_->create_sub_node("inner");
  EXPECT_STREQ(inner->get_fully_qualified_name(), "/outer/node");
  EXPECT_EQ(inner->get_sub_namespace(), "inner");
  EXPECT_EQ(inner->get_effective_namespace(), "/outer/inner");
  EXPECT_STREQ(inner->create_publisher<String>("topic", 10)->get_topic_name(), "/outer/inner/topic");
  EXPECT_STREQ(inner->create_publisher<String>("/topic", 10)->get_topic_name(), "/topic");
  EXPECT_STREQ(inner->create_publisher<String>("~/topic", 10)->get_topic_name(), "/outer/node/topic");
  EXPECT_STREQ(inner->create_subscription<String>("topic", 10, [](const String&) {})->get_topic_name(),
               "/outer/inner/topic");
  EXPECT_STREQ(inner->create_client<example_interfaces::srv::AddTwoInts>("add")->get_service_name(),
               "/outer/inner/add");
  EXPECT_EQ(node_->get_effective_namespace(), "/outer");
  EXPECT_EQ(node_->get_sub_namespace(), "");
}

TEST_F(SubNodeTest, SubNodesHaveSubNodesAndOutliveTheirNode) {
  auto deepest = node_->create_sub_node("a")->create_sub_node("b/");
  node_.reset();
  EXPECT_EQ(deepest->get_sub_namespace(), "a/b");
  EXPECT_STREQ(deepest->create_publisher<String>("topic", 10)->get_topic_name(), "/outer/a/b/topic");
}

TEST_F(SubNodeTest, RefusesNamesThatAreNone) {
  const auto error_of = [this](const std::string& sub_namespace) {
    try {
      node_->create_sub_node(sub_namespace);
    } catch (const rclcpp::exceptions::NameValidationError& error) {
      return std::string(error.what());
    }
    return std::string("no exception");
  };
  EXPECT_EQ(error_of("/inner"),
            "Invalid sub_namespace: a sub-namespace should not have a leading /:\n  '/inner'\n   ^\n");
  EXPECT_EQ(error_of(""),
            "Invalid sub_namespace: sub-nodes should not extend nodes by an empty sub-namespace:\n  ''\n   ^\n");
  EXPECT_THROW(node_->create_sub_node("in ner"), rclcpp::exceptions::InvalidNamespaceError);
}

}  // namespace
