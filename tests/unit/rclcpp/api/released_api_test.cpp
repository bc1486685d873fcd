// SPDX-License-Identifier: Apache-2.0
// What the tests of rclcpp itself use, and applications seldom.
#include <rcl/graph.h>
#include <rcl/network_flow_endpoints.h>
#include <std_msgs/msg/string.h>

#include <atomic>
#include <chrono>
#include <cstring>
#include <example_interfaces/srv/add_two_ints.hpp>
#include <future>
#include <memory>
#include <rclcpp/detail/add_guard_condition_to_rcl_wait_set.hpp>
#include <rclcpp/detail/template_unique.hpp>
#include <rclcpp/executors.hpp>
#include <rclcpp/parameter_events_filter.hpp>
#include <rclcpp/subscription_traits.hpp>
#include <rclcpp/type_support_decl.hpp>
#include <std_msgs/msg/string.hpp>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/unit/rclcpp/ros_test.hpp"

namespace {

using example_interfaces::srv::AddTwoInts;
using rclcpp::experimental::executors::EventsExecutor;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std_msgs::msg::String;

class ReleasedApi : public RosTest {
 protected:
  rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("api");
};

TEST_F(ReleasedApi, ExecutorsSpinANodeUntilAFutureIsComplete) {
  EventsExecutor executor;  // executors.hpp has it
  std::promise<void> promise;
  const std::shared_future<void> future = promise.get_future();
  auto timer = node_->create_wall_timer(milliseconds(0), [&promise, set = false]() mutable {
    if (!std::exchange(set, true)) {
      promise.set_value();
    }
  });
  using rclcpp::executors::spin_node_until_future_complete;
  EXPECT_EQ(spin_node_until_future_complete(executor, node_, future, kPatience), rclcpp::FutureReturnCode::SUCCESS);
  EXPECT_TRUE(executor.get_all_callback_groups().empty());
  EXPECT_EQ(rclcpp::spin_until_future_complete(node_, future), rclcpp::FutureReturnCode::SUCCESS);
  struct Exposed : rclcpp::executors::SingleThreadedExecutor {
    using Executor::spin_node_once_nanoseconds;
  } exposed;
  exposed.spin_node_once(node_, milliseconds(1));
  exposed.spin_node_once_nanoseconds(node_->get_node_base_interface(), nanoseconds(0));
  EXPECT_EQ(error_of([&] { executor.spin_all(nanoseconds(0)); }), "max_duration must be positive");
  EXPECT_EQ(error_of([&] { exposed.spin_all(nanoseconds(-1)); }), "max_duration must be greater than or equal to 0");
}

TEST_F(ReleasedApi, ACallbackGroupIsInOneExecutorOnce) {
  rclcpp::executors::SingleThreadedExecutor executor;
  const auto group = node_->create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive, false);
  executor.add_callback_group(group, node_->get_node_base_interface());
  EXPECT_EQ(error_of<std::runtime_error>([&] { executor.add_callback_group(group, node_->get_node_base_interface()); }),
            "Callback group has already been added to an executor.");
  EXPECT_EQ(executor.get_manually_added_callback_groups().size(), 1u);
}

TEST_F(ReleasedApi, NodeOptionsGiveTheirOverridesForChanges) {
  rclcpp::NodeOptions options(rcl_get_default_allocator());
  options.append_parameter_override("a", 1).append_parameter_override(rclcpp::Parameter("b", 2));
  options.parameter_overrides().emplace_back("c", 3);
  ASSERT_EQ(options.parameter_overrides().size(), 3u);
  const rclcpp::Node node("with_overrides", options);
  EXPECT_EQ(node.get_node_options().parameter_overrides()[2].as_int(), 3);
}

