// SPDX-License-Identifier: Apache-2.0
// Requests and responses between contexts, which are different participants.
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>
#include <vector>

#include "example_interfaces/srv/add_two_ints.hpp"
#include "rmw_test.hpp"
#include "rosidl_typesupport_cpp/service_type_support.hpp"
#include "service/service_clients.hpp"
#include "service_ends.hpp"
#include "std_srvs/srv/trigger.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using example_interfaces::srv::AddTwoInts;
using rmw_test::Client;
using rmw_test::Context;
using rmw_test::kPatience;
using rmw_test::Node;
using rmw_test::Service;
using rmw_test::take_error;
using rmw_test::type_support;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr rmw_time_t kNoWait{0, 0};

class ServiceTest : public testing::Test {
 protected:
  test_support::Sandbox sandbox_;
  Context serving_context_;
  Context asking_context_;
  Node server_{serving_context_, "server"};
  Node asker_{asking_context_, "asker"};
};

TEST_F(ServiceTest, AnswersEachRequestWithItsSequenceNumber) {
  Service service(server_, "/add");
  Client client(asker_, "/add");
  client.wait_for_service();
  rmw_time_point_value_t before = 0;
  ASSERT_EQ(rcutils_system_time_now(&before), RCUTILS_RET_OK);
  for (int64_t i = 1; i <= 3; ++i) {
    EXPECT_EQ(client.send(i, 10), i);
    rmw_service_info_t request_info{};
    AddTwoInts::Request request;
    ASSERT_EQ(service.wait(kPatience), RMW_RET_OK);
    ASSERT_TRUE(service.take(request_info, request));
    EXPECT_EQ(request.a, i);
    EXPECT_EQ(request.b, 10);
    EXPECT_EQ(request_info.request_id.sequence_number, i);
    EXPECT_GE(request_info.source_timestamp, before);
    EXPECT_GE(request_info.received_timestamp, request_info.source_timestamp);
    ASSERT_EQ(service.respond(request_info, request.a + request.b), RMW_RET_OK) << take_error();

    rmw_service_info_t info{};
    AddTwoInts::Response response;
    ASSERT_EQ(client.wait(kPatience), RMW_RET_OK);
    ASSERT_TRUE(client.take(info, response));
    EXPECT_EQ(response.sum, i + 10);
    EXPECT_EQ(info.request_id.sequence_number, i);
    EXPECT_TRUE(std::equal(std::begin(info.request_id.writer_guid), std::end(info.request_id.writer_guid),
                           std::begin(request_info.request_id.writer_guid)));
    EXPECT_GE(info.source_timestamp, request_info.source_timestamp);
  }
}

TEST_F(ServiceTest, ResponseForAnotherClientIsNotTaken) {
  Service service(server_, "/add");
  Client asking(asker_, "/add");
  Client other(asker_, "/add");
  asking.wait_for_service();
  other.wait_for_service();
  rmw_service_info_t info{};
  AddTwoInts::Response response;
  // After its own call the service knows this client, too, and sends it the response for the other one.
  other.send(0, 0);
  service.serve();
  ASSERT_EQ(other.wait(kPatience), RMW_RET_OK);
  ASSERT_TRUE(other.take(info, response));

  asking.send(1, 2);
  service.serve();
  ASSERT_EQ(other.wait(kPatience), RMW_RET_OK);
  EXPECT_FALSE(other.take(info, response));
  EXPECT_EQ(other.wait(kNoWait), RMW_RET_TIMEOUT);
  do {  // it may have heard the first response
    ASSERT_EQ(asking.wait(kPatience), RMW_RET_OK);
  } while (!asking.take(info, response));
  EXPECT_EQ(response.sum, 3);
}

TEST_F(ServiceTest, IsAvailableWhileItExists) {
  Client client(asker_, "/add");
  EXPECT_FALSE(client.is_available());
  auto service = std::make_unique<Service>(server_, "/add");
  client.wait_for_service();
  EXPECT_TRUE(client.is_available());
  service.reset();
  asker_.wait_for_graph([&] { return !client.is_available(); });
}

