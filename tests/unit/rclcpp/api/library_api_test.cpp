// SPDX-License-Identifier: Apache-2.0
// The use of rclcpp by libraries: they take the interfaces of a node one by one, whatever class the node has.
#include <rosidl_runtime_c/type_hash.h>

#include <rclcpp/create_publisher.hpp>
#include <rclcpp/create_subscription.hpp>
#include <rclcpp/create_timer.hpp>
#include <rclcpp/dynamic_typesupport/dynamic_message_type_builder.hpp>
#include <rclcpp/dynamic_typesupport/dynamic_message_type_support.hpp>
#include <rclcpp/expand_topic_or_service_name.hpp>
#include <std_msgs/msg/string.hpp>
#include <string>
#include <vector>

#include "tests/unit/rclcpp/ros_test.hpp"

namespace {

using rclcpp::node_interfaces::NodeInterfaces;
using rclcpp::node_interfaces::NodeParametersInterface;
using rclcpp::node_interfaces::NodeTopicsInterface;
using std_msgs::msg::String;

class Library : public RosTest {
 protected:
  rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("library", "ns");
};

// Like message filters: it subscribes with the interfaces that it keeps of a node, and may subscribe again.
class Filter {
 public:
  using Interfaces = NodeInterfaces<NodeParametersInterface, NodeTopicsInterface>;

  Filter() = default;
  template <typename NodeT>
  Filter(std::shared_ptr<NodeT> node, const std::string& topic) {
    subscribe(*node, topic);
  }
  void subscribe(Interfaces interfaces, const std::string& topic) {
    auto parameters = interfaces.get<NodeParametersInterface>();
    auto topics = interfaces.get<NodeTopicsInterface>();
    subscription = rclcpp::create_subscription<String>(
        parameters, topics, topic, rclcpp::QoS(1),
        [this](const std::shared_ptr<const String> message) { last = message->data; }, rclcpp::SubscriptionOptions());
    interfaces_ = interfaces;
  }

  rclcpp::Subscription<String>::SharedPtr subscription;
  std::string last;

 private:
  Interfaces interfaces_;
};

// Like a diagnostic updater.
class Updater {
 public:
  template <typename NodeT>
  explicit Updater(NodeT node)
      : publisher_(rclcpp::create_publisher<String>(node->get_node_topics_interface(), "topic", 1)),
        period_(rclcpp::Duration::from_seconds(
            node->get_node_parameters_interface()
                ->declare_parameter("period", rclcpp::ParameterValue(0.001), rcl_interfaces::msg::ParameterDescriptor())
                .template get<double>())),
        timer_(rclcpp::create_timer(node->get_node_base_interface(), node->get_node_timers_interface(),
                                    node->get_node_clock_interface()->get_clock(), period_,
                                    std::bind(&Updater::update, this))) {}

 private:
  void update() {
    String message;
    message.data = "update";
    publisher_->publish(message);
  }

