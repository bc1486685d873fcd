// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <signal.h>

#include <future>
#include <memory>
#include <thread>

#include "tests/unit/rclcpp/ros_test.hpp"

using testing::ElementsAre;

namespace {

class InitTest : public RosTest {};

TEST_F(InitTest, IsOkBetweenInitAndShutdown) {
  EXPECT_TRUE(rclcpp::ok());
  EXPECT_TRUE(rclcpp::shutdown());
  EXPECT_FALSE(rclcpp::ok());
  EXPECT_FALSE(rclcpp::shutdown());
  EXPECT_EQ(rclcpp::contexts::get_global_default_context()->shutdown_reason(), "user called rclcpp::shutdown()");
  rclcpp::init(0, nullptr);
  EXPECT_TRUE(rclcpp::ok());
}

TEST_F(InitTest, InitTwiceIsRefused) {
  EXPECT_THROW(rclcpp::init(0, nullptr), rclcpp::ContextAlreadyInitialized);
}

TEST_F(InitTest, UnknownRosArgumentsAreNamed) {
  rclcpp::shutdown();
  const char* argv[] = {"test", "--ros-args", "--what", "--", "--mine"};
  try {
    rclcpp::init(5, argv);
    FAIL() << "no exception";
  } catch (const rclcpp::exceptions::UnknownROSArgsError& error) {
    EXPECT_STREQ(error.what(), "found unknown ROS arguments: '--what'");
    EXPECT_THAT(error.unknown_ros_args, ElementsAre("--what"));
  }
  EXPECT_FALSE(rclcpp::ok());
}

TEST_F(InitTest, MalformedRosArgumentsAreRefused) {
  rclcpp::shutdown();
  const char* argv[] = {"test", "--ros-args", "-p", "noassignment"};
  EXPECT_THROW(rclcpp::init(4, argv), rclcpp::exceptions::RCLInvalidROSArgsError);
  EXPECT_FALSE(rclcpp::ok());
}

TEST_F(InitTest, RosArgumentsCanBeRemoved) {
  const char* argv[] = {"test", "a", "--ros-args", "-p", "x:=1", "--", "b"};
  EXPECT_THAT(rclcpp::remove_ros_arguments(7, argv), ElementsAre("test", "a", "b"));
  rclcpp::shutdown();
  EXPECT_THAT(rclcpp::init_and_remove_ros_arguments(7, argv), ElementsAre("test", "a", "b"));
  EXPECT_TRUE(rclcpp::ok());
}

TEST_F(InitTest, NodeNamesAreRemapped) {
  init({"--ros-args", "-r", "__node:=other", "-r", "__ns:=/deep/down"});
  rclcpp::Node node("node");
  EXPECT_STREQ(node.get_name(), "other");
  EXPECT_STREQ(node.get_namespace(), "/deep/down");
  EXPECT_STREQ(node.get_fully_qualified_name(), "/deep/down/other");
}

TEST_F(InitTest, BadNodeNamesShowWhereTheyAreWrong) {
  try {
    rclcpp::Node node("bad-name");
    FAIL() << "no exception";
  } catch (const rclcpp::exceptions::InvalidNodeNameError& error) {
    EXPECT_EQ(error.invalid_index, 3u);
    EXPECT_THAT(error.what(), testing::StartsWith("Invalid node name: "));
    EXPECT_THAT(error.what(), testing::EndsWith(":\n  'bad-name'\n      ^\n"));
  }
  EXPECT_THROW(rclcpp::Node("node", "/bad//ns"), rclcpp::exceptions::InvalidNamespaceError);
  EXPECT_THROW(rclcpp::Node("node", rclcpp::NodeOptions().arguments({"--ros-args", "--what"})),
               rclcpp::exceptions::UnknownROSArgsError);
}

TEST_F(InitTest, ANodeNeedsInit) {
  auto context = std::make_shared<rclcpp::Context>();
  try {
    rclcpp::Node node("node", rclcpp::NodeOptions().context(context));
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "a node needs an initialized context: call rclcpp::init() first");
  }
}