TEST_F(ServiceTest, ResponseToAClientThatIsGoneIsDroppedSilently) {
  Service service(server_, "/add");
  auto client = std::make_unique<Client>(asker_, "/add");
  client->wait_for_service();
  client->send(1, 2);
  rmw_service_info_t info{};
  AddTwoInts::Request request;
  ASSERT_EQ(service.wait(kPatience), RMW_RET_OK);
  ASSERT_TRUE(service.take(info, request));
  client.reset();
  size_t clients = 1;
  server_.wait_for_graph([&] {
    EXPECT_EQ(rmw_count_clients(server_.handle, "/add", &clients), RMW_RET_OK);
    return clients == 0;
  });
  EXPECT_EQ(service.respond(info, 3), RMW_RET_OK) << take_error();
}

TEST_F(ServiceTest, GraphKnowsServicesByNameAndType) {
  Service service(server_, "/math/add");
  Client client(server_, "/math/add");
  asker_.wait_for_graph([&] {
    size_t services = 0;
    size_t clients = 0;
    EXPECT_EQ(rmw_count_services(asker_.handle, "/math/add", &services), RMW_RET_OK);
    EXPECT_EQ(rmw_count_clients(asker_.handle, "/math/add", &clients), RMW_RET_OK);
    return services == 1 && clients == 1;
  });
  rmw_names_and_types_t found = rmw_get_zero_initialized_names_and_types();
  rcutils_allocator_t allocator = rcutils_get_default_allocator();
  ASSERT_EQ(rmw_get_service_names_and_types(asker_.handle, &allocator, &found), RMW_RET_OK);
  ASSERT_EQ(found.names.size, 1u);
  EXPECT_STREQ(found.names.data[0], "/math/add");
  ASSERT_EQ(found.types[0].size, 1u);
  EXPECT_STREQ(found.types[0].data[0], "example_interfaces/srv/AddTwoInts");
  EXPECT_EQ(rmw_names_and_types_fini(&found), RMW_RET_OK);
}

TEST_F(ServiceTest, HasTheQosThatItWasMadeWith) {
  Service service(server_, "/add");
  Client client(asker_, "/add");
  rmw_qos_profile_t qos;
  ASSERT_EQ(rmw_service_request_subscription_get_actual_qos(service.handle, &qos), RMW_RET_OK);
  EXPECT_EQ(qos.reliability, RMW_QOS_POLICY_RELIABILITY_RELIABLE);
  EXPECT_EQ(qos.depth, 10u);
  ASSERT_EQ(rmw_client_request_publisher_get_actual_qos(client.handle, &qos), RMW_RET_OK);
  EXPECT_EQ(qos.durability, RMW_QOS_POLICY_DURABILITY_VOLATILE);
}

TEST_F(ServiceTest, NameAndTypeMustFit) {
  EXPECT_EQ(rmw_create_service(server_.handle, type_support<AddTwoInts>(), "add", &rmw_qos_profile_services_default),
            nullptr);
  EXPECT_EQ(take_error(), "invalid topic name 'add': topic name must be absolute: it must begin with a '/'");
  Service service(server_, "/add");
  EXPECT_EQ(rmw_create_client(server_.handle, type_support<std_srvs::srv::Trigger>(), "/add",
                              &rmw_qos_profile_services_default),
            nullptr);
  EXPECT_EQ(take_error(),
            "topic 'rr/addReply' is in use with type 'example_interfaces::srv::dds_::AddTwoInts_Response_' and cannot "
            "have type 'std_srvs::srv::dds_::Trigger_Response_' as well");
}

