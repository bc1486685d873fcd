// SPDX-License-Identifier: Apache-2.0
// Services and clients: every form of callback and of request, and calls when one side is missing.
#include <example_interfaces/srv/add_two_ints.hpp>
#include <thread>

#include "tests/unit/rclcpp/ros_test.hpp"

namespace {

using example_interfaces::srv::AddTwoInts;
using namespace std::chrono_literals;
using Header = std::shared_ptr<rmw_request_id_t>;
using Request = std::shared_ptr<AddTwoInts::Request>;
using Response = std::shared_ptr<AddTwoInts::Response>;
using AddClient = rclcpp::Client<AddTwoInts>;
using AddService = rclcpp::Service<AddTwoInts>;

Request make_request(int64_t a, int64_t b) {
  auto request = std::make_shared<AddTwoInts::Request>();
  request->a = a;
  request->b = b;
  return request;
}

class ServiceTest : public RosTest {
 protected:
  ServiceTest() { executor_.add_node(node_); }

  // Calls the service `add` and returns its answer.
  int64_t ask(int64_t a, int64_t b) {
    const auto client = node_->create_client<AddTwoInts>("add");
    EXPECT_TRUE(client->wait_for_service(kPatience));
    auto future = client->async_send_request(make_request(a, b));
    EXPECT_EQ(executor_.spin_until_future_complete(future, kPatience), rclcpp::FutureReturnCode::SUCCESS);
    return future.get()->sum;
  }

  rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("node", "ns");
  rclcpp::executors::SingleThreadedExecutor executor_;
};

TEST_F(ServiceTest, CallbackFillsInTheResponse) {
  const auto service = node_->create_service<AddTwoInts>(
      "add", [](const Request request, Response response) { response->sum = request->a + request->b; });
  EXPECT_STREQ(service->get_service_name(), "/ns/add");
  EXPECT_EQ(ask(2, 3), 5);
  EXPECT_EQ(node_->count_services("add"), 1u);
  EXPECT_EQ(node_->get_service_names_and_types().at("/ns/add"),
            std::vector<std::string>{"example_interfaces/srv/AddTwoInts"});
}

TEST_F(ServiceTest, CallbackMayLookAtTheHeader) {
  const auto service =
      node_->create_service<AddTwoInts>("add", [](const Header header, const Request request, Response response) {
        response->sum = 100 * header->sequence_number + request->a;
      });
  EXPECT_EQ(ask(2, 3), 102);
}

TEST_F(ServiceTest, ResponseMayBeSentByTheCallbackOrLater) {
  auto service = node_->create_service<AddTwoInts>(
      "add", [](std::shared_ptr<AddService> own, const Header header, const Request request) {
        AddTwoInts::Response response;
        response.sum = request->a + request->b;
        own->send_response(*header, response);
      });
  EXPECT_EQ(ask(1, 2), 3);

  service.reset();
  Header deferred;
  service = node_->create_service<AddTwoInts>("add", [&](const Header header, const Request) { deferred = header; });
  const auto timer = node_->create_wall_timer(1ms, [&] {
    if (deferred) {
      AddTwoInts::Response response;
      response.sum = 42;
      service->send_response(*deferred, response);
      deferred.reset();
    }
  });
  EXPECT_EQ(ask(1, 2), 42);
}

TEST_F(ServiceTest, ClientMayBeCalledBack) {
  const auto service = node_->create_service<AddTwoInts>(
      "add", [](const Request request, Response response) { response->sum = request->a + request->b; });
  const auto client = node_->create_client<AddTwoInts>("add");
  ASSERT_TRUE(client->wait_for_service(kPatience));
  int64_t sum = 0;
  const auto first =
      client->async_send_request(make_request(1, 2), [&](AddClient::SharedFuture future) { sum = future.get()->sum; });
  EXPECT_EQ(executor_.spin_until_future_complete(first, kPatience), rclcpp::FutureReturnCode::SUCCESS);
  EXPECT_EQ(sum, 3);
  const auto second = client->async_send_request(make_request(4, 5), [&](AddClient::SharedFutureWithRequest future) {
    sum = 100 * future.get().first->a + future.get().second->sum;
  });
  EXPECT_EQ(executor_.spin_until_future_complete(second, kPatience), rclcpp::FutureReturnCode::SUCCESS);
  EXPECT_EQ(sum, 409);
  EXPECT_EQ(client->prune_pending_requests(), 0u);
}

TEST_F(ServiceTest, RequestsStayPendingUntilTheyAreRemoved) {
  const auto client = node_->create_client<AddTwoInts>("nobody");
  EXPECT_FALSE(client->service_is_ready());
  EXPECT_FALSE(client->wait_for_service(1ms));
  const auto first = client->async_send_request(make_request(1, 2));
  EXPECT_TRUE(client->remove_pending_request(first));
  EXPECT_FALSE(client->remove_pending_request(first));

  const auto second = client->async_send_request(make_request(1, 2));
  const auto between = std::chrono::system_clock::now();
  EXPECT_EQ(client->prune_requests_older_than(between - 1h), 0u);
  std::vector<int64_t> pruned;
  EXPECT_EQ(client->prune_requests_older_than(between + 1h, &pruned), 1u);
  EXPECT_EQ(pruned, std::vector<int64_t>{second.request_id});
}

TEST_F(ServiceTest, WaitForServiceEndsWhenTheServiceComesOrTheContextEnds) {
  const auto client = node_->create_client<AddTwoInts>("add");
  rclcpp::Service<AddTwoInts>::SharedPtr service;
  std::thread starter([&] { service = node_->create_service<AddTwoInts>("add", [](Request, Response) {}); });
  EXPECT_TRUE(client->wait_for_service());
  starter.join();
  service.reset();

  const auto lonely = node_->create_client<AddTwoInts>("nobody");
  std::thread stopper([] { rclcpp::shutdown(); });
  EXPECT_FALSE(lonely->wait_for_service());
  stopper.join();
}

TEST_F(ServiceTest, ServesFromTheGroupItWasGiven) {
  const auto group = node_->create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive, false);
  const auto service = node_->create_service<AddTwoInts>(
      "add", [](const Request request, Response response) { response->sum = request->a; }, rclcpp::ServicesQoS(),
      group);
  EXPECT_EQ(group->size(), 1u);
  executor_.add_callback_group(group, node_->get_node_base_interface());
  EXPECT_EQ(ask(7, 0), 7);
  rclcpp::Node other("other");
  EXPECT_THROW(other.create_client<AddTwoInts>("add", rclcpp::ServicesQoS(), group), std::runtime_error);
}

TEST_F(ServiceTest, WrongNamesAreShown) {
  try {
    node_->create_client<AddTwoInts>("a dd");
    FAIL() << "the name was accepted";
  } catch (const rclcpp::exceptions::InvalidServiceNameError& error) {
    EXPECT_STREQ(error.what(),
                 "Invalid service name: topic name must not contain characters other than letters, digits, '_', '/', "
                 "'~', '{' and '}':\n"
                 "  'a dd'\n"
                 "    ^\n");
  }
}

}  // namespace
