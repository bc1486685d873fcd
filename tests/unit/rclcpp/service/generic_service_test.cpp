// SPDX-License-Identifier: Apache-2.0
// Clients and services of types of which only the name is known.
#include <gmock/gmock.h>

#include <example_interfaces/srv/add_two_ints.hpp>
#include <std_msgs/msg/string.hpp>

#include "tests/unit/rclcpp/ros_test.hpp"

namespace {

using example_interfaces::srv::AddTwoInts;
using testing::ElementsAre;
using Void = std::shared_ptr<void>;
using Header = std::shared_ptr<rmw_request_id_t>;

constexpr const char* kType = "example_interfaces/srv/AddTwoInts";

int64_t sum_of(const Void& request) {
  const auto& typed = *static_cast<AddTwoInts::Request*>(request.get());
  return typed.a + typed.b;
}

class GenericService : public RosTest {
 protected:
  GenericService() { executor_.add_node(node_); }

  // Asks the service "add" through a generic client.
  int64_t ask(int64_t a, int64_t b) {
    const auto client = node_->create_generic_client("add", kType);
    EXPECT_TRUE(client->wait_for_service(kPatience));
    AddTwoInts::Request request;
    request.a = a;
    request.b = b;
    auto future = client->async_send_request(&request);
    EXPECT_EQ(executor_.spin_until_future_complete(future, kPatience), rclcpp::FutureReturnCode::SUCCESS);
    return static_cast<AddTwoInts::Response*>(future.get().get())->sum;
  }

  rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("node", "ns");
  rclcpp::executors::SingleThreadedExecutor executor_;
};

TEST_F(GenericService, GenericClientAsksAnyService) {
  const auto service = node_->create_service<AddTwoInts>(
      "add", [](const std::shared_ptr<AddTwoInts::Request> request, std::shared_ptr<AddTwoInts::Response> response) {
        response->sum = request->a + request->b;
      });
  EXPECT_EQ(ask(2, 3), 5);
}

TEST_F(GenericService, GenericClientMakesRequestsAndReadsBytes) {
  const auto service = node_->create_service<AddTwoInts>(
      "add", [](const std::shared_ptr<AddTwoInts::Request> request, std::shared_ptr<AddTwoInts::Response> response) {
        response->sum = request->a + request->b;
      });
  const auto client = node_->create_generic_client("add", kType);
  ASSERT_TRUE(client->wait_for_service(kPatience));
  AddTwoInts::Request wanted;
  wanted.a = 40;
  wanted.b = 2;
  rclcpp::SerializedMessage bytes;
  rclcpp::Serialization<AddTwoInts::Request>().serialize_message(&wanted, &bytes);
  const Void request = client->create_request();
  rclcpp::SerializationBase(client->get_service_type_support_handle().request_typesupport)
      .deserialize_message(&bytes, request.get());
  std::vector<int64_t> sums;
  const auto future = client->async_send_request(request.get(), [&](rclcpp::GenericClient::SharedFuture answer) {
    sums.push_back(static_cast<AddTwoInts::Response*>(answer.get().get())->sum);
  });
  ASSERT_TRUE(spin_until(executor_, [&] { return !sums.empty(); }));
  EXPECT_THAT(sums, ElementsAre(42));
  EXPECT_FALSE(client->remove_pending_request(future));
}

TEST_F(GenericService, UnansweredRequestsCanBeRemoved) {
  const auto client = node_->create_generic_client("nobody", kType);
  AddTwoInts::Request request;
  const auto first = client->async_send_request(&request);
  const auto second = client->async_send_request(&request);
  EXPECT_TRUE(client->remove_pending_request(first));
  EXPECT_FALSE(client->remove_pending_request(first));
  std::vector<int64_t> pruned;
  EXPECT_EQ(client->prune_requests_older_than(std::chrono::system_clock::now() + std::chrono::hours(1), &pruned), 1u);
  EXPECT_THAT(pruned, ElementsAre(second.request_id));
  EXPECT_EQ(client->prune_pending_requests(), 0u);
}

TEST_F(GenericService, AnswersInEveryFormOfTheCallback) {
  {
    const auto service = node_->create_generic_service("add", kType, [](Void request, Void response) {
      static_cast<AddTwoInts::Response*>(response.get())->sum = sum_of(request);
    });
    EXPECT_STREQ(service->get_service_name(), "/ns/add");
    EXPECT_EQ(ask(1, 2), 3);
  }
  {
    const auto service = node_->create_generic_service("add", kType, [](Header header, Void request, Void response) {
      static_cast<AddTwoInts::Response*>(response.get())->sum = sum_of(request) * (header->sequence_number > 0 ? 1 : 0);
    });
    EXPECT_EQ(ask(3, 4), 7);
  }
  std::shared_ptr<rclcpp::GenericService> deferring;
  const auto answer_later = [&deferring](Header header, Void request) {
    Void response = deferring->create_response();
    static_cast<AddTwoInts::Response*>(response.get())->sum = sum_of(request);
    deferring->send_response(*header, response);
  };
  deferring = node_->create_generic_service("add", kType, answer_later);
  EXPECT_EQ(ask(5, 6), 11);
  deferring = node_->create_generic_service(
      "add", kType, [](std::shared_ptr<rclcpp::GenericService> self, Header header, Void request) {
        Void response = self->create_response();
        static_cast<AddTwoInts::Response*>(response.get())->sum = sum_of(request);
        self->send_response(*header, response);
      });
  EXPECT_EQ(ask(7, 8), 15);
}

TEST_F(GenericService, UnknownTypeIsAnException) {
  EXPECT_THROW(node_->create_generic_client("add", "example_interfaces/srv/Divide"), std::runtime_error);
  EXPECT_THROW(node_->create_generic_client("add", "no_such_package/srv/Divide"), std::runtime_error);
  EXPECT_THROW(node_->create_generic_service("add", "AddTwoInts", [](Void, Void) {}), std::runtime_error);
  EXPECT_THROW(node_->create_generic_client("not a name", kType), rclcpp::exceptions::InvalidServiceNameError);
}

TEST_F(GenericService, EntitiesAreMadeFromNodeInterfacesAlone) {
  const auto service = rclcpp::create_service<AddTwoInts>(
      node_->get_node_base_interface(), node_->get_node_services_interface(), "add",
      [](const std::shared_ptr<AddTwoInts::Request> request, std::shared_ptr<AddTwoInts::Response> response) {
        response->sum = request->a - request->b;
      },
      rclcpp::ServicesQoS(), nullptr);
  const auto client = rclcpp::create_client<AddTwoInts>(
      node_->get_node_base_interface(), node_->get_node_graph_interface(), node_->get_node_services_interface(), "add");
  EXPECT_TRUE(client->wait_for_service(kPatience));
  const auto generic = rclcpp::create_generic_client(node_, "add", kType);
  EXPECT_TRUE(generic->wait_for_service(kPatience));
  const auto publisher = rclcpp::create_publisher<std_msgs::msg::String>(node_->get_node_parameters_interface(),
                                                                         node_->get_node_topics_interface(), "text", 1);
  std::vector<std::string> received;
  const auto subscription = rclcpp::create_subscription<std_msgs::msg::String>(
      node_->get_node_parameters_interface(), node_->get_node_topics_interface(), "text", 1,
      [&](const std_msgs::msg::String& message) { received.push_back(message.data); });
  ASSERT_TRUE(spin_until(executor_, [&] { return publisher->get_subscription_count() == 1; }));
  std_msgs::msg::String message;
  message.data = "hello";
  publisher->publish(message);
  ASSERT_TRUE(spin_until(executor_, [&] { return !received.empty(); }));
  EXPECT_THAT(received, ElementsAre("hello"));
}

}  // namespace
