// SPDX-License-Identifier: Apache-2.0
// The messages that services and clients publish about their calls.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <example_interfaces/srv/add_two_ints.hpp>
#include <rclcpp/exceptions.hpp>
#include <string>
#include <thread>
#include <vector>

#include "tests/unit/rclcpp/ros_test.hpp"

namespace {

using example_interfaces::srv::AddTwoInts;
using service_msgs::msg::ServiceEventInfo;
using testing::IsEmpty;
using testing::SizeIs;
using Event = AddTwoInts::Event;

constexpr const char* kTopic = "/add_two_ints/_service_event";

// A subscription that comes late gets the earlier messages.
rclcpp::QoS event_qos() {
  return rclcpp::QoS(50).transient_local();
}

class ServiceIntrospection : public RosTest {
 protected:
  ServiceIntrospection() {
    executor_.add_node(node_);
    service_ = node_->create_service<AddTwoInts>(
        "add_two_ints", [](const AddTwoInts::Request::SharedPtr request, AddTwoInts::Response::SharedPtr response) {
          response->sum = request->a + request->b;
        });
    client_ = node_->create_client<AddTwoInts>("add_two_ints");
    EXPECT_TRUE(client_->wait_for_service(kPatience));
  }

  template <typename EndT>
  void configure(EndT& end, rcl_service_introspection_state_t state) {
    end.configure_introspection(node_->get_clock(), event_qos(), state);
  }

  void listen() {
    subscription_ = node_->create_subscription<Event>(kTopic, event_qos(),
                                                      [this](const Event& event) { events_.push_back(event); });
  }

  // The identity of the request.
  int64_t ask(int64_t a, int64_t b) {
    auto request = std::make_shared<AddTwoInts::Request>();
    request->a = a;
    request->b = b;
    auto future = client_->async_send_request(request);
    EXPECT_EQ(executor_.spin_until_future_complete(future, kPatience), rclcpp::FutureReturnCode::SUCCESS);
    EXPECT_EQ(future.get()->sum, a + b);
    return future.request_id;
  }

  // The messages of the two ends arrive in any order. They are put into the order of a call.
  std::vector<Event> take_events(size_t count) {
    EXPECT_TRUE(spin_until(executor_, [&] { return events_.size() >= count; })) << events_.size();
    std::vector<Event> events = std::move(events_);
    events_.clear();
    std::stable_sort(events.begin(), events.end(), [](const Event& a, const Event& b) {
      return std::make_pair(a.info.sequence_number, a.info.event_type) <
             std::make_pair(b.info.sequence_number, b.info.event_type);
    });
    return events;
  }

  bool topic_is_there() { return node_->get_topic_names_and_types().count(kTopic) > 0; }

  rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("node");
  rclcpp::executors::SingleThreadedExecutor executor_;
  rclcpp::Service<AddTwoInts>::SharedPtr service_;
  rclcpp::Client<AddTwoInts>::SharedPtr client_;
  rclcpp::Subscription<Event>::SharedPtr subscription_;
  std::vector<Event> events_;
};

TEST_F(ServiceIntrospection, TellsOfACallFourTimes) {
  const auto begin = node_->now();
  configure(*service_, RCL_SERVICE_INTROSPECTION_CONTENTS);
  configure(*client_, RCL_SERVICE_INTROSPECTION_CONTENTS);
  listen();
  const int64_t request_id = ask(2, 3);
  const std::vector<Event> events = take_events(4);
  ASSERT_THAT(events, SizeIs(4));
  for (uint8_t type = 0; type < 4; ++type) {
    const Event& event = events[type];
    EXPECT_EQ(event.info.event_type, type);
    EXPECT_EQ(event.info.sequence_number, request_id);
    EXPECT_EQ(event.info.client_gid, events[0].info.client_gid);
    const rclcpp::Time stamp(event.info.stamp, begin.get_clock_type());
    EXPECT_GE(stamp, begin);
    EXPECT_LE(stamp, node_->now());
    if (type == ServiceEventInfo::REQUEST_SENT || type == ServiceEventInfo::REQUEST_RECEIVED) {
      ASSERT_THAT(event.request, SizeIs(1));
      EXPECT_EQ(event.request[0].a, 2);
      EXPECT_EQ(event.request[0].b, 3);
      EXPECT_THAT(event.response, IsEmpty());
    } else {
      EXPECT_THAT(event.request, IsEmpty());
      ASSERT_THAT(event.response, SizeIs(1));
      EXPECT_EQ(event.response[0].sum, 5);
    }
  }
  EXPECT_NE(events[0].info.client_gid, (std::array<unsigned char, 16>{}));
}

TEST_F(ServiceIntrospection, ClientsAreToldApart) {
  configure(*service_, RCL_SERVICE_INTROSPECTION_METADATA);
  listen();
  ask(1, 1);
  const auto first = take_events(2);
  client_ = node_->create_client<AddTwoInts>("add_two_ints");
  ASSERT_TRUE(client_->wait_for_service(kPatience));
  ask(1, 1);
  const auto second = take_events(2);
  EXPECT_EQ(first.at(0).info.client_gid, first.at(1).info.client_gid);
  EXPECT_NE(first.at(0).info.client_gid, second.at(0).info.client_gid);
}

TEST_F(ServiceIntrospection, MetadataHasNeitherRequestNorResponse) {
  configure(*service_, RCL_SERVICE_INTROSPECTION_METADATA);
  configure(*client_, RCL_SERVICE_INTROSPECTION_METADATA);
  listen();
  ask(2, 3);
  const std::vector<Event> events = take_events(4);
  ASSERT_THAT(events, SizeIs(4));
  for (uint8_t type = 0; type < 4; ++type) {
    EXPECT_EQ(events[type].info.event_type, type);
    EXPECT_THAT(events[type].request, IsEmpty());
    EXPECT_THAT(events[type].response, IsEmpty());
  }
}

TEST_F(ServiceIntrospection, IsOffAtFirstAndAfterItWasTurnedOff) {
  ask(1, 2);
  EXPECT_FALSE(topic_is_there());
  configure(*service_, RCL_SERVICE_INTROSPECTION_CONTENTS);
  EXPECT_TRUE(topic_is_there());
  EXPECT_EQ(node_->get_topic_names_and_types().at(kTopic),
            std::vector<std::string>{"example_interfaces/srv/AddTwoInts_Event"});
  configure(*service_, RCL_SERVICE_INTROSPECTION_OFF);
  EXPECT_FALSE(topic_is_there());
  EXPECT_EQ(node_->count_publishers(kTopic), 0u);
}

TEST_F(ServiceIntrospection, IsChangedBetweenCalls) {
  listen();
  configure(*service_, RCL_SERVICE_INTROSPECTION_METADATA);
  ask(1, 2);
  configure(*service_, RCL_SERVICE_INTROSPECTION_CONTENTS);
  ask(3, 4);
  std::vector<Event> events = take_events(4);
  ASSERT_THAT(events, SizeIs(4));
  EXPECT_THAT(events[0].request, IsEmpty());
  EXPECT_THAT(events[1].response, IsEmpty());
  EXPECT_THAT(events[2].request, SizeIs(1));
  EXPECT_THAT(events[3].response, SizeIs(1));

  configure(*service_, RCL_SERVICE_INTROSPECTION_OFF);
  ask(5, 6);
  configure(*service_, RCL_SERVICE_INTROSPECTION_CONTENTS);
  ask(7, 8);
  events = take_events(2);
  ASSERT_THAT(events, SizeIs(2)) << "the call in between was told";
  EXPECT_EQ(events[0].request.at(0).a, 7);
  EXPECT_EQ(events[1].response.at(0).sum, 15);
}

TEST_F(ServiceIntrospection, TimesAreThoseOfTheClockWhichIsKept) {
  auto clock = std::make_shared<rclcpp::Clock>(RCL_ROS_TIME);
  ASSERT_EQ(rcl_enable_ros_time_override(clock->get_clock_handle()), RCL_RET_OK);
  ASSERT_EQ(rcl_set_ros_time_override(clock->get_clock_handle(), 3'000'000'007), RCL_RET_OK);
  service_->configure_introspection(clock, event_qos(), RCL_SERVICE_INTROSPECTION_METADATA);
  client_->configure_introspection(clock, event_qos(), RCL_SERVICE_INTROSPECTION_METADATA);
  clock.reset();
  listen();
  ask(1, 2);
  for (const Event& event : take_events(4)) {
    EXPECT_EQ(event.info.stamp.sec, 3);
    EXPECT_EQ(event.info.stamp.nanosec, 7u);
  }
}

template <typename EndT>
std::string refusal(EndT& end) {
  try {
    end.configure_introspection(nullptr, rclcpp::SystemDefaultsQoS(), RCL_SERVICE_INTROSPECTION_METADATA);
  } catch (const rclcpp::exceptions::RCLInvalidArgument& error) {
    // The rest is the place in the source.
    return std::string(error.what()).substr(0, std::string(error.what()).find(", at "));
  }
  return "accepted";
}

TEST_F(ServiceIntrospection, NeedsAClock) {
  EXPECT_EQ(refusal(*service_), "failed to configure service introspection: clock argument is null");
  EXPECT_EQ(refusal(*client_), "failed to configure client introspection: clock argument is null");
  EXPECT_FALSE(topic_is_there());
}

TEST_F(ServiceIntrospection, ServicesWhoseTypeIsKnownAtRunTimeHaveItToo) {
  service_.reset();
  const auto service =
      node_->create_generic_service("add_two_ints", "example_interfaces/srv/AddTwoInts",
                                    [](std::shared_ptr<void> request, std::shared_ptr<void> response) {
                                      const auto& asked = *static_cast<AddTwoInts::Request*>(request.get());
                                      static_cast<AddTwoInts::Response*>(response.get())->sum = asked.a + asked.b;
                                    });
  ASSERT_TRUE(client_->wait_for_service(kPatience));
  configure(*service, RCL_SERVICE_INTROSPECTION_CONTENTS);
  listen();
  ask(2, 3);
  const std::vector<Event> events = take_events(2);
  ASSERT_THAT(events, SizeIs(2));
  EXPECT_EQ(events[0].request.at(0).b, 3);
  EXPECT_EQ(events[1].response.at(0).sum, 5);
}

TEST_F(ServiceIntrospection, MayChangeWhileCallsGoOn) {
  std::atomic_bool done{false};
  std::thread changing([&] {
    while (!done) {
      for (const auto state :
           {RCL_SERVICE_INTROSPECTION_CONTENTS, RCL_SERVICE_INTROSPECTION_METADATA, RCL_SERVICE_INTROSPECTION_OFF}) {
        configure(*service_, state);
        configure(*client_, state);
      }
    }
  });
  for (int64_t i = 0; i < 100; ++i) {
    ask(i, 1);
  }
  done = true;
  changing.join();
  EXPECT_FALSE(topic_is_there());
}

}  // namespace