TEST_F(ServiceTest, WaitSetOutlivesAndIsOutlivedByWhatItWaitedFor) {
  rmw_wait_set_t* wait_set = rmw_create_wait_set(&serving_context_.handle, 2);
  for (int i = 0; i < 3; ++i) {
    // A new service may have the address of the old one: it must be waited for all the same. It has another name,
    // because the client could find the old service, whose end takes a while to arrive, and send the request there.
    const std::string name = "/add_" + std::to_string(i);
    Service service(server_, name.c_str());
    Client client(asker_, name.c_str());
    client.wait_for_service();
    void* entity = service.handle->data;
    rmw_services_t services{1, &entity};
    constexpr rmw_time_t kAMillisecond{0, 1000000};
    EXPECT_EQ(rmw_wait(nullptr, nullptr, &services, nullptr, nullptr, wait_set, &kAMillisecond), RMW_RET_TIMEOUT);
    client.send(1, i);
    entity = service.handle->data;
    EXPECT_EQ(rmw_wait(nullptr, nullptr, &services, nullptr, nullptr, wait_set, &kPatience), RMW_RET_OK);
  }
  EXPECT_EQ(rmw_destroy_wait_set(wait_set), RMW_RET_OK);
}

using rmw_fastrtps::Gid;
using rmw_fastrtps::ServiceClients;

TEST(ServiceClients, ResponsesWaitForTheReaderOfTheClient) {
  ServiceClients clients;
  const Gid reader{1};
  std::vector<int> sent;
  clients.request_taken(reader, Gid{2});
  EXPECT_EQ(clients.presence_of(reader), ServiceClients::Presence::kUnmatched);
  EXPECT_TRUE(clients.send_when_matched(reader, [&] { sent.push_back(1); }));
  EXPECT_TRUE(clients.send_when_matched(reader, [&] { sent.push_back(2); }));
  EXPECT_THAT(sent, IsEmpty());
  clients.reader_matched(Gid{3});
  EXPECT_THAT(sent, IsEmpty());
  clients.reader_matched(reader);
  EXPECT_THAT(sent, ElementsAre(1, 2));
  EXPECT_EQ(clients.presence_of(reader), ServiceClients::Presence::kMatched);
  EXPECT_TRUE(clients.send_when_matched(reader, [&] { sent.push_back(3); }));
  EXPECT_THAT(sent, ElementsAre(1, 2, 3));
}

TEST(ServiceClients, TheEndWaitsForResponses) {
  ServiceClients clients;
  clients.request_taken(Gid{1}, Gid{2});
  bool is_sent = false;
  EXPECT_TRUE(clients.send_when_matched(Gid{1}, [&] { is_sent = true; }));
  std::thread discovery([&] { clients.reader_matched(Gid{1}); });
  clients.wait_until_sent(std::chrono::hours(1));
  EXPECT_TRUE(is_sent);
  discovery.join();
  clients.wait_until_sent(std::chrono::hours(1));
}

TEST(ServiceClients, TooManyResponsesDoNotWait) {
  ServiceClients clients;
  clients.request_taken(Gid{1}, Gid{2});
  for (std::size_t i = 0; i < ServiceClients::kMostWaiting; ++i) {
    EXPECT_TRUE(clients.send_when_matched(Gid{1}, [] {}));
  }
  EXPECT_FALSE(clients.send_when_matched(Gid{1}, [] {}));
}

TEST(ServiceClients, ClientIsGoneWithEitherOfItsEndpoints) {
  ServiceClients clients;
  for (const bool writer_goes : {true, false}) {
    const Gid reader{1};
    clients.request_taken(reader, Gid{2});
    EXPECT_TRUE(clients.send_when_matched(reader, [] { FAIL() << "sent to nobody"; }));
    if (writer_goes) {
      clients.writer_unmatched(Gid{2});
    } else {
      clients.reader_unmatched(reader);
    }
    EXPECT_EQ(clients.presence_of(reader), ServiceClients::Presence::kGone);
    EXPECT_TRUE(clients.send_when_matched(reader, [] { FAIL() << "sent to nobody"; }));
    clients.reader_matched(reader);
    clients.reader_unmatched(reader);
  }
}

}  // namespace
