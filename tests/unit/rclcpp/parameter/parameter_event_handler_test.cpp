// SPDX-License-Identifier: Apache-2.0
// Changes of parameters, received by another node.
#include "rclcpp/parameter_event_handler.hpp"

#include "tests/unit/rclcpp/ros_test.hpp"

namespace {

using rcl_interfaces::msg::ParameterEvent;
using Strings = std::vector<std::string>;

class ParameterEvents : public RosTest {
 protected:
  ParameterEvents() {
    executor_.add_node(owner_);
    executor_.add_node(hearer_);
  }

  // Spins until the expected number of changes was received.
  void expect_heard(const Strings& expected) {
    spin_until(executor_, [&] { return heard_.size() >= expected.size(); });
    EXPECT_EQ(heard_, expected);
  }

  rclcpp::Node::SharedPtr owner_ = std::make_shared<rclcpp::Node>("owner", "ns");
  rclcpp::Node::SharedPtr hearer_ = std::make_shared<rclcpp::Node>("hearer", "ns");
  rclcpp::executors::SingleThreadedExecutor executor_;
  rclcpp::ParameterEventHandler handler_{hearer_};
  Strings heard_;
};

TEST_F(ParameterEvents, OfOneParameterOfANodeAndOfAll) {
  // A name without a slash is a name in the node's own namespace.
  const auto speed = handler_.add_parameter_callback(
      "speed", [this](const rclcpp::Parameter& p) { heard_.push_back("speed=" + p.value_to_string()); }, "owner");
  const auto other = handler_.add_parameter_callback(
      "speed", [this](const rclcpp::Parameter&) { heard_.push_back("not of this node"); });
  const auto later = handler_.add_parameter_callback(
      "speed", [this](const rclcpp::Parameter&) { heard_.push_back("added last"); }, "/ns/owner");
  const auto all = handler_.add_parameter_event_callback([this](const ParameterEvent& event) {
    if (event.node != "/ns/owner") {
      return;
    }
    for (const rclcpp::Parameter& p : rclcpp::ParameterEventHandler::get_parameters_from_event(event)) {
      heard_.push_back(event.node + ": " + p.get_name());
    }
  });
  owner_->declare_parameter("speed", 1.5);
  expect_heard({"added last", "speed=1.500000", "/ns/owner: speed"});

  heard_.clear();
  handler_.remove_parameter_callback(later);
  EXPECT_THROW(handler_.remove_parameter_callback(later), std::runtime_error);
  owner_->set_parameters_atomically({rclcpp::Parameter("speed", 2.5)});
  expect_heard({"speed=2.500000", "/ns/owner: speed"});
}

TEST_F(ParameterEvents, OfChosenNodesOnly) {
  const auto other = std::make_shared<rclcpp::Node>("other", "ns");
  const auto all = handler_.add_parameter_event_callback([this](const ParameterEvent& event) {
    for (const rclcpp::Parameter& p : rclcpp::ParameterEventHandler::get_parameters_from_event(event)) {
      if (p.get_name() == "speed") {
        heard_.push_back(event.node + " " + p.value_to_string());
      }
    }
  });
  EXPECT_TRUE(handler_.configure_nodes_filter({}));
  EXPECT_TRUE(handler_.configure_nodes_filter({"owner", "/ns/third"}));
  other->declare_parameter("speed", 1);
  owner_->declare_parameter("speed", 2);
  expect_heard({"/ns/owner 2"});

  heard_.clear();
  EXPECT_TRUE(handler_.configure_nodes_filter({}));
  other->set_parameter(rclcpp::Parameter("speed", 3));
  expect_heard({"/ns/other 3"});
}

TEST_F(ParameterEvents, CannotBeChosenWithinAProcess) {
  const auto node = std::make_shared<rclcpp::Node>("inner", rclcpp::NodeOptions().use_intra_process_comms(true));
  rclcpp::ParameterEventHandler handler(node);
  EXPECT_FALSE(handler.configure_nodes_filter({"/ns/owner"}));
}

TEST(ParameterEventHandler, FindsAParameterInAnEvent) {
  ParameterEvent event;
  event.node = "/owner";
  event.changed_parameters.push_back(rclcpp::Parameter("speed", 3).to_parameter_msg());
  rclcpp::Parameter parameter;
  EXPECT_TRUE(rclcpp::ParameterEventHandler::get_parameter_from_event(event, parameter, "speed", "/owner"));
  EXPECT_EQ(parameter.as_int(), 3);
  EXPECT_FALSE(rclcpp::ParameterEventHandler::get_parameter_from_event(event, parameter, "speed", "/other"));
  EXPECT_EQ(rclcpp::ParameterEventHandler::get_parameter_from_event(event, "height", "/owner"),
            rclcpp::Parameter("height", rclcpp::PARAMETER_NOT_SET));
  try {
    rclcpp::ParameterEventHandler::get_parameter_from_event(event, "height", "/other");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(
        error.what(),
        "The node name '/other' of parameter 'height' doesn't match the node name '/owner' in parameter event");
  }
}

// A callback that takes the event itself may own it.
TEST_F(ParameterEvents, OfAParameterClient) {
  rclcpp::AsyncParametersClient client(hearer_, "/ns/owner");
  const auto subscription = client.on_parameter_event([this](ParameterEvent::UniquePtr event) {
    for (const auto& parameter : event->new_parameters) {
      if (event->node == "/ns/owner") {
        heard_.push_back(parameter.name);
      }
    }
  });
  owner_->declare_parameter("height", 1);
  expect_heard({"height"});
}

}  // namespace