  rclcpp::Publisher<String>::SharedPtr publisher_;
  rclcpp::Duration period_;
  rclcpp::TimerBase::SharedPtr timer_;
};

TEST_F(Library, WorksWithTheInterfacesOfANode) {
  Filter filter(node_, "topic");
  const Updater updater(node_.get());
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(node_);
  EXPECT_TRUE(spin_until(executor, [&] { return filter.last == "update"; }));
}

TEST_F(Library, ATopicsInterfaceAloneHasNoParametersToOverrideAQos) {
  const auto topics = node_->get_node_topics_interface();
  const auto subscription = rclcpp::create_subscription<String>(topics, "topic", 1, [](const String&) {});
  EXPECT_STREQ(subscription->get_topic_name(), "/ns/topic");
  rclcpp::PublisherOptions options;
  options.qos_overriding_options = rclcpp::QosOverridingOptions::with_default_policies();
  EXPECT_EQ(error_of<std::runtime_error>([&] { rclcpp::create_publisher<String>(topics, "topic", 1, options); }),
            "passed non-default qos overriding options without providing a parameters interface");
}

TEST_F(Library, TimersNeedAClockAndInterfaces) {
  const auto base = node_->get_node_base_interface();
  const auto timers = node_->get_node_timers_interface();
  const auto make = [](auto node_base, auto node_timers, const rclcpp::Clock::SharedPtr& clock) {
    return [=] {
      rclcpp::create_timer<std::function<void()>>(node_base, node_timers, clock, std::chrono::seconds(1), [] {});
    };
  };
  EXPECT_EQ(error_of(make(base, timers, node_->get_clock())), "no error");
  EXPECT_EQ(error_of(make(base, timers, nullptr)), "clock cannot be null");
  EXPECT_EQ(error_of(make(nullptr, timers, node_->get_clock())), "input node_base cannot be null");
  EXPECT_EQ(error_of(make(base, nullptr, node_->get_clock())), "input node_timers cannot be null");
  EXPECT_EQ(error_of([&] {
              rclcpp::create_wall_timer(
                  std::chrono::seconds(1), [] {}, nullptr, base.get(), nullptr);
            }),
            "input node_timers cannot be null");
}

TEST_F(Library, NamesAreExpandedWithoutANode) {
  EXPECT_EQ(rclcpp::expand_topic_or_service_name("image", "camera", "/left"), "/left/image");
  EXPECT_EQ(rclcpp::expand_topic_or_service_name("~/image", "camera", "/left"), "/left/camera/image");
  EXPECT_EQ(rclcpp::expand_topic_or_service_name("{node}/info", "camera", "/", true), "/camera/info");
  EXPECT_EQ(rclcpp::expand_topic_or_service_name("/image", "camera", "/left"), "/image");
  EXPECT_THROW(rclcpp::expand_topic_or_service_name("a b", "camera", "/"), rclcpp::exceptions::InvalidTopicNameError);
  EXPECT_THROW(rclcpp::expand_topic_or_service_name("a b", "camera", "/", true),
               rclcpp::exceptions::InvalidServiceNameError);
  EXPECT_THROW(rclcpp::expand_topic_or_service_name("a", "the camera", "/"), rclcpp::exceptions::InvalidNodeNameError);
  EXPECT_THROW(rclcpp::expand_topic_or_service_name("a", "camera", "left"), rclcpp::exceptions::InvalidNamespaceError);
}

TEST_F(Library, OptionsOfANodeBecomeThoseOfRcl) {
  rclcpp::NodeOptions options;
  options.use_global_arguments(false).clock_qos(rclcpp::QoS(5)).use_clock_thread(false);
  EXPECT_EQ(options.clock_qos().depth(), 5U);
  EXPECT_FALSE(options.use_clock_thread());
  const rcl_node_options_t* rcl_options = options.get_rcl_node_options();
  EXPECT_FALSE(rcl_options->use_global_arguments);
  EXPECT_EQ(options.get_rcl_node_options(), rcl_options);
  options.arguments({"--ros-args", "-r", "__node:=other"}).enable_rosout(false);
  EXPECT_FALSE(options.get_rcl_node_options()->enable_rosout);
  EXPECT_STREQ(rclcpp::Node("node", options).get_name(), "other");
}

TEST_F(Library, EndpointsTellTheHashOfTheirType) {
  const auto publisher = node_->create_publisher<String>("topic", 1);
  // The hash of std_msgs/msg/String in every ROS 2 since Iron.
  const std::string expected = "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18";
  const auto other_context = std::make_shared<rclcpp::Context>();
  other_context->init(0, nullptr);
  const auto other = std::make_shared<rclcpp::Node>("other", rclcpp::NodeOptions().context(other_context));
  for (const auto& node : {node_, other}) {
    const auto deadline = std::chrono::steady_clock::now() + kPatience;
    while (node->count_publishers("/ns/topic") == 0 && std::chrono::steady_clock::now() < deadline) {
      node->wait_for_graph_change(node->get_graph_event(), std::chrono::milliseconds(10));
    }
    const auto infos = node->get_publishers_info_by_topic("/ns/topic");
    ASSERT_EQ(infos.size(), 1U);
    const rosidl_type_hash_t& hash = infos[0].topic_type_hash();
    char* text = nullptr;
    const rcutils_allocator_t allocator = rcutils_get_default_allocator();
    ASSERT_EQ(rosidl_stringify_type_hash(&hash, allocator, &text), RCUTILS_RET_OK);
    EXPECT_EQ(text, expected);
    rosidl_type_hash_t parsed;
    ASSERT_EQ(rosidl_parse_type_hash_string(text, &parsed), RCUTILS_RET_OK);
    EXPECT_TRUE(parsed.version == 1 && std::equal(parsed.value, std::end(parsed.value), hash.value));
    allocator.deallocate(text, allocator.state);
  }
  other_context->shutdown("done");
  rosidl_type_hash_t hash;
  for (const std::string& text : {std::string(), std::string("RIHS01_"), std::string("no hash"), expected + "0"}) {
    EXPECT_EQ(rosidl_parse_type_hash_string(text.c_str(), &hash), RCUTILS_RET_INVALID_ARGUMENT) << text;
    EXPECT_EQ(hash.version, ROSIDL_TYPE_HASH_VERSION_UNSET);
  }
}

TEST_F(Library, IsGivenStringsAsCHasThem) {
  EXPECT_STREQ(rclcpp::get_c_string("text"), "text");
  EXPECT_STREQ(rclcpp::get_c_string(std::string("text")), "text");
}

struct MadeClock {
  using duration = std::chrono::nanoseconds;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<MadeClock>;
  static constexpr bool is_steady = true;
  static time_point now() { return time_point(time); }

