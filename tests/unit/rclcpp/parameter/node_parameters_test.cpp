// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <memory>
#include <vector>

#include "tests/unit/rclcpp/ros_test.hpp"

using rclcpp::Parameter;
using testing::ElementsAre;

namespace {

using Descriptor = rcl_interfaces::msg::ParameterDescriptor;

rcl_interfaces::msg::SetParametersResult refuse(const std::string& reason) {
  rcl_interfaces::msg::SetParametersResult result;
  result.successful = reason.empty();
  result.reason = reason;
  return result;
}

class NodeParametersTest : public RosTest {};

TEST_F(NodeParametersTest, DeclareGivesTheDefaultWithoutAnOverride) {
  rclcpp::Node node("node");
  EXPECT_EQ(node.declare_parameter("count", 10), 10);
  EXPECT_EQ(node.declare_parameter("name", std::string("x")), "x");
  EXPECT_EQ(node.declare_parameter("text", "literal"), std::string("literal"));
  EXPECT_TRUE(node.has_parameter("count"));
  EXPECT_FALSE(node.has_parameter("other"));
  EXPECT_FALSE(node.get_parameter("use_sim_time").as_bool());
}

TEST_F(NodeParametersTest, OverridesComeFromTheCommandLineFilesAndOptions) {
  const std::string file = (sandbox_.directory() / "params.yaml").string();
  std::ofstream(file) << "/**:\n  ros__parameters:\n    from_file: [1, 2]\n    both: file\n"
                         "other:\n  ros__parameters:\n    not_mine: 1\n";
  init({"--ros-args", "--params-file", file.c_str(), "-p", "from_line:=2.5", "-p", "both:=line", "-p", "option:=line"});
  rclcpp::NodeOptions options;
  options.append_parameter_override("option", "program");
  rclcpp::Node node("node", options);
  EXPECT_THAT(node.declare_parameter("from_file", std::vector<int64_t>{}), ElementsAre(1, 2));
  EXPECT_EQ(node.declare_parameter("from_line", 0.0), 2.5);
  EXPECT_EQ(node.declare_parameter("both", std::string()), "line");
  EXPECT_EQ(node.declare_parameter("option", std::string()), "program");
  EXPECT_EQ(node.declare_parameter("not_mine", 0), 0);
}

TEST_F(NodeParametersTest, NodeArgumentsWinOverThoseOfTheProcess) {
  init({"--ros-args", "-p", "a:=1", "-p", "b:=1"});
  rclcpp::Node node("node", rclcpp::NodeOptions().arguments({"--ros-args", "-p", "a:=2"}));
  EXPECT_EQ(node.declare_parameter("a", 0), 2);
  EXPECT_EQ(node.declare_parameter("b", 0), 1);
  rclcpp::Node alone("alone", rclcpp::NodeOptions().use_global_arguments(false));
  EXPECT_EQ(alone.declare_parameter("b", 0), 0);
}

TEST_F(NodeParametersTest, AnOverrideOfAnotherTypeIsRefused) {
  rclcpp::Node node("node", rclcpp::NodeOptions().append_parameter_override("count", "many"));
  try {
    node.declare_parameter("count", 1);
    FAIL() << "no exception";
  } catch (const rclcpp::exceptions::InvalidParameterTypeException& error) {
    EXPECT_STREQ(error.what(),
                 "parameter 'count' has invalid type: Wrong parameter type, parameter {count} is of type {integer}, "
                 "setting it to {string} is not allowed.");
  }
  EXPECT_FALSE(node.has_parameter("count"));
}

TEST_F(NodeParametersTest, DeclaringTwiceOrWithoutANameIsRefused) {
  rclcpp::Node node("node");
  node.declare_parameter("a", 1);
  EXPECT_THROW(node.declare_parameter("a", 1), rclcpp::exceptions::ParameterAlreadyDeclaredException);
  EXPECT_THROW(node.declare_parameter("", 1), rclcpp::exceptions::InvalidParametersException);
}

TEST_F(NodeParametersTest, AParameterWithoutDefaultNeedsAnOverride) {
  rclcpp::Node node("node", rclcpp::NodeOptions().append_parameter_override("given", 4));
  EXPECT_EQ(node.declare_parameter<int>("given"), 4);
  EXPECT_THROW(node.declare_parameter<int>("missing"),
               rclcpp::exceptions::UninitializedStaticallyTypedParameterException);
  EXPECT_THROW(node.get_parameter("missing"), rclcpp::exceptions::ParameterUninitializedException);
  EXPECT_TRUE(node.set_parameter(Parameter("missing", 5)).successful);
  EXPECT_EQ(node.get_parameter("missing").as_int(), 5);
}

TEST_F(NodeParametersTest, GettingUndeclaredParametersFailsInItsOwnWayPerFunction) {
  rclcpp::Node node("node");
  EXPECT_THROW(node.get_parameter("x"), rclcpp::exceptions::ParameterNotDeclaredException);
  int value = 3;
  EXPECT_FALSE(node.get_parameter("x", value));
  EXPECT_EQ(value, 3);
  EXPECT_EQ(node.get_parameter_or("x", 7), 7);
  EXPECT_THROW(node.set_parameter(Parameter("x", 1)), rclcpp::exceptions::ParameterNotDeclaredException);
}

TEST_F(NodeParametersTest, SettingKeepsTypeRangeAndReadOnly) {
  rclcpp::Node node("node");
  Descriptor ranged;
  ranged.integer_range.resize(1);
  ranged.integer_range[0].from_value = 0;
  ranged.integer_range[0].to_value = 10;
  ranged.integer_range[0].step = 2;
  node.declare_parameter("even", 2, ranged);
  Descriptor read_only;
  read_only.read_only = true;
  node.declare_parameter("fixed", 1, read_only);

  EXPECT_TRUE(node.set_parameter(Parameter("even", 10)).successful);
  EXPECT_EQ(node.set_parameter(Parameter("even", 3)).reason, "Parameter {even} doesn't comply with integer range.");
  EXPECT_EQ(node.set_parameter(Parameter("even", "a")).reason,
            "Wrong parameter type, parameter {even} is of type {integer}, setting it to {string} is not allowed.");
  EXPECT_EQ(node.set_parameter(Parameter("fixed", 2)).reason,
            "parameter 'fixed' cannot be set because it is read-only");
  EXPECT_EQ(node.get_parameter("even").as_int(), 10);
  EXPECT_THROW(node.declare_parameter("odd", 3, ranged), rclcpp::exceptions::InvalidParameterValueException);
}

TEST_F(NodeParametersTest, EachValueOfAnArrayKeepsTheRange) {
  rclcpp::Node node("node");
  Descriptor integers;
  integers.integer_range.resize(1);
  integers.integer_range[0].from_value = 2;
  integers.integer_range[0].to_value = 10;
  integers.integer_range[0].step = 2;
  using Integers = std::vector<int64_t>;
  EXPECT_THROW(node.declare_parameter("wrong", Integers{2, 3}, integers),
               rclcpp::exceptions::InvalidParameterValueException);
  node.declare_parameter("even", Integers{2, 4}, integers);
  EXPECT_EQ(node.set_parameter(Parameter("even", Integers{2, 12})).reason,
            "Parameter {even} doesn't comply with integer range.");
  EXPECT_TRUE(node.set_parameter(Parameter("even", Integers{6, 8})).successful);
  EXPECT_TRUE(node.set_parameter(Parameter("even", Integers{})).successful);

  Descriptor doubles;
  doubles.floating_point_range.resize(1);
  doubles.floating_point_range[0].from_value = -1.0;
  doubles.floating_point_range[0].to_value = 1.0;
  using Doubles = std::vector<double>;
  node.declare_parameter("share", Doubles{0.5}, doubles);
  EXPECT_EQ(node.set_parameter(Parameter("share", Doubles{0.0, std::nan("")})).reason,
            "Parameter {share} doesn't comply with floating point range.");
  EXPECT_TRUE(node.set_parameter(Parameter("share", Doubles{-1.0, 1.0})).successful);
}

TEST_F(NodeParametersTest, SettingAtomicallyIsAllOrNothing) {
  rclcpp::Node node("node");
  node.declare_parameter("a", 1);
  node.declare_parameter("b", 1);
  EXPECT_FALSE(node.set_parameters_atomically({Parameter("a", 2), Parameter("b", "no")}).successful);
  EXPECT_EQ(node.get_parameter("a").as_int(), 1);
  const auto results = node.set_parameters({Parameter("a", 2), Parameter("b", "no")});
  EXPECT_TRUE(results.at(0).successful);
  EXPECT_FALSE(results.at(1).successful);
  EXPECT_EQ(node.get_parameter("a").as_int(), 2);
}

TEST_F(NodeParametersTest, CallbacksAlterRefuseAndLearnOfChanges) {
  rclcpp::Node node("node");
  node.declare_parameter("a", 1);
  node.declare_parameter("twice_a", 2);
  std::vector<std::string> seen;
  auto pre = node.add_pre_set_parameters_callback(
      [](std::vector<Parameter>& parameters) { parameters.emplace_back("twice_a", 2 * parameters.front().as_int()); });
  auto on = node.add_on_set_parameters_callback([](const std::vector<Parameter>& parameters) {
    return refuse(parameters.front().as_int() < 0 ? "too small" : "");
  });
  auto post = node.add_post_set_parameters_callback([&seen](const std::vector<Parameter>& parameters) {
    for (const Parameter& parameter : parameters) {
      seen.push_back(parameter.get_name() + "=" + parameter.value_to_string());
    }
  });
  EXPECT_TRUE(node.set_parameter(Parameter("a", 3)).successful);
  EXPECT_THAT(seen, ElementsAre("a=3", "twice_a=6"));
  EXPECT_EQ(node.set_parameter(Parameter("a", -1)).reason, "too small");
  EXPECT_EQ(seen.size(), 2u);

  on.reset();  // a callback ends with its handle
  node.remove_post_set_parameters_callback(post.get());
  EXPECT_TRUE(node.set_parameter(Parameter("a", -1)).successful);
  EXPECT_EQ(seen.size(), 2u);
  EXPECT_THROW(node.remove_post_set_parameters_callback(post.get()), std::runtime_error);
}

TEST_F(NodeParametersTest, ACallbackMayReadAndMustNotSet) {
  rclcpp::Node node("node");
  node.declare_parameter("a", 1);
  int64_t read = 0;
  const auto handle = node.add_on_set_parameters_callback([&](const std::vector<Parameter>&) {
    read = node.get_parameter("a").as_int();
    EXPECT_THROW(node.set_parameter(Parameter("a", 5)), rclcpp::exceptions::ParameterModifiedInCallbackException);
    return refuse("");
  });
  EXPECT_TRUE(node.set_parameter(Parameter("a", 2)).successful);
  EXPECT_EQ(read, 1);
}

TEST_F(NodeParametersTest, OnlyDynamicallyTypedParametersChangeTypeOrGo) {
  rclcpp::Node node("node");
  Descriptor dynamic;
  dynamic.dynamic_typing = true;
  node.declare_parameter("loose", 1, dynamic);
  node.declare_parameter("strict", 1);
  EXPECT_TRUE(node.set_parameter(Parameter("loose", "text")).successful);
  EXPECT_EQ(node.get_parameter("loose").as_string(), "text");
  node.undeclare_parameter("loose");
  EXPECT_FALSE(node.has_parameter("loose"));
  EXPECT_THROW(node.undeclare_parameter("strict"), rclcpp::exceptions::InvalidParameterTypeException);
  EXPECT_THROW(node.undeclare_parameter("loose"), rclcpp::exceptions::ParameterNotDeclaredException);
}

TEST_F(NodeParametersTest, UndeclaredAndAutomaticParametersAreOptions) {
  rclcpp::Node node("node", rclcpp::NodeOptions()
                                .allow_undeclared_parameters(true)
                                .automatically_declare_parameters_from_overrides(true)
                                .append_parameter_override("auto", 1));
  EXPECT_EQ(node.get_parameter("auto").as_int(), 1);
  EXPECT_EQ(node.get_parameter("never").get_type(), rclcpp::PARAMETER_NOT_SET);
  EXPECT_TRUE(node.set_parameter(Parameter("new", "x")).successful);
  EXPECT_EQ(node.get_parameter("new").as_string(), "x");
}

TEST_F(NodeParametersTest, ListsDescribesAndFindsByPrefix) {
  rclcpp::Node node("node", rclcpp::NodeOptions());
  Descriptor descriptor;
  descriptor.description = "how much";
  node.declare_parameter("gain.p", 1.0, descriptor);
  node.declare_parameter("gain.deep.d", 3.0);
  EXPECT_THAT(node.list_parameters({"gain"}, 1).names, ElementsAre("gain.p"));
  EXPECT_THAT(node.list_parameters({"gain"}, 0).names, ElementsAre("gain.deep.d", "gain.p"));
  EXPECT_THAT(node.list_parameters({}, 1).names, ElementsAre("start_type_description_service", "use_sim_time"));
  EXPECT_THAT(node.list_parameters({"gain"}, 0).prefixes, ElementsAre("gain.deep", "gain"));
  EXPECT_EQ(node.describe_parameter("gain.p").description, "how much");
  EXPECT_THAT(node.get_parameter_types({"gain.p"}), ElementsAre(rclcpp::PARAMETER_DOUBLE));
  std::map<std::string, double> gains;
  EXPECT_TRUE(node.get_parameters("gain", gains));
  EXPECT_THAT(gains, ElementsAre(testing::Pair("deep.d", 3.0), testing::Pair("p", 1.0)));
  std::map<std::string, rclcpp::Parameter> parameters;
  EXPECT_TRUE(node.get_parameters("gain", parameters));
  ASSERT_EQ(parameters.size(), gains.size());
  EXPECT_EQ(parameters.begin()->second.as_double(), gains.begin()->second);
}

TEST_F(NodeParametersTest, ChangesArePublishedOnParameterEvents) {
  using rcl_interfaces::msg::ParameterEvent;
  auto observer = std::make_shared<rclcpp::Node>("observer");
  auto node = std::make_shared<rclcpp::Node>("node", "/ns");
  std::vector<ParameterEvent> events;
  auto subscription = observer->create_subscription<ParameterEvent>("/parameter_events", rclcpp::ParameterEventsQoS(),
                                                                    [&events](const ParameterEvent& event) {
                                                                      if (event.node == "/ns/node") {
                                                                        events.push_back(event);
                                                                      }
                                                                    });
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(observer);
  ASSERT_TRUE(spin_until(executor, [&] { return subscription->get_publisher_count() == 2; }));

  node->declare_parameter("a", 1);
  node->set_parameter(Parameter("a", 2));
  ASSERT_TRUE(spin_until(executor, [&] { return events.size() == 2; }));
  ASSERT_EQ(events[0].new_parameters.size(), 1u);
  EXPECT_EQ(events[0].new_parameters[0].value.integer_value, 1);
  EXPECT_GT(events[0].stamp.sec, 0);
  ASSERT_EQ(events[1].changed_parameters.size(), 1u);
  EXPECT_EQ(events[1].changed_parameters[0].name, "a");
  EXPECT_EQ(events[1].changed_parameters[0].value.integer_value, 2);
}

}  // namespace
