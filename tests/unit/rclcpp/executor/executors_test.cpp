// SPDX-License-Identifier: Apache-2.0
// The common behaviour of all executors.
#include <example_interfaces/srv/add_two_ints.hpp>
#include <future>
#include <memory>
#include <rclcpp/experimental/executors/events_executor/events_executor.hpp>
#include <std_msgs/msg/u_int64.hpp>
#include <string>
#include <thread>
#include <vector>

#include "tests/unit/rclcpp/ros_test.hpp"

using example_interfaces::srv::AddTwoInts;
using rclcpp::FutureReturnCode;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std_msgs::msg::UInt64;

namespace {

template <typename ExecutorT>
class ExecutorsTest : public RosTest {
 protected:
  // A timer that is always due.
  template <typename CallbackT>
  rclcpp::TimerBase::SharedPtr eager_timer(CallbackT callback) {
    return node_->create_wall_timer(milliseconds(0), callback);
  }

  // Spins in a thread until the callback has returned. The callback gets the executor.
  template <typename FunctionT>
  void beside_spin(FunctionT function) {
    std::promise<void> spinning;
    auto first = node_->create_wall_timer(milliseconds(0), [&](rclcpp::TimerBase& self) {
      self.cancel();
      spinning.set_value();
    });
    std::thread thread([this] { executor_.spin(); });
    spinning.get_future().wait();
    function();
    executor_.cancel();
    thread.join();
  }

  rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("node");
  ExecutorT executor_;
};

class ExecutorNames {
 public:
  template <typename ExecutorT>
  static std::string GetName(int) {
    if constexpr (std::is_same_v<ExecutorT, rclcpp::executors::SingleThreadedExecutor>) {
      return "SingleThreaded";
    } else if constexpr (std::is_same_v<ExecutorT, rclcpp::executors::StaticSingleThreadedExecutor>) {
      return "StaticSingleThreaded";
    } else if constexpr (std::is_same_v<ExecutorT, rclcpp::executors::MultiThreadedExecutor>) {
      return "MultiThreaded";
    } else if constexpr (std::is_same_v<ExecutorT, rclcpp::executors::EventsCBGExecutor>) {
      return "EventsCbg";
    } else {
      return "Events";
    }
  }
};

using Executors =
    ::testing::Types<rclcpp::executors::SingleThreadedExecutor, rclcpp::executors::StaticSingleThreadedExecutor,
                     rclcpp::executors::MultiThreadedExecutor, rclcpp::executors::EventsCBGExecutor,
                     rclcpp::experimental::executors::EventsExecutor>;
TYPED_TEST_SUITE(ExecutorsTest, Executors, ExecutorNames);

TYPED_TEST(ExecutorsTest, SpinSomeRunsWhatIsReadyOnce) {
  this->executor_.add_node(this->node_);
  int a = 0;
  int b = 0;
  auto timer_a = this->eager_timer([&a] { ++a; });
  auto timer_b = this->eager_timer([&b] { ++b; });
  this->executor_.spin_some();
  EXPECT_EQ(a + b, 2);
  EXPECT_FALSE(this->executor_.is_spinning());
}

TYPED_TEST(ExecutorsTest, SpinOnceRunsOneCallback) {
  this->executor_.add_node(this->node_);
  int calls = 0;
  auto timer_a = this->eager_timer([&calls] { ++calls; });
  auto timer_b = this->eager_timer([&calls] { ++calls; });
  this->executor_.spin_once();
  EXPECT_EQ(calls, 1);
}

TYPED_TEST(ExecutorsTest, SpinAllStopsAfterItsTime) {
  this->executor_.add_node(this->node_);
  int calls = 0;
  auto timer = this->eager_timer([&calls] { ++calls; });
  const auto give_up = std::chrono::steady_clock::now() + kPatience;
  while (calls < 10 && std::chrono::steady_clock::now() < give_up) {
    this->executor_.spin_all(milliseconds(5));  // returns, although there is always more
  }
  EXPECT_GE(calls, 10);
  EXPECT_THROW(this->executor_.spin_all(nanoseconds(-1)), std::invalid_argument);
}

TYPED_TEST(ExecutorsTest, SpinNodeOnceAndSomeAndAllServeANodeForAWhile) {
  int calls = 0;
  auto timer = this->eager_timer([&calls] { ++calls; });
  this->executor_.spin_node_once(this->node_);
  EXPECT_EQ(calls, 1);
  this->executor_.spin_node_some(this->node_);
  EXPECT_EQ(calls, 2);
  const auto give_up = std::chrono::steady_clock::now() + kPatience;
  while (calls < 3 && std::chrono::steady_clock::now() < give_up) {
    this->executor_.spin_node_all(this->node_, milliseconds(2));
  }
  EXPECT_GE(calls, 3);
  const int before = calls;
  this->executor_.spin_some();
  EXPECT_EQ(calls, before);
}

TYPED_TEST(ExecutorsTest, CancelFromACallbackEndsSpin) {
  this->executor_.add_node(this->node_);
  std::atomic<int> calls{0};
  auto timer = this->eager_timer([&] {
    ++calls;
    this->executor_.cancel();
  });
  this->executor_.spin();
  EXPECT_EQ(calls, 1);
  this->executor_.spin();  // spin() may be called again
  EXPECT_EQ(calls, 2);
}

TYPED_TEST(ExecutorsTest, CancelAndShutdownFromAnotherThreadEndSpin) {
  this->executor_.add_node(this->node_);
  this->beside_spin([] {});
  this->beside_spin([] { rclcpp::shutdown(); });
  this->executor_.spin();  // returns at once
}

TYPED_TEST(ExecutorsTest, SpinningTwiceIsRefused) {
  this->executor_.add_node(this->node_);
  std::string error;
  auto timer = this->eager_timer([&] {
    try {
      this->executor_.spin();
    } catch (const std::runtime_error& caught) {
      error = caught.what();
    }
    this->executor_.cancel();
  });
  this->executor_.spin();
  EXPECT_EQ(error, "spin() called while already spinning");
}

TYPED_TEST(ExecutorsTest, AnExceptionOfACallbackComesOutOfSpin) {
  this->executor_.add_node(this->node_);
  auto timer = this->eager_timer([] { throw std::logic_error("mine"); });
  EXPECT_THROW(this->executor_.spin(), std::logic_error);
  EXPECT_FALSE(this->executor_.is_spinning());
}

TYPED_TEST(ExecutorsTest, SpinUntilFutureCompleteTellsHowItEnded) {
  this->executor_.add_node(this->node_);
  std::promise<int> never;
  EXPECT_EQ(this->executor_.spin_until_future_complete(never.get_future(), milliseconds(5)), FutureReturnCode::TIMEOUT);
  std::promise<int> promise;
  auto future = promise.get_future();
  auto timer = this->node_->create_wall_timer(milliseconds(0), [&](rclcpp::TimerBase& self) {
    promise.set_value(3);
    self.cancel();
  });
  EXPECT_EQ(this->executor_.spin_until_future_complete(future, kPatience), FutureReturnCode::SUCCESS);
  EXPECT_EQ(future.get(), 3);
}

TYPED_TEST(ExecutorsTest, MessagesComeInOrderAndNoneIsForgotten) {
  this->executor_.add_node(this->node_);
  auto publisher = this->node_->template create_publisher<UInt64>("topic", 100);
  std::vector<uint64_t> received;
  auto subscription = this->node_->template create_subscription<UInt64>(
      "topic", 100, [&received](const UInt64& message) { received.push_back(message.data); });
  UInt64 message;
  for (message.data = 0; message.data < 50; ++message.data) {  // before the executor has seen the subscription
    publisher->publish(message);
  }
  ASSERT_TRUE(spin_until(this->executor_, [&] { return received.size() == 50; }));
  for (; message.data < 100; ++message.data) {
    publisher->publish(message);
  }
  ASSERT_TRUE(spin_until(this->executor_, [&] { return received.size() == 100; }));
  for (size_t i = 0; i < received.size(); ++i) {
    EXPECT_EQ(received[i], i);
  }
}

TYPED_TEST(ExecutorsTest, ServesServicesAndClients) {
  this->executor_.add_node(this->node_);
  auto service = this->node_->template create_service<AddTwoInts>(
      "add", [](const std::shared_ptr<AddTwoInts::Request> request, std::shared_ptr<AddTwoInts::Response> response) {
        response->sum = request->a + request->b;
      });
  auto client = this->node_->template create_client<AddTwoInts>("add");
  ASSERT_TRUE(client->wait_for_service(kPatience));
  auto request = std::make_shared<AddTwoInts::Request>();
  request->a = 2;
  request->b = 3;
  auto future = client->async_send_request(request);
  ASSERT_EQ(this->executor_.spin_until_future_complete(future, kPatience), FutureReturnCode::SUCCESS);
  EXPECT_EQ(future.get()->sum, 5);
}

TYPED_TEST(ExecutorsTest, NodesAndEntitiesMayComeAndGoWhileItSpins) {
  this->executor_.add_node(this->node_);
  this->beside_spin([this] {
    for (int round = 0; round < 5; ++round) {
      std::promise<void> timer_ran;
      auto timer = this->node_->create_wall_timer(milliseconds(0), [&](rclcpp::TimerBase& self) {
        self.cancel();
        timer_ran.set_value();
      });
      EXPECT_EQ(timer_ran.get_future().wait_for(kPatience), std::future_status::ready);

      auto other = std::make_shared<rclcpp::Node>("other");
      std::promise<void> received;
      auto publisher = other->create_publisher<UInt64>("other_topic", 1);
      auto subscription =
          other->create_subscription<UInt64>("other_topic", 1, [&](const UInt64&) { received.set_value(); });
      this->executor_.add_node(other);
      publisher->publish(UInt64());
      EXPECT_EQ(received.get_future().wait_for(kPatience), std::future_status::ready);
      if (round % 2 == 0) {
        this->executor_.remove_node(other);
      }
    }
  });
}

TYPED_TEST(ExecutorsTest, NothingOfARemovedNodeRuns) {
  this->executor_.add_node(this->node_);
  int calls = 0;
  auto timer_a = this->eager_timer([&calls] { ++calls; });
  auto timer_b = this->eager_timer([&calls] { ++calls; });
  this->executor_.spin_once();
  this->executor_.remove_node(this->node_);
  this->executor_.spin_once(milliseconds(0));
  EXPECT_EQ(calls, 1);
}

TYPED_TEST(ExecutorsTest, ATimerThatIsResetRunsAgain) {
  this->executor_.add_node(this->node_);
  std::promise<void> again;
  int calls = 0;
  auto timer = this->node_->create_wall_timer(milliseconds(1), [&](rclcpp::TimerBase& self) {
    self.cancel();
    if (++calls == 2) {
      again.set_value();
    }
  });
  auto done = again.get_future();
  ASSERT_TRUE(spin_until(this->executor_, [&] { return calls == 1; }));
  this->beside_spin([&] {
    timer->reset();
    EXPECT_EQ(done.wait_for(kPatience), std::future_status::ready);
  });
}

TYPED_TEST(ExecutorsTest, TellsItsGroupsByTheirOrigin) {
  auto by_hand = this->node_->create_callback_group(rclcpp::CallbackGroupType::Reentrant, false);
  this->executor_.add_callback_group(by_hand, this->node_->get_node_base_interface());
  this->executor_.add_node(this->node_);
  EXPECT_EQ(this->executor_.get_all_callback_groups().size(), 2u);
  ASSERT_EQ(this->executor_.get_manually_added_callback_groups().size(), 1u);
  EXPECT_EQ(this->executor_.get_manually_added_callback_groups()[0].lock(), by_hand);
  ASSERT_EQ(this->executor_.get_automatically_added_callback_groups_from_nodes().size(), 1u);
  EXPECT_EQ(this->executor_.get_automatically_added_callback_groups_from_nodes()[0].lock(),
            this->node_->get_node_base_interface()->get_default_callback_group());
  this->executor_.remove_callback_group(by_hand);
  EXPECT_EQ(this->executor_.get_all_callback_groups().size(), 1u);
}

// A client that spins for its answers may have been given a node that nobody keeps.
TYPED_TEST(ExecutorsTest, ServesAGroupThatOutlivesItsNode) {
  const auto group = this->node_->create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive, false);
  this->executor_.add_callback_group(group, this->node_->get_node_base_interface());
  const auto service = this->node_->template create_service<AddTwoInts>(
      "add",
      [](const AddTwoInts::Request::SharedPtr request, AddTwoInts::Response::SharedPtr response) {
        response->sum = request->a + request->b;
      },
      rclcpp::ServicesQoS(), group);
  const auto client = this->node_->template create_client<AddTwoInts>("add", rclcpp::ServicesQoS(), group);
  ASSERT_TRUE(client->wait_for_service(kPatience));
  this->node_.reset();
  auto request = std::make_shared<AddTwoInts::Request>();
  request->a = 1;
  request->b = 2;
  auto sum = client->async_send_request(request);
  ASSERT_EQ(this->executor_.spin_until_future_complete(sum, kPatience), FutureReturnCode::SUCCESS);
  EXPECT_EQ(sum.get()->sum, 3);
  EXPECT_EQ(this->executor_.get_manually_added_callback_groups().size(), 1U);
}

TYPED_TEST(ExecutorsTest, SurvivesWhatItServes) {
  auto timer = this->eager_timer([] {});
  auto subscription = this->node_->template create_subscription<UInt64>("topic", 1, [](const UInt64&) {});
  this->executor_.add_node(this->node_);
  this->executor_.spin_some();
  this->node_.reset();
  this->executor_.spin_some();
  subscription.reset();
  timer.reset();
  this->executor_.spin_some();
}

}  // namespace