  static inline duration time{0};
};

TEST_F(Library, MayHaveARateOnAClockOfCpp) {
  using std::chrono::microseconds;
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
  rclcpp::GenericRate<MadeClock> rate(microseconds(1000));
  EXPECT_EQ(rclcpp::GenericRate<MadeClock>(200.0).period(), std::chrono::milliseconds(5));
#pragma GCC diagnostic pop
  EXPECT_EQ(rate.get_type(), RCL_STEADY_TIME);
  const auto sleeps_at = [&rate](int64_t time) {
    MadeClock::time = microseconds(time);
    return rate.sleep();
  };
  EXPECT_TRUE(sleeps_at(0));
  EXPECT_FALSE(sleeps_at(2000));  // slightly too late
  EXPECT_FALSE(sleeps_at(5000));  // more than an interval too late, so the next interval starts now
  EXPECT_TRUE(sleeps_at(5500));
  EXPECT_TRUE(sleeps_at(100));  // time has jumped back
  rate.reset();
  EXPECT_TRUE(sleeps_at(900));
}

// Like executors of others: they take the messages themselves.
TEST_F(Library, TakesAndHandlesMessagesOfAnySubscription) {
  std::string received;
  const auto subscription = node_->create_subscription<String>(
      "text", 10, [&](const String::ConstSharedPtr& message) { received = message->data; });
  const auto publisher = node_->create_publisher<String>("text", 10);
  EXPECT_FALSE(publisher->is_durability_transient_local());
  String message;
  message.data = "taken by hand";
  publisher->publish(message);
  rclcpp::SubscriptionBase& base = *subscription;
  ASSERT_FALSE(base.is_serialized());
  rclcpp::WaitSet wait_set({subscription});
  ASSERT_EQ(wait_set.wait(kPatience).kind(), rclcpp::WaitResultKind::Ready);
  std::shared_ptr<void> taken = base.create_message();
  rclcpp::MessageInfo info;
  ASSERT_TRUE(base.take_type_erased(taken.get(), info));
  base.handle_message(taken, info);
  base.return_message(taken);
  EXPECT_EQ(received, "taken by hand");
  EXPECT_EQ(taken, nullptr);
}

TEST_F(Library, IsToldOfEventsBesideTheirHandlers) {
  size_t matches = 0;
  rclcpp::PublisherOptions options;
  options.event_callbacks.matched_callback = [](rclcpp::MatchedInfo&) {};
  const auto publisher = node_->create_publisher<String>("text", 10, options);
  publisher->set_on_new_qos_event_callback([&matches](size_t count) { matches += count; }, RCL_PUBLISHER_MATCHED);
  const auto subscription = node_->create_subscription<String>("text", 10, [](const String&) {});
  rclcpp::executors::SingleThreadedExecutor executor;
  EXPECT_TRUE(spin_until(executor, [&] { return matches == 1; }));
  publisher->clear_on_new_qos_event_callback(RCL_PUBLISHER_MATCHED);
  EXPECT_EQ(error_of([&] { publisher->set_on_new_qos_event_callback(nullptr, RCL_PUBLISHER_MATCHED); }),
            "The callback passed to set_on_new_qos_event_callback is not callable.");
  // Without a handler, it warns and does nothing.
  subscription->set_on_new_qos_event_callback([](size_t) { FAIL(); }, RCL_SUBSCRIPTION_MESSAGE_LOST);
  subscription->set_on_new_intra_process_message_callback([](size_t) { FAIL(); });
}

TEST_F(Library, ReadsParametersWithTheInterfacesOfANode) {
  node_->declare_parameter("speed", 7);
  const auto client_node = std::make_shared<rclcpp::Node>("client");
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(node_);
  executor.add_node(client_node);
  rclcpp::AsyncParametersClient client(client_node->get_node_base_interface(), client_node->get_node_topics_interface(),
                                       client_node->get_node_graph_interface(),
                                       client_node->get_node_services_interface(), "/ns/library");
  ASSERT_TRUE(client.wait_for_service(kPatience));
  const auto answer = client.get_parameters({"speed"});
  ASSERT_EQ(executor.spin_until_future_complete(answer, kPatience), rclcpp::FutureReturnCode::SUCCESS);
  EXPECT_EQ(answer.get().at(0).as_int(), 7);
}

TEST(SmallFunctions, AreThoseOfRclcpp) {
  EXPECT_TRUE(rclcpp::add_will_overflow<int64_t>(INT64_MAX, 1));
  EXPECT_TRUE(rclcpp::add_will_underflow<int64_t>(INT64_MIN, -1));
  EXPECT_TRUE(rclcpp::sub_will_overflow<int64_t>(1, -INT64_MAX));
  EXPECT_TRUE(rclcpp::sub_will_underflow<int64_t>(-2, INT64_MAX));
  EXPECT_FALSE(rclcpp::add_will_overflow(1, 2));
  const std::vector<std::string> words{"one", "two"};
  EXPECT_STREQ(rclcpp::get_c_vector_string(words).at(1), "two");
  const builtin_interfaces::msg::Time time = rclcpp::convert_rcl_time_to_sec_nanos(-500'000'000);
  EXPECT_EQ(time.sec, -1);
  EXPECT_EQ(time.nanosec, 500'000'000u);
  EXPECT_EQ(rclcpp::get_log_directory(), rclcpp::get_logging_directory());
  EXPECT_STREQ(rclcpp::get_node_logger(nullptr).get_name(), "rclcpp");
}

TEST_F(Library, FindsTheNamesOfTypesThatAreMadeAtRunTime) {
  const auto subscription = node_->create_subscription<String>("topic", 1, [](const String&) {});
  const auto bytes =
      node_->create_subscription<String>("topic", 1, [](const std::shared_ptr<const rclcpp::SerializedMessage>) {});
  EXPECT_EQ(subscription->get_delivered_message_kind(), rclcpp::DeliveredMessageKind::ROS_MESSAGE);
  EXPECT_EQ(bytes->get_delivered_message_kind(), rclcpp::DeliveredMessageKind::SERIALIZED_MESSAGE);
  EXPECT_EQ(error_of<rclcpp::exceptions::UnimplementedError>([&] { subscription->create_dynamic_message(); }),
            "create_dynamic_message is not implemented for subscriptions");
  EXPECT_EQ(error_of<std::runtime_error>([] { rclcpp::dynamic_typesupport::DynamicSerializationSupport support; }),
            "Unimplemented");
  EXPECT_FALSE(std::is_default_constructible_v<rclcpp::dynamic_typesupport::DynamicMessageTypeBuilder>);
  EXPECT_FALSE(std::is_default_constructible_v<rclcpp::dynamic_typesupport::DynamicMessageTypeSupport>);
}

}  // namespace
