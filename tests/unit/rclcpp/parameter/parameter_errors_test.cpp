// SPDX-License-Identifier: Apache-2.0
// What a wrong use of parameters throws or answers, beside what rclcpp throws and answers (docs/compatibility.md has
// the table).
#include <gmock/gmock.h>

#include <memory>
#include <rclcpp/copy_all_parameter_values.hpp>
#include <rclcpp/function_traits.hpp>
#include <rclcpp/parameter_events_filter.hpp>
#include <string>
#include <vector>

#include "tests/unit/rclcpp/ros_test.hpp"

namespace {

using rcl_interfaces::msg::ParameterDescriptor;
using rcl_interfaces::msg::ParameterEvent;
using rclcpp::Parameter;
using rclcpp::ParameterValue;
using testing::ElementsAre;

ParameterDescriptor dynamic_typing() {
  ParameterDescriptor descriptor;
  descriptor.dynamic_typing = true;
  return descriptor;
}

std::vector<std::string> names_of(const std::vector<rcl_interfaces::msg::Parameter>& parameters) {
  std::vector<std::string> names;
  for (const auto& parameter : parameters) {
    names.push_back(parameter.name);
  }
  return names;
}

namespace traits = rclcpp::function_traits;
const auto bound_to_two = [](int, const std::string&) { return 1.0; };
static_assert(traits::function_traits<decltype(bound_to_two)>::arity == 2);
static_assert(std::is_same_v<traits::function_traits<decltype(bound_to_two)>::return_type, double>);
static_assert(traits::check_arguments<void (*)(int, char), int, char>::value);
static_assert(traits::same_arguments<decltype(bound_to_two), void(int, const std::string&)>::value);

class ParameterErrors : public RosTest {};

TEST_F(ParameterErrors, AValueReadAsAnotherTypeSaysBothTypes) {
  const Parameter parameter("count", 3);
  using rclcpp::ParameterTypeException;
  EXPECT_EQ(error_of<ParameterTypeException>([&] { (void)parameter.as_bool(); }), "expected [bool] got [integer]");
  EXPECT_EQ(error_of<ParameterTypeException>([&] { (void)parameter.as_double(); }), "expected [double] got [integer]");
  EXPECT_EQ(error_of<ParameterTypeException>([&] { (void)Parameter("unset").as_string_array(); }),
            "expected [string_array] got [not set]");
  EXPECT_EQ(error_of<rclcpp::exceptions::InvalidParameterTypeException>([&] { (void)parameter.get_value<bool>(); }),
            "parameter 'count' has invalid type: expected [bool] got [integer]");
}

TEST_F(ParameterErrors, GettingATypedValueNamesTheParameter) {
  rclcpp::Node node("node");
  node.declare_parameter("count", 3);
  using rclcpp::exceptions::InvalidParameterTypeException;
  const std::string wrong = "parameter 'count' has invalid type: expected [string] got [integer]";
  std::string value;
  EXPECT_EQ(error_of<InvalidParameterTypeException>([&] { node.get_parameter("count", value); }), wrong);
  EXPECT_EQ(error_of<InvalidParameterTypeException>([&] { node.get_parameter_or("count", value, value); }), wrong);
  EXPECT_EQ(error_of<rclcpp::exceptions::ParameterNotDeclaredException>([&] { node.get_parameter("none"); }), "none");
}

TEST_F(ParameterErrors, DeclaringByTypeNeedsAnOverride) {
  rclcpp::Node node("node");
  EXPECT_EQ(error_of<rclcpp::exceptions::UninitializedStaticallyTypedParameterException>(
                [&] { node.declare_parameter<int>("speed"); }),
            "Statically typed parameter 'speed' must be initialized.");
  EXPECT_EQ(error_of<rclcpp::exceptions::ParameterUninitializedException>([&] { node.get_parameter("speed"); }),
            "parameter 'speed' is not initialized");
  EXPECT_EQ(error_of<rclcpp::exceptions::InvalidParameterTypeException>(
                [&] { node.declare_parameter("nothing", ParameterValue()); }),
            "parameter 'nothing' has invalid type: cannot declare a statically typed parameter with an uninitialized "
            "value");
  EXPECT_EQ(error_of<std::invalid_argument>([&] { node.declare_parameter("x", rclcpp::PARAMETER_NOT_SET); }),
            "declare_parameter(): the provided parameter type cannot be rclcpp::PARAMETER_NOT_SET");
}

TEST_F(ParameterErrors, AnUnsetDynamicParameterReadsAsNotSetAndStaysDeclared) {
  rclcpp::Node node("node");
  node.declare_parameter("loose", ParameterValue(), dynamic_typing());
  EXPECT_EQ(node.get_parameter("loose").get_type(), rclcpp::PARAMETER_NOT_SET);
  EXPECT_TRUE(node.set_parameter(Parameter("loose")).successful);
  EXPECT_TRUE(node.has_parameter("loose"));

  EXPECT_TRUE(node.set_parameter(Parameter("loose", 1)).successful);
  EXPECT_TRUE(node.set_parameter(Parameter("loose")).successful);  // takes a value away: undeclares
  EXPECT_FALSE(node.has_parameter("loose"));
}

TEST_F(ParameterErrors, NamesAreCheckedBeforeValues) {
  rclcpp::Node node("node");
  node.declare_parameter("count", 3);
  EXPECT_EQ(error_of<rclcpp::exceptions::ParameterNotDeclaredException>([&] {
              node.set_parameters_atomically({Parameter("count", "three"), Parameter("none", 1)});
            }),
            "parameter 'none' cannot be set because it was not declared");
  EXPECT_EQ(error_of<rclcpp::exceptions::InvalidParametersException>([&] { node.set_parameter(Parameter("", 1)); }),
            "parameter name must not be empty");
  EXPECT_EQ(node.set_parameter(Parameter("count")).reason, "cannot undeclare a statically typed parameter");
  EXPECT_EQ(node.set_parameters_atomically({}).reason,
            "parameter list cannot be empty, this might be due to pre_set_parameters_callback modifying the original "
            "parameters list.");
  EXPECT_EQ(node.get_parameter("count").as_int(), 3);
}

TEST_F(ParameterErrors, RemovingACallbackTwiceSaysWhichKind) {
  rclcpp::Node node("node");
  const auto pre = node.add_pre_set_parameters_callback([](std::vector<Parameter>&) {});
  const auto post = node.add_post_set_parameters_callback([](const std::vector<Parameter>&) {});
  node.remove_pre_set_parameters_callback(pre.get());
  node.remove_post_set_parameters_callback(post.get());
  EXPECT_EQ(error_of<std::runtime_error>([&] { node.remove_pre_set_parameters_callback(pre.get()); }),
            "Pre set parameter callback doesn't exist");
  EXPECT_EQ(error_of<std::runtime_error>([&] { node.remove_post_set_parameters_callback(post.get()); }),
            "Post set parameter callback doesn't exist");
}

TEST_F(ParameterErrors, ParametersAreDeclaredInGroupsWithDescriptors) {
  rclcpp::Node node("node");
  ParameterDescriptor descriptor;
  descriptor.description = "how fast";
  const std::map<std::string, std::pair<double, ParameterDescriptor>> group = {{"speed", {1.5, descriptor}}};
  EXPECT_THAT(node.declare_parameters("motor", group), ElementsAre(1.5));
  EXPECT_EQ(node.describe_parameter("motor.speed").description, "how fast");
}

TEST_F(ParameterErrors, ListsOfParametersAreJson) {
  const std::vector<Parameter> parameters = {Parameter("a", 1), Parameter("b", "x")};
  EXPECT_EQ(std::to_string(parameters[0]), "{\"name\": \"a\", \"type\": \"integer\", \"value\": \"1\"}");
  EXPECT_EQ(std::to_string(parameters),
            "{\"a\": {\"type\": \"integer\", \"value\": \"1\"}, \"b\": {\"type\": \"string\", \"value\": \"x\"}}");
}

TEST_F(ParameterErrors, ParametersAreCopiedToAnotherNode) {
  const auto from = std::make_shared<rclcpp::Node>("from");
  const auto to = std::make_shared<rclcpp::Node>("to");
  from->declare_parameter("both", 1);
  from->declare_parameter("only", "x");
  to->declare_parameter("both", 2);
  rclcpp::copy_all_parameter_values(from, to);
  EXPECT_EQ(to->get_parameter("both").as_int(), 2);
  EXPECT_EQ(to->get_parameter("only").as_string(), "x");
  rclcpp::copy_all_parameter_values(from, to, true);
  EXPECT_EQ(to->get_parameter("both").as_int(), 1);
}

TEST_F(ParameterErrors, AFilterFindsTheWantedChangesOfAnEvent) {
  auto event = std::make_shared<ParameterEvent>();
  event->new_parameters.push_back(Parameter("a", 1).to_parameter_msg());
  event->changed_parameters.push_back(Parameter("b", 1).to_parameter_msg());
  event->deleted_parameters.push_back(Parameter("b", 1).to_parameter_msg());
  using Filter = rclcpp::ParameterEventsFilter;
  const Filter filter(event, {"a", "b"}, {Filter::EventType::NEW, Filter::EventType::DELETED});
  ASSERT_EQ(filter.get_events().size(), 2u);
  EXPECT_EQ(filter.get_events()[0].second->name, "a");
  EXPECT_EQ(filter.get_events()[1].first, Filter::EventType::DELETED);
}

TEST_F(ParameterErrors, AnEventTellsInTheOrderOfTheCall) {
  auto node = std::make_shared<rclcpp::Node>("node", rclcpp::NodeOptions().allow_undeclared_parameters(true));
  node->declare_parameter("b", 1);
  node->declare_parameter("a", 1);
  node->declare_parameter("z", 1, dynamic_typing());
  node->declare_parameter("y", 1, dynamic_typing());
  std::vector<ParameterEvent> events;
  auto observer = std::make_shared<rclcpp::Node>("observer");
  auto subscription = rclcpp::AsyncParametersClient::on_parameter_event(observer, [&](const ParameterEvent& event) {
    if (event.node == "/node") {
      events.push_back(event);
    }
  });
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(observer);
  ASSERT_TRUE(spin_until(executor, [&] { return subscription->get_publisher_count() == 2; }));
  ASSERT_TRUE(node->set_parameters_atomically({Parameter("z"), Parameter("new_2", 1), Parameter("b", 2),
                                               Parameter("new_1", 1), Parameter("a", 2), Parameter("y")})
                  .successful);
  ASSERT_TRUE(spin_until(executor, [&] { return !events.empty(); }));
  EXPECT_THAT(names_of(events[0].new_parameters), ElementsAre("new_2", "new_1"));
  EXPECT_THAT(names_of(events[0].changed_parameters), ElementsAre("b", "a"));
  EXPECT_THAT(names_of(events[0].deleted_parameters), ElementsAre("z", "y"));
}

TEST_F(ParameterErrors, TheQosOfParameterEventsIsFourParameters) {
  init({"--ros-args", "-p", "qos_overrides./parameter_events.publisher.depth:=7"});
  rclcpp::Node node("node");
  const std::string prefix = "qos_overrides./parameter_events.publisher.";
  EXPECT_EQ(node.get_parameter(prefix + "depth").as_int(), 7);
  EXPECT_EQ(node.get_parameter(prefix + "durability").as_string(), "volatile");
  EXPECT_EQ(node.get_parameter(prefix + "history").as_string(), "keep_last");
  EXPECT_EQ(node.get_parameter(prefix + "reliability").as_string(), "reliable");
  EXPECT_TRUE(node.describe_parameter(prefix + "depth").read_only);
}

}  // namespace