TEST_F(ReleasedApi, WrongUsesThrowWhatRclcppThrows) {
  EXPECT_EQ(error_of([] { rclcpp::ParameterEventsFilter(nullptr, {"a"}, {}); }), "event cannot be null");
  EXPECT_EQ(error_of<rclcpp::exceptions::EventNotRegisteredError>(
                [&] { node_->wait_for_graph_change(std::make_shared<rclcpp::Event>(), milliseconds(0)); }),
            "event already registered");
  EXPECT_EQ(node_->get_node_graph_interface()->count_graph_users(), 0u);
  const auto event = node_->get_graph_event();
  EXPECT_EQ(node_->get_node_graph_interface()->count_graph_users(), 1u);
  node_->wait_for_graph_change(event, milliseconds(0));
  node_->get_node_graph_interface()->notify_graph_change();
  node_->get_node_graph_interface()->notify_shutdown();
  EXPECT_NE(node_->get_node_graph_interface()->get_graph_guard_condition(), nullptr);

  rmw_qos_profile_t profile = rmw_qos_profile_default;
  profile.history = static_cast<rmw_qos_history_policy_t>(999);
  EXPECT_EQ(error_of([&] { rclcpp::QoSInitialization::from_rmw(profile); }),
            "Invalid history policy enum value passed to QoSInitialization::from_rmw");
  EXPECT_EQ(rclcpp::QoSInitialization::from_rmw(rmw_qos_profile_system_default).history_policy,
            RMW_QOS_POLICY_HISTORY_KEEP_LAST);
  const auto longest = rclcpp::Duration(nanoseconds::max());
  EXPECT_EQ(error_of<std::underflow_error>([&] { (void)(rclcpp::Duration(nanoseconds(-1)) - longest); }),
            "duration subtraction leads to int64_t underflow");

  const auto typed = [](std::shared_ptr<void>, std::shared_ptr<void>) {};
  EXPECT_NE(error_of<rclcpp::exceptions::InvalidServiceTypeError>(
                [&] { node_->create_generic_service("s", "std_srvs/srv/None", typed); }),
            "no error");
  EXPECT_NE(error_of<rclcpp::exceptions::InvalidServiceTypeError>(
                [&] { node_->create_generic_client("s", "std_srvs/srv/None"); }),
            "no error");

  EXPECT_EQ(error_of([] { rclcpp::node_interfaces::get_node_base_interface(rclcpp::Node::SharedPtr()); }),
            "node cannot be nullptr");
  EXPECT_EQ(error_of([] {
              rclcpp::create_timer(static_cast<rclcpp::Node*>(nullptr), nullptr, rclcpp::Duration(1, 0), [] {});
            }),
            "node cannot be nullptr");
  rclcpp::Node other("other");
  const auto foreign = other.get_node_base_interface()->get_default_callback_group();
  EXPECT_EQ(error_of<rclcpp::exceptions::MissingGroupNodeException>([&] {
              node_->create_wall_timer(
                  std::chrono::hours(1), [] {}, foreign);
            }),
            "cannot create: timer , callback group not in node");

  rclcpp::AnyServiceCallback<AddTwoInts> callback;
  EXPECT_EQ(error_of<std::runtime_error>([&] { callback.dispatch(nullptr, nullptr, nullptr); }),
            "unexpected request without any callback set");
  using Function = std::function<void(std::shared_ptr<AddTwoInts::Request>, std::shared_ptr<AddTwoInts::Response>)>;
  EXPECT_EQ(error_of([&] { callback.set(Function()); }), "AnyServiceCallback::set(): callback cannot be nullptr");
  callback.set([](std::shared_ptr<AddTwoInts::Request>, std::shared_ptr<AddTwoInts::Response> sum) { sum->sum = 3; });
  EXPECT_EQ(callback.dispatch(nullptr, nullptr, nullptr)->sum, 3);

  rclcpp::InitOptions options;
  options.use_default_domain_id();
  EXPECT_EQ(options.get_domain_id(), node_->get_node_base_interface()->get_context()->get_domain_id());
}

TEST_F(ReleasedApi, ATimerOfAnotherManagerKeepsItsCallback) {
  rclcpp::experimental::TimersManager manager(rclcpp::contexts::get_global_default_context());
  auto timer = node_->create_wall_timer(std::chrono::hours(1), [] {});
  size_t resets = 0;
  timer->set_on_reset_callback([&resets](size_t) { ++resets; });
  manager.remove_timer(timer);
  manager.remove_timer(nullptr);
  timer->reset();
  EXPECT_EQ(resets, 1u);
}

TEST_F(ReleasedApi, BuffersHoldNullPointersAndHaveADeleter) {
  using Buffer = rclcpp::experimental::buffers::RingBufferImplementation<std::unique_ptr<char>>;
  Buffer buffer(2);
  buffer.enqueue(nullptr);
  buffer.enqueue(std::make_unique<char>('a'));
  const std::vector<std::unique_ptr<char>> all = buffer.get_all_data();
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0], nullptr);
  EXPECT_EQ(*all[1], 'a');
  rclcpp::experimental::buffers::TypedIntraProcessBuffer<char, std::allocator<void>, std::default_delete<char>> typed(
      std::make_unique<Buffer>(2));
  EXPECT_FALSE(typed.use_take_shared_method());
  typed.add_unique(std::make_unique<char>('b'));
  const auto unique = typed.get_all_data_unique();
  ASSERT_EQ(unique.size(), 1u);
  EXPECT_EQ(*unique[0], 'b');
}

