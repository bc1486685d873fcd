// SPDX-License-Identifier: Apache-2.0
// The parts of rclcpp besides nodes that applications written for ROS 2 use.
#include <rclcpp/version.h>

#include <rcl_interfaces/srv/get_logger_levels.hpp>
#include <rcl_interfaces/srv/set_logger_levels.hpp>
#include <rclcpp/node_interfaces/get_node_topics_interface.hpp>
#include <rclcpp/time_source.hpp>
#include <rosgraph_msgs/msg/clock.hpp>
#include <std_msgs/msg/string.hpp>
#include <std_srvs/srv/trigger.hpp>

#include "tests/unit/rclcpp/ros_test.hpp"

namespace {

using rclcpp::node_interfaces::NodeBaseInterface;
using rclcpp::node_interfaces::NodeClockInterface;
using rclcpp::node_interfaces::NodeInterfaces;
using rclcpp::node_interfaces::NodeLoggingInterface;
using std_msgs::msg::String;

class Application : public RosTest {
 protected:
  rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("app", "ns");
};

std::string describe(NodeInterfaces<NodeBaseInterface, NodeLoggingInterface> node) {
  return std::string(node.get_node_base_interface()->get_fully_qualified_name()) + " " +
         node.get<NodeLoggingInterface>()->get_logger_name();
}

TEST_F(Application, FunctionsTakeThePartOfANodeThatTheyNeed) {
  EXPECT_EQ(describe(*node_), "/ns/app ns.app");
  EXPECT_EQ(describe({node_->get_node_base_interface(), node_->get_node_logging_interface()}), "/ns/app ns.app");
  NodeInterfaces<NodeBaseInterface, NodeClockInterface, NodeLoggingInterface> more(*node_);
  EXPECT_EQ(more.get_node_clock_interface()->get_clock(), node_->get_clock());
  EXPECT_EQ(describe(more), "/ns/app ns.app");
  EXPECT_EQ(rclcpp::node_interfaces::get_node_topics_interface(node_), node_->get_node_topics_interface());
  EXPECT_EQ(node_->get_node_topics_interface()->resolve_topic_name("~/scan"), "/ns/app/scan");
  EXPECT_EQ(node_->get_node_services_interface()->resolve_service_name("reset"), "/ns/reset");
}

// Names of an application must not collide with names that rclcpp's classes use for themselves.
using SetParametersResult = std::shared_future<std::vector<rcl_interfaces::msg::SetParametersResult>>;
using ParameterDescriptor = int;
class NodeWithNames : public rclcpp::Node {
 public:
  NodeWithNames() : Node("names") {}
  SetParametersResult results;
  ParameterDescriptor descriptor = 3;
};
TEST_F(Application, HasItsOwnNames) {
  EXPECT_EQ(NodeWithNames().descriptor, 3);
}

TEST_F(Application, MayGiveServicesAProfileOfTheMiddleware) {
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
  using std_srvs::srv::Trigger;
  const auto group = node_->create_callback_group(rclcpp::CallbackGroupType::Reentrant);
  const auto service = node_->create_service<Trigger>(
      "go", [](Trigger::Request::SharedPtr, Trigger::Response::SharedPtr response) { response->success = true; },
      rmw_qos_profile_services_default, group);
  const auto client = node_->create_client<Trigger>("go", rmw_qos_profile_services_default, group);
  // Libraries that know only the interfaces of a node have the same two.
  const auto other_service = rclcpp::create_service<Trigger>(
      node_->get_node_base_interface(), node_->get_node_services_interface(), "stop",
      [](Trigger::Request::SharedPtr, Trigger::Response::SharedPtr) {}, rmw_qos_profile_services_default, group);
  const auto other_client = rclcpp::create_client<Trigger>(
      node_->get_node_base_interface(), node_->get_node_graph_interface(), node_->get_node_services_interface(), "stop",
      rmw_qos_profile_services_default, nullptr);
#pragma GCC diagnostic pop
  ASSERT_TRUE(client->wait_for_service(kPatience));
  EXPECT_TRUE(other_client->wait_for_service(kPatience));
  auto future = client->async_send_request(std::make_shared<Trigger::Request>());
  ASSERT_EQ(rclcpp::spin_until_future_complete(node_, future, kPatience), rclcpp::FutureReturnCode::SUCCESS);
  EXPECT_TRUE(future.get()->success);
}

// As in the constructor of a node, where no shared pointer to the node exists yet.
TEST_F(Application, ReadsParametersOfItsOwnThroughAPlainPointer) {
  node_->declare_parameter("speed", 1.5);
  rclcpp::SyncParametersClient client(node_.get());
  ASSERT_TRUE(client.wait_for_service(kPatience));
  EXPECT_EQ(client.get_parameter<double>("speed"), 1.5);
}

TEST_F(Application, LetsOthersChangeItsLogLevels) {
  using rcl_interfaces::srv::GetLoggerLevels;
  using rcl_interfaces::srv::SetLoggerLevels;
  const auto logging = std::make_shared<rclcpp::Node>("logging", rclcpp::NodeOptions().enable_logger_service(true));
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(logging);
  executor.add_node(node_);
  const auto setter = node_->create_client<SetLoggerLevels>("/logging/set_logger_levels");
  const auto getter = node_->create_client<GetLoggerLevels>("/logging/get_logger_levels");
  ASSERT_TRUE(setter->wait_for_service(kPatience) && getter->wait_for_service(kPatience));

  auto set = std::make_shared<SetLoggerLevels::Request>();
  set->levels.resize(1);
  set->levels[0].name = "logging";
  set->levels[0].level = rcl_interfaces::msg::LoggerLevel::LOG_LEVEL_WARN;
  auto results = setter->async_send_request(set);
  ASSERT_EQ(executor.spin_until_future_complete(results, kPatience), rclcpp::FutureReturnCode::SUCCESS);
  EXPECT_TRUE(results.get()->results.at(0).successful);
  EXPECT_EQ(logging->get_logger().get_effective_level(), rclcpp::Logger::Level::Warn);

  auto get = std::make_shared<GetLoggerLevels::Request>();
  get->names = {"logging", "unheard_of"};
  auto levels = getter->async_send_request(get);
  ASSERT_EQ(executor.spin_until_future_complete(levels, kPatience), rclcpp::FutureReturnCode::SUCCESS);
  const auto answer = levels.get()->levels;
  EXPECT_EQ(answer.at(0).level, 30);
  EXPECT_EQ(answer.at(1).level, 0);
  logging->get_logger().set_level(rclcpp::Logger::Level::Unset);
}

TEST_F(Application, NamesTheEntriesOfAWaitSetByTheWaitSet) {
  const auto subscription = node_->create_subscription<String>("chatter", 10, [](String::UniquePtr) {});
  using WaitSet = rclcpp::StaticWaitSet<1, 0, 0, 0, 0, 0>;
  WaitSet wait_set(std::array<WaitSet::SubscriptionEntry, 1>{{{subscription}}});
  const auto publisher = node_->create_publisher<String>("chatter", 10);
  publisher->publish(String());
  EXPECT_EQ(wait_set.wait(kPatience).kind(), rclcpp::WaitResultKind::Ready);
}

TEST_F(Application, HearsOfJumpsOfAClock) {
  rclcpp::Clock clock(RCL_ROS_TIME);
  std::vector<std::string> heard;
  rcl_jump_threshold_t threshold{};
  threshold.on_clock_change = true;
  auto handler = clock.create_jump_callback(
      [&] { heard.push_back("before"); },
      [&](const rcl_time_jump_t& jump) { heard.push_back("change " + std::to_string(jump.clock_change)); }, threshold);
  ASSERT_EQ(rcl_enable_ros_time_override(clock.get_clock_handle()), RCL_RET_OK);
  EXPECT_EQ(heard, (std::vector<std::string>{"before", "change 2"}));
  EXPECT_FALSE(clock.wait_until_started(rclcpp::Duration(0, 1)));
  ASSERT_EQ(rcl_set_ros_time_override(clock.get_clock_handle(), 5), RCL_RET_OK);
  EXPECT_TRUE(clock.wait_until_started());
  handler.reset();
  ASSERT_EQ(rcl_disable_ros_time_override(clock.get_clock_handle()), RCL_RET_OK);
  EXPECT_EQ(heard.size(), 2U);
}

TEST_F(Application, DrivesClocksOfItsOwnFromSimulatedTime) {
  rclcpp::TimeSource source(node_);
  const auto clock = std::make_shared<rclcpp::Clock>(RCL_ROS_TIME);
  source.attachClock(clock);
  EXPECT_FALSE(clock->ros_time_is_active());
  const auto steady = std::make_shared<rclcpp::Clock>(RCL_STEADY_TIME);
  source.attachClock(steady);
  EXPECT_FALSE(node_->set_parameter(rclcpp::Parameter("use_sim_time", true)).successful);
  source.detachClock(steady);

  ASSERT_TRUE(node_->set_parameter(rclcpp::Parameter("use_sim_time", true)).successful);
  EXPECT_TRUE(clock->ros_time_is_active());
  EXPECT_THROW(source.attachClock(steady), std::invalid_argument);
  const auto publisher = node_->create_publisher<rosgraph_msgs::msg::Clock>("/clock", rclcpp::QoS(1));
  rosgraph_msgs::msg::Clock time;
  time.clock.sec = 42;
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(node_);
  while (clock->now().seconds() != 42) {
    publisher->publish(time);
    executor.spin_once(std::chrono::milliseconds(10));
  }
  const auto late = std::make_shared<rclcpp::Clock>(RCL_ROS_TIME);
  source.attachClock(late);
  EXPECT_EQ(late->now().seconds(), 42);
  source.detachNode();
  EXPECT_FALSE(clock->ros_time_is_active());
}

TEST(Qos, TellsWhetherTwoProfilesMatch) {
  const rclcpp::QoS all_said = rclcpp::QoS(1).liveliness(rclcpp::LivelinessPolicy::Automatic);
  const auto result =
      rclcpp::qos_check_compatible(rclcpp::QoS(all_said).best_effort(), rclcpp::QoS(all_said).reliable());
  EXPECT_EQ(result.compatibility, rclcpp::QoSCompatibility::Error);
  EXPECT_EQ(result.reason, "ERROR: best effort publisher and reliable subscription;");
  EXPECT_EQ(rclcpp::qos_check_compatible(all_said, all_said).compatibility, rclcpp::QoSCompatibility::Ok);
}

static_assert(RCLCPP_VERSION_GTE(28, 0, 0) && RCLCPP_VERSION_GTE(27, 9, 9) && !RCLCPP_VERSION_GTE(28, 2, 0));

}  // namespace
