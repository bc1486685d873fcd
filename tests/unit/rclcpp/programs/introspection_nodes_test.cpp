// SPDX-License-Identifier: Apache-2.0
// The demo nodes whose calls can be watched. Their parameters control this, at the start and while they run.
#include <gmock/gmock.h>
#include <signal.h>

#include <example_interfaces/srv/add_two_ints.hpp>
#include <set>
#include <string>
#include <vector>

#include "tests/support/command.hpp"
#include "tests/unit/rclcpp/ros_test.hpp"

namespace {

using example_interfaces::srv::AddTwoInts;
using service_msgs::msg::ServiceEventInfo;
using test_support::Command;
using test_support::CommandResult;
using test_support::run_command;
using test_support::RunningCommand;
using testing::HasSubstr;

Command node(const std::string& name, const std::string& parameter) {
  return {{std::string(DEMO_NODES_CPP) + "/" + name, "--ros-args", "-p", parameter}};
}

class IntrospectionNodes : public RosTest {
 protected:
  IntrospectionNodes() {
    executor_.add_node(node_);
    subscription_ = node_->create_subscription<AddTwoInts::Event>(
        "/add_two_ints/_service_event", 50, [this](const AddTwoInts::Event& event) {
          const bool has_contents = !event.request.empty() || !event.response.empty();
          told_.insert(std::to_string(event.info.event_type) + (has_contents ? " with contents" : ""));
        });
  }

  bool is_told(const std::set<std::string>& events) {
    return spin_until(executor_, [&] {
      return std::all_of(events.begin(), events.end(),
                         [&](const std::string& event) { return told_.count(event) > 0; });
    });
  }

  void set(const std::string& node, const std::string& parameter, const std::string& value) {
    rclcpp::SyncParametersClient client(node_, node);
    ASSERT_TRUE(client.wait_for_service(kPatience));
    executor_.remove_node(node_);  // the client spins it
    const auto results = client.set_parameters({rclcpp::Parameter(parameter, value)}, kPatience);
    executor_.add_node(node_);
    ASSERT_EQ(results.size(), 1u);
    result_ = results[0].successful ? "" : results[0].reason;
  }

  rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("watcher");
  rclcpp::executors::SingleThreadedExecutor executor_;
  rclcpp::Subscription<AddTwoInts::Event>::SharedPtr subscription_;
  std::set<std::string> told_;
  std::string result_;
};

TEST_F(IntrospectionNodes, TellAsTheirParametersSay) {
  RunningCommand service(node("introspection_service", "service_configure_introspection:=contents"));
  RunningCommand client(node("introspection_client", "client_configure_introspection:=metadata"));
  EXPECT_TRUE(is_told({"0", "1 with contents", "2 with contents", "3"}))
      << testing::PrintToString(told_) << service.err() << client.err();
  EXPECT_TRUE(client.wait_for_output("[introspection_client]: Result of add_two_ints: 5")) << client.err();

  set("introspection_client", "client_configure_introspection", "contents");
  EXPECT_EQ(result_, "");
  EXPECT_TRUE(is_told({"0 with contents", "3 with contents"})) << testing::PrintToString(told_);
  set("introspection_client", "client_configure_introspection", "disabled");
  set("introspection_service", "service_configure_introspection", "disabled");
  EXPECT_TRUE(spin_until(executor_, [&] { return subscription_->get_publisher_count() == 0; }));
  set("introspection_service", "service_configure_introspection", "everything");
  EXPECT_EQ(result_, "must be one of 'disabled', 'metadata', or 'contents'");
  for (RunningCommand* command : {&service, &client}) {
    command->send_signal(SIGINT);
    const CommandResult result = command->wait();
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }
}

TEST_F(IntrospectionNodes, AnotherValueIsRefusedAtTheStart) {
  const CommandResult result = run_command(node("introspection_service", "service_configure_introspection:=some"));
  EXPECT_NE(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("parameter 'service_configure_introspection' could not be set: must be one of "
                                    "'disabled', 'metadata', or 'contents'"));
}

}  // namespace
