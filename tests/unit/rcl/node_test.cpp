// SPDX-License-Identifier: Apache-2.0
// Contexts, nodes and topics on the real middleware.
#include <algorithm>
#include <atomic>
#include <functional>
#include <thread>
#include <vector>

#include "rcl_interfaces/msg/log.hpp"
#include "rcl_test.hpp"
#include "rosidl_typesupport_cpp/message_type_support.hpp"
#include "std_msgs/msg/string.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using rcl_test::Context;
using rcl_test::kPatience;
using rcl_test::Node;
using rcl_test::take_error;

class RclNode : public testing::Test {
 protected:
  test_support::Sandbox sandbox_;
};

TEST_F(RclNode, HasTheNamesOfItsRemapRules) {
  Context context({"program", "--ros-args", "-r", "__node:=renamed", "-r", "__ns:=/a/b", "-r", "renamed:from:=to"});
  Node node(context, "talker");
  ASSERT_EQ(node.result, RCL_RET_OK) << node.error;
  EXPECT_STREQ(rcl_node_get_name(&node.handle), "renamed");
  EXPECT_STREQ(rcl_node_get_namespace(&node.handle), "/a/b");
  EXPECT_STREQ(rcl_node_get_fully_qualified_name(&node.handle), "/a/b/renamed");
  EXPECT_STREQ(rcl_node_get_logger_name(&node.handle), "a.b.renamed");
  EXPECT_EQ(node.resolve("from"), "/a/b/to");
  EXPECT_EQ(node.resolve("~/x"), "/a/b/renamed/x");
  EXPECT_EQ(node.resolve("/x/"), "invalid topic name '/x/', at character 3: topic name must not end with a '/'");
}

TEST_F(RclNode, PrefersItsOwnArgumentsAndCanIgnoreThoseOfTheProcess) {
  Context context({"program", "--ros-args", "-r", "__node:=global", "-r", "from:=global"});
  const rcl_test::Arguments local({"--ros-args", "-r", "__node:=local", "-r", "from:=local"});
  rcl_node_options_t options = rcl_node_get_default_options();
  options.arguments = local.handle;
  Node with_both(context, "talker", "", options);
  ASSERT_EQ(with_both.result, RCL_RET_OK) << with_both.error;
  EXPECT_STREQ(rcl_node_get_name(&with_both.handle), "local");
  EXPECT_EQ(with_both.resolve("from"), "/local");

  options = rcl_node_get_default_options();
  options.use_global_arguments = false;
  Node without(context, "talker", "ns", options);
  ASSERT_EQ(without.result, RCL_RET_OK) << without.error;
  EXPECT_STREQ(rcl_node_get_fully_qualified_name(&without.handle), "/ns/talker");
  EXPECT_EQ(without.resolve("from"), "/ns/from");
}

TEST_F(RclNode, RefusesWrongNames) {
  Context context;
  Node wrong_name(context, "1talker");
  EXPECT_EQ(wrong_name.result, RCL_RET_NODE_INVALID_NAME);
  EXPECT_EQ(wrong_name.error, "invalid node name '1talker': node name must not start with a number");
  Node wrong_namespace(context, "talker", "a//b");
  EXPECT_EQ(wrong_namespace.result, RCL_RET_NODE_INVALID_NAMESPACE);
  EXPECT_EQ(wrong_namespace.error, "invalid namespace '/a//b': namespace must not have '//'");
}

TEST_F(RclNode, NeedsAContextThatIsNotShutDown) {
  Context context;
  ASSERT_EQ(rcl_shutdown(&context.handle), RCL_RET_OK);
  EXPECT_EQ(rcl_shutdown(&context.handle), RCL_RET_ALREADY_SHUTDOWN);
  rcl_reset_error();
  Node node(context, "talker");
  EXPECT_EQ(node.result, RCL_RET_NOT_INIT);
  EXPECT_EQ(node.error, "a node needs a context that is initialized and not shut down");
}

TEST_F(RclNode, ReadsTheDomainFromTheEnvironment) {
  setenv("ROS_DOMAIN_ID", "17", 1);
  Context context;
  size_t domain_id = 0;
  ASSERT_EQ(rcl_context_get_domain_id(&context.handle, &domain_id), RCL_RET_OK);
  EXPECT_EQ(domain_id, 17u);
}