TEST_F(InitTest, ShutdownRunsCallbacksInOrder) {
  // The context keeps its callbacks for the next shutdown, so they must not refer to this function.
  const auto calls = std::make_shared<std::vector<std::string>>();
  auto context = rclcpp::contexts::get_global_default_context();
  const auto pre =
      context->add_pre_shutdown_callback([calls] { calls->push_back(rclcpp::ok() ? "pre" : "pre, late"); });
  rclcpp::on_shutdown([calls] { calls->push_back(rclcpp::ok() ? "on, early" : "on"); });
  const auto removed = context->add_on_shutdown_callback([calls] { calls->push_back("removed"); });
  EXPECT_TRUE(context->remove_on_shutdown_callback(removed));
  EXPECT_FALSE(context->remove_on_shutdown_callback(removed));
  rclcpp::shutdown();
  EXPECT_THAT(*calls, ElementsAre("pre", "on"));
}

TEST_F(InitTest, SleepEndsWithTheContext) {
  std::promise<void> started;
  bool slept = true;
  std::thread sleeper([&] {
    started.set_value();
    slept = rclcpp::sleep_for(std::chrono::hours(1));
  });
  started.get_future().wait();
  rclcpp::shutdown();
  sleeper.join();
  EXPECT_FALSE(slept);
}

TEST_F(InitTest, SleepsForItsTime) {
  const auto start = std::chrono::steady_clock::now();
  EXPECT_TRUE(rclcpp::sleep_for(std::chrono::milliseconds(10)));
  EXPECT_GE(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(10));
  rclcpp::WallRate rate(std::chrono::milliseconds(5));
  EXPECT_TRUE(rate.sleep());
}

class SignalTest : public RosTest, public testing::WithParamInterface<int> {};

TEST_P(SignalTest, EndsSpin) {
  auto node = std::make_shared<rclcpp::Node>("node");
  auto timer = node->create_wall_timer(std::chrono::milliseconds(0), [](rclcpp::TimerBase& self) {
    self.cancel();
    raise(GetParam());
  });
  rclcpp::spin(node);
  EXPECT_FALSE(rclcpp::ok());
  EXPECT_EQ(rclcpp::contexts::get_global_default_context()->shutdown_reason(), "signal handler");
}

INSTANTIATE_TEST_SUITE_P(Signals, SignalTest, testing::Values(SIGINT, SIGTERM));

std::atomic<int> g_signals{0};

TEST_F(InitTest, SignalHandlersOfTheProgramAreCalledAndComeBack) {
  rclcpp::shutdown();
  EXPECT_FALSE(rclcpp::signal_handlers_installed());
  struct sigaction mine {};
  mine.sa_handler = [](int) { ++g_signals; };
  struct sigaction previous {};
  sigaction(SIGINT, &mine, &previous);
  rclcpp::init(0, nullptr, rclcpp::InitOptions(), rclcpp::SignalHandlerOptions::SigInt);
  EXPECT_TRUE(rclcpp::signal_handlers_installed());
  EXPECT_FALSE(rclcpp::install_signal_handlers());
  std::promise<void> ended;
  auto context = rclcpp::contexts::get_global_default_context();
  const auto callback = context->add_on_shutdown_callback([&] { ended.set_value(); });
  raise(SIGINT);
  EXPECT_EQ(ended.get_future().wait_for(kPatience), std::future_status::ready);
  EXPECT_TRUE(context->remove_on_shutdown_callback(callback));
  EXPECT_EQ(g_signals, 1);
  rclcpp::shutdown();
  raise(SIGINT);
  EXPECT_EQ(g_signals, 2);
  sigaction(SIGINT, &previous, nullptr);
}

TEST_F(InitTest, ContextsAreIndependent) {
  auto context = std::make_shared<rclcpp::Context>();
  rclcpp::InitOptions options;
  options.set_domain_id(7);
  context->init(0, nullptr, options);
  EXPECT_EQ(context->get_domain_id(), 7u);
  EXPECT_EQ(rclcpp::get_contexts().size(), 2u);
  auto node = std::make_shared<rclcpp::Node>("node", rclcpp::NodeOptions().context(context));
  context->shutdown("done");
  EXPECT_TRUE(rclcpp::ok());
  EXPECT_FALSE(rclcpp::ok(context));
  EXPECT_EQ(rclcpp::get_contexts().size(), 1u);
}

}  // namespace