TEST_F(ReleasedApi, AllocatorsOfCTakeTheirMemoryFromATypedOne) {
  using rclcpp::allocator::retyped_allocate;
  using rclcpp::allocator::retyped_deallocate;
  using rclcpp::allocator::retyped_reallocate;
  using rclcpp::allocator::retyped_zero_allocate;
  std::allocator<char> allocator;
  void* memory = retyped_allocate<std::allocator<char>>(1, &allocator);
  memory = retyped_reallocate<char, std::allocator<char>>(memory, 1, &allocator);
  retyped_deallocate<char, std::allocator<char>>(memory, &allocator);
  memory = retyped_zero_allocate<std::allocator<char>>(1, 1, &allocator);
  EXPECT_EQ(*static_cast<char*>(memory), 0);
  retyped_deallocate<char, std::allocator<char>>(memory, &allocator);
  EXPECT_EQ(error_of<std::runtime_error>([] { retyped_allocate<std::allocator<char>>(1, nullptr); }),
            "Received incorrect allocator type");
}

TEST_F(ReleasedApi, RclWaitsForEndpointsAndTellsTheirAddresses) {
  rcl_node_t* node = node_->get_node_base_interface()->get_rcl_node_handle();
  rcl_allocator_t allocator = rcl_get_default_allocator();
  auto publisher = node_->create_publisher<String>("topic", 10);
  auto subscription = node_->create_subscription<String>("topic", 10, [](const String&) {});
  bool success = false;
  const auto patience = std::chrono::duration_cast<nanoseconds>(kPatience).count();
  EXPECT_EQ(rcl_wait_for_publishers(node, &allocator, "/topic", 1, patience, &success), RCL_RET_OK);
  EXPECT_TRUE(success);
  EXPECT_EQ(rcl_wait_for_subscribers(node, &allocator, "/topic", 1, patience, &success), RCL_RET_OK);
  EXPECT_TRUE(success);
  EXPECT_EQ(rcl_wait_for_subscribers(node, &allocator, "/topic", 2, 1, &success), RCL_RET_TIMEOUT);
  EXPECT_FALSE(success);
  EXPECT_EQ(rcl_wait_for_publishers(node, nullptr, "/topic", 1, 0, &success), RCL_RET_INVALID_ARGUMENT);
  rcl_reset_error();
  rcl_network_flow_endpoint_array_t endpoints = rcl_get_zero_initialized_network_flow_endpoint_array();
  const auto handle = publisher->get_publisher_handle();
  ASSERT_EQ(rcl_publisher_get_network_flow_endpoints(handle.get(), &allocator, &endpoints), RCL_RET_OK);
  EXPECT_EQ(endpoints.size, publisher->get_network_flow_endpoints().size());
  EXPECT_EQ(rcl_network_flow_endpoint_array_fini(&endpoints), RCL_RET_OK);
  EXPECT_EQ(rcl_subscription_get_network_flow_endpoints(nullptr, &allocator, &endpoints), RCL_RET_SUBSCRIPTION_INVALID);
  rcl_reset_error();
  // No namespace is the root.
  EXPECT_EQ(node_->get_node_graph_interface()->get_publisher_names_and_types_by_node("api", ""),
            node_->get_node_graph_interface()->get_publisher_names_and_types_by_node("api", "/"));
}

TEST_F(ReleasedApi, AGroupTellsOfItsChangesByAGuardCondition) {
  const auto group = node_->create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive);
  const auto condition = group->get_notify_guard_condition();
  ASSERT_NE(condition, nullptr);
  EXPECT_EQ(group->get_notify_guard_condition(), condition);
  size_t told = 0;
  condition->set_on_trigger_callback([&told](size_t count) { told += count; });
  auto timer = node_->create_wall_timer(
      std::chrono::hours(1), [] {}, group);
  EXPECT_EQ(told, 1u);
  group->trigger_notify_guard_condition();
  EXPECT_EQ(told, 2u);
  EXPECT_EQ(rclcpp::CallbackGroup(rclcpp::CallbackGroupType::Reentrant).get_notify_guard_condition(), nullptr);
}