struct WrongEnvironment {
  const char* variable;
  const char* value;
  const char* message;
};

class RclInit : public testing::TestWithParam<WrongEnvironment> {
 protected:
  test_support::Sandbox sandbox_;
};

TEST_P(RclInit, RefusesAWrongEnvironment) {
  setenv(GetParam().variable, GetParam().value, 1);
  rcl_context_t context = rcl_get_zero_initialized_context();
  rcl_init_options_t options = rcl_get_zero_initialized_init_options();
  ASSERT_EQ(rcl_init_options_init(&options, rcl_get_default_allocator()), RCL_RET_OK);
  EXPECT_EQ(rcl_init(0, nullptr, &options, &context), RCL_RET_ERROR);
  EXPECT_EQ(take_error(), GetParam().message);
  EXPECT_EQ(context.impl, nullptr);
  EXPECT_EQ(rcl_init_options_fini(&options), RCL_RET_OK);
}

INSTANTIATE_TEST_SUITE_P(
    Vectors, RclInit,
    testing::Values(WrongEnvironment{"ROS_DOMAIN_ID", "x", "ROS_DOMAIN_ID is 'x', but must be a number from 0 to 232"},
                    WrongEnvironment{"ROS_DOMAIN_ID", "233",
                                     "ROS_DOMAIN_ID is '233', but must be a number from 0 to 232"},
                    WrongEnvironment{"ROS_AUTOMATIC_DISCOVERY_RANGE", "PLANET",
                                     "ROS_AUTOMATIC_DISCOVERY_RANGE is 'PLANET', but must be OFF, LOCALHOST, SUBNET "
                                     "or SYSTEM_DEFAULT"}));

template <typename Message>
class Subscriber {
 public:
  Subscriber(Context& context, Node& node, const char* topic, const rmw_qos_profile_t& qos) : node_(node) {
    rcl_subscription_options_t options = rcl_subscription_get_default_options();
    options.qos = qos;
    EXPECT_EQ(
        rcl_subscription_init(&handle, &node.handle, rosidl_typesupport_cpp::get_message_type_support_handle<Message>(),
                              topic, &options),
        RCL_RET_OK)
        << take_error();
    EXPECT_EQ(rcl_wait_set_init(&wait_set_, 1, 0, 0, 0, 0, 0, &context.handle, rcl_get_default_allocator()),
              RCL_RET_OK);
  }
  ~Subscriber() {
    EXPECT_EQ(rcl_wait_set_fini(&wait_set_), RCL_RET_OK);
    EXPECT_EQ(rcl_subscription_fini(&handle, &node_.handle), RCL_RET_OK);
  }

  Message next(rmw_message_info_t* info = nullptr) {
    EXPECT_EQ(rcl_wait_set_clear(&wait_set_), RCL_RET_OK);
    EXPECT_EQ(rcl_wait_set_add_subscription(&wait_set_, &handle, nullptr), RCL_RET_OK);
    EXPECT_EQ(rcl_wait(&wait_set_, kPatience), RCL_RET_OK);
    Message message;
    EXPECT_EQ(rcl_take(&handle, &message, info, nullptr), RCL_RET_OK) << take_error();
    return message;
  }

  rcl_subscription_t handle = rcl_get_zero_initialized_subscription();

 private:
  Node& node_;
  rcl_wait_set_t wait_set_ = rcl_get_zero_initialized_wait_set();
};

TEST_F(RclNode, PublishesAndReceivesOnRemappedTopics) {
  Context context({"program", "--ros-args", "-r", "from:=/to"});
  Node node(context, "talker", "/ns");
  rmw_qos_profile_t qos = rmw_qos_profile_default;
  qos.depth = 7;
  Subscriber<std_msgs::msg::String> subscriber(context, node, "from", qos);
  rcl_publisher_t publisher = rcl_get_zero_initialized_publisher();
  rcl_publisher_options_t options = rcl_publisher_get_default_options();
  options.qos = qos;
  ASSERT_EQ(rcl_publisher_init(&publisher, &node.handle,
                               rosidl_typesupport_cpp::get_message_type_support_handle<std_msgs::msg::String>(), "from",
                               &options),
            RCL_RET_OK);
  EXPECT_STREQ(rcl_publisher_get_topic_name(&publisher), "/to");
  EXPECT_STREQ(rcl_subscription_get_topic_name(&subscriber.handle), "/to");
  EXPECT_EQ(rcl_publisher_get_actual_qos(&publisher)->depth, 7u);

  std_msgs::msg::String message;
  message.data = "hello";
  EXPECT_EQ(rcl_take(&subscriber.handle, &message, nullptr, nullptr), RCL_RET_SUBSCRIPTION_TAKE_FAILED);
  ASSERT_EQ(rcl_publish(&publisher, &message, nullptr), RCL_RET_OK);
  rmw_message_info_t info;
  EXPECT_EQ(subscriber.next(&info).data, "hello");
  rmw_gid_t gid;
  ASSERT_EQ(rmw_get_gid_for_publisher(rcl_publisher_get_rmw_handle(&publisher), &gid), RMW_RET_OK);
  bool same = false;
  ASSERT_EQ(rmw_compare_gids_equal(&gid, &info.publisher_gid, &same), RMW_RET_OK);
  EXPECT_TRUE(same);
  EXPECT_EQ(rcl_publisher_fini(&publisher, &node.handle), RCL_RET_OK);
}

TEST_F(RclNode, PublishesWhatItLogsOnRosout) {
  Context context;
  const rcl_allocator_t allocator = rcl_get_default_allocator();
  ASSERT_EQ(rcl_logging_configure(&context.handle.global_arguments, &allocator), RCL_RET_OK);
  {
    Node node(context, "talker", "/ns");
    ASSERT_EQ(node.result, RCL_RET_OK) << node.error;
    // Subscriptions that join late get the messages that were logged before.
    const rcutils_log_location_t location{"function", "file.cpp", 42};
    testing::internal::CaptureStderr();
    rcutils_log(&location, RCUTILS_LOG_SEVERITY_WARN, "ns.talker.child", "%d messages", 3);
    EXPECT_NE(testing::internal::GetCapturedStderr().find("[ns.talker.child]: 3 messages"), std::string::npos);
    Subscriber<rcl_interfaces::msg::Log> subscriber(context, node, "/rosout", rmw_qos_profile_rosout_default);
    const rcl_interfaces::msg::Log log = subscriber.next();
    EXPECT_EQ(log.name, "ns.talker.child");
    EXPECT_EQ(log.msg, "3 messages");
    EXPECT_EQ(log.level, rcl_interfaces::msg::Log::WARN);
    EXPECT_EQ(log.file, "file.cpp");
    EXPECT_EQ(log.function, "function");
    EXPECT_EQ(log.line, 42u);
  }
  EXPECT_EQ(rcl_logging_fini(), RCL_RET_OK);
}

// A thread that logs uses the publishers of nodes that another thread makes and destroys.
TEST_F(RclNode, ComesAndGoesWhileAnotherThreadLogsWithItsName) {
  Context context;
  const rcl_allocator_t allocator = rcl_get_default_allocator();
  ASSERT_EQ(rcl_logging_configure(&context.handle.global_arguments, &allocator), RCL_RET_OK);
  testing::internal::CaptureStderr();
  std::atomic<bool> done = false;
  std::atomic<int> logged = 0;
  std::thread logger([&] {
    const rcutils_log_location_t location{"function", "file.cpp", 42};
    while (!done) {
      rcutils_log(&location, RCUTILS_LOG_SEVERITY_WARN, "talker", "message");
      ++logged;
    }
  });
  std::vector<rcl_ret_t> results;
  constexpr int kNodes = 20;
  for (int i = 0; i < kNodes; ++i) {
    const int before = logged;
    Node node(context, "talker");
    results.push_back(node.result);
    while (logged < before + 2) {
      std::this_thread::yield();
    }
  }
  done = true;
  logger.join();
  testing::internal::GetCapturedStderr();
  EXPECT_EQ(results, std::vector<rcl_ret_t>(kNodes, RCL_RET_OK));
  EXPECT_EQ(rcl_logging_fini(), RCL_RET_OK);
}