TEST_F(ReleasedApi, AServiceServesAHandleOfItsCaller) {
  rcl_node_t* node = node_->get_node_base_interface()->get_rcl_node_handle();
  rcl_service_t handle = rcl_get_zero_initialized_service();
  const rclcpp::AnyServiceCallback<AddTwoInts> callback;
  const auto serve = [&] {
    rclcpp::Service<AddTwoInts>(node_->get_node_base_interface()->get_shared_rcl_node_handle(), &handle, callback);
  };
  EXPECT_EQ(error_of<std::runtime_error>(serve),
            "rcl_service_t in constructor argument must be initialized beforehand.");
  const rcl_service_options_t options = rcl_service_get_default_options();
  const auto* type = rosidl_typesupport_cpp::get_service_type_support_handle<AddTwoInts>();
  ASSERT_EQ(rcl_service_init(&handle, node, type, "add", &options), RCL_RET_OK);
  EXPECT_EQ(error_of<std::runtime_error>(serve), "no error");
  EXPECT_TRUE(rcl_service_is_valid(&handle));
  EXPECT_EQ(rcl_service_fini(&handle, node), RCL_RET_OK);
}

TEST_F(ReleasedApi, TypesHaveTheirHashesAndSupports) {
  const rosidl_type_hash_t* hash = std_msgs__msg__String__get_type_hash(nullptr);
  auto publisher = node_->create_publisher<String>("hashed", 1);
  const auto infos = node_->get_publishers_info_by_topic("hashed");
  ASSERT_EQ(infos.size(), 1u);
  EXPECT_EQ(std::memcmp(&infos[0].topic_type_hash(), hash, sizeof *hash), 0);
  EXPECT_EQ(rclcpp::type_support::get_list_parameters_srv_type_support(),
            rosidl_typesupport_cpp::get_service_type_support_handle<rcl_interfaces::srv::ListParameters>());
  const std::string action = "example_interfaces/action/Fibonacci";
  const auto library = rclcpp::get_typesupport_library(action, "rosidl_typesupport_cpp");
  const auto* support = rclcpp::get_action_typesupport_handle(action, "rosidl_typesupport_cpp", *library);
  ASSERT_NE(support, nullptr);
  EXPECT_NE(support->goal_service_type_support, nullptr);
}

TEST_F(ReleasedApi, TraitsAndSmallFunctions) {
  static_assert(rclcpp::detail::template_unique_v<int, double>);
  static_assert(!rclcpp::detail::template_unique_v<int, double, int>);
  const auto take = [](std::shared_ptr<const String>) {};
  static_assert(std::is_same_v<rclcpp::subscription_traits::has_message_type<decltype(take)>::type, const String> ||
                std::is_same_v<rclcpp::subscription_traits::has_message_type<decltype(take)>::type, String>);
  static_assert(!rclcpp::subscription_traits::is_serialized_callback<decltype(take)>::value);
  const rclcpp::node_interfaces::NodeInterfaces<ALL_RCLCPP_NODE_INTERFACES> all(*node_);
  EXPECT_NE(all.get<rclcpp::node_interfaces::NodeBaseInterface>(), nullptr);

  rclcpp::SerializedMessage bytes(8);
  bytes = bytes.get_rcl_serialized_message();
  EXPECT_EQ(bytes.capacity(), 8u);
  auto publisher = node_->create_publisher<String>("topic", 10);
  EXPECT_TRUE(*publisher == &publisher->get_gid());
  EXPECT_EQ(rclcpp::PublisherOptions().to_rcl_publisher_options<String>(rclcpp::QoS(7)).qos.depth, 7u);
  auto subscription = node_->create_subscription<String>("topic", 10, take);
  EXPECT_TRUE(subscription->use_take_shared_method());
  EXPECT_FALSE(rclcpp::detail::resolve_enable_topic_statistics(rclcpp::SubscriptionOptions(),
                                                               *node_->get_node_base_interface()));
  const auto context = node_->get_node_base_interface()->get_context();
  const size_t callbacks = context->get_on_shutdown_callbacks().size();
  const auto handle = context->add_on_shutdown_callback([] {});
  EXPECT_EQ(context->get_on_shutdown_callbacks().size(), callbacks + 1);
  EXPECT_TRUE(context->remove_on_shutdown_callback(handle));
  struct DerivedLogger : rclcpp::Logger {
    using Logger::Logger;
    DerivedLogger() : Logger(rclcpp::get_logger("derived")) {}
  };
  RCLCPP_DEBUG(DerivedLogger(), "a logger of a derived class");
}

}  // namespace