TEST_F(RclNode, HasNoPublisherOnRosoutWhenThatIsDisabled) {
  Context context({"program", "--ros-args", "--disable-rosout-logs"});
  const rcl_allocator_t allocator = rcl_get_default_allocator();
  ASSERT_EQ(rcl_logging_configure(&context.handle.global_arguments, &allocator), RCL_RET_OK);
  Node node(context, "talker");
  size_t count = 99;
  ASSERT_EQ(rcl_count_publishers(&node.handle, "/rosout", &count), RCL_RET_OK);
  EXPECT_EQ(count, 0u);
  EXPECT_EQ(rcl_logging_fini(), RCL_RET_OK);
}

TEST_F(RclNode, SeesTheGraphOfAnotherContext) {
  Context context;
  Node node(context, "talker", "/ns");
  rcl_publisher_t publisher = rcl_get_zero_initialized_publisher();
  const rcl_publisher_options_t options = rcl_publisher_get_default_options();
  ASSERT_EQ(rcl_publisher_init(&publisher, &node.handle,
                               rosidl_typesupport_cpp::get_message_type_support_handle<std_msgs::msg::String>(),
                               "chatter", &options),
            RCL_RET_OK);

  Context other_context;
  Node other(other_context, "observer");
  // Every change of the graph triggers the guard condition.
  rcl_wait_set_t wait_set = rcl_get_zero_initialized_wait_set();
  ASSERT_EQ(rcl_wait_set_init(&wait_set, 0, 1, 0, 0, 0, 0, &other_context.handle, rcl_get_default_allocator()),
            RCL_RET_OK);
  const auto publishers = [&] {
    size_t count = 0;
    EXPECT_EQ(rcl_count_publishers(&other.handle, "/ns/chatter", &count), RCL_RET_OK);
    return count;
  };
  const auto nodes = [&] {
    rcutils_string_array_t names = rcutils_get_zero_initialized_string_array();
    rcutils_string_array_t namespaces = rcutils_get_zero_initialized_string_array();
    EXPECT_EQ(rcl_get_node_names(&other.handle, rcl_get_default_allocator(), &names, &namespaces), RCL_RET_OK);
    std::vector<std::string> result;
    for (size_t i = 0; i < names.size; ++i) {
      result.push_back(std::string(namespaces.data[i]) + " " + names.data[i]);
    }
    EXPECT_EQ(rcutils_string_array_fini(&names), RCUTILS_RET_OK);
    EXPECT_EQ(rcutils_string_array_fini(&namespaces), RCUTILS_RET_OK);
    std::sort(result.begin(), result.end());
    return result;
  };
  const auto wait_until = [&](const std::function<bool()>& condition) {
    while (!condition()) {
      ASSERT_EQ(rcl_wait_set_clear(&wait_set), RCL_RET_OK);
      ASSERT_EQ(rcl_wait_set_add_guard_condition(&wait_set, rcl_node_get_graph_guard_condition(&other.handle), nullptr),
                RCL_RET_OK);
      ASSERT_EQ(rcl_wait(&wait_set, kPatience), RCL_RET_OK)
          << "the graph stays as it is: " << publishers() << " publishers, nodes " << testing::PrintToString(nodes());
    }
  };
  wait_until([&] { return publishers() == 1 && nodes() == std::vector<std::string>{"/ observer", "/ns talker"}; });

  rcl_names_and_types_t topics = rcl_get_zero_initialized_names_and_types();
  rcl_allocator_t allocator = rcl_get_default_allocator();
  ASSERT_EQ(rcl_get_topic_names_and_types(&other.handle, &allocator, false, &topics), RCL_RET_OK);
  ASSERT_EQ(topics.names.size, 1u);
  EXPECT_STREQ(topics.names.data[0], "/ns/chatter");
  EXPECT_STREQ(topics.types[0].data[0], "std_msgs/msg/String");
  EXPECT_EQ(rcl_names_and_types_fini(&topics), RCL_RET_OK);

  ASSERT_EQ(rcl_publisher_fini(&publisher, &node.handle), RCL_RET_OK);
  wait_until([&] { return publishers() == 0; });
  ASSERT_EQ(rcl_node_fini(&node.handle), RCL_RET_OK);
  wait_until([&] { return nodes() == std::vector<std::string>{"/ observer"}; });
  EXPECT_EQ(rcl_wait_set_fini(&wait_set), RCL_RET_OK);
}

}  // namespace
