// SPDX-License-Identifier: Apache-2.0
// The graph as a node sees it, and waiting for a change of it.
#include <gmock/gmock.h>

#include <example_interfaces/srv/add_two_ints.hpp>
#include <std_msgs/msg/string.hpp>
#include <thread>

#include "tests/unit/rclcpp/ros_test.hpp"

namespace {

using example_interfaces::srv::AddTwoInts;
using std_msgs::msg::String;
using testing::Contains;
using testing::ElementsAre;
using testing::Key;
using testing::Not;
using testing::Pair;

class GraphTest : public RosTest {
 protected:
  // A node of another context: its endpoints are discovered like those of another process.
  class Elsewhere {
   public:
    explicit Elsewhere(const std::string& name) : context_(std::make_shared<rclcpp::Context>()) {
      context_->init(0, nullptr);
      node = std::make_shared<rclcpp::Node>(name, "there", rclcpp::NodeOptions().context(context_));
    }
    ~Elsewhere() {
      node.reset();
      context_->shutdown("the test is over");
    }

   private:
    rclcpp::Context::SharedPtr context_;

   public:
    rclcpp::Node::SharedPtr node;
  };

  // Waits for changes of the graph until `condition` holds.
  template <typename ConditionT>
  bool wait_for(ConditionT condition) {
    const auto event = node_->get_graph_event();
    const auto deadline = std::chrono::steady_clock::now() + kPatience;
    while (!condition() && std::chrono::steady_clock::now() < deadline) {
      node_->wait_for_graph_change(event, std::chrono::seconds(1));
      event->check_and_clear();
    }
    return condition();
  }

  const rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("watcher", "here");
};

TEST_F(GraphTest, TellsWhoPublishesAndSubscribesWithWhichQos) {
  const auto publisher = node_->create_publisher<String>("chatter", rclcpp::QoS(7).best_effort());
  const Elsewhere other("other");
  const auto subscription =
      other.node->create_subscription<String>("/here/chatter", rclcpp::QoS(5).transient_local(), [](const String&) {});
  ASSERT_TRUE(wait_for([&] {
    const auto infos = node_->get_subscriptions_info_by_topic("chatter");
    return infos.size() == 1 && infos[0].node_name() == "other";
  }));

  const auto publishers = node_->get_publishers_info_by_topic("chatter");
  ASSERT_EQ(publishers.size(), 1u);
  EXPECT_EQ(publishers[0].node_name(), "watcher");
  EXPECT_EQ(publishers[0].node_namespace(), "/here");
  EXPECT_EQ(publishers[0].topic_type(), "std_msgs/msg/String");
  EXPECT_EQ(publishers[0].endpoint_type(), rclcpp::EndpointType::Publisher);
  EXPECT_TRUE(
      std::equal(publishers[0].endpoint_gid().begin(), publishers[0].endpoint_gid().end(), publisher->get_gid().data));
  EXPECT_EQ(publishers[0].qos_profile().reliability(), rclcpp::ReliabilityPolicy::BestEffort);
  EXPECT_EQ(publishers[0].qos_profile().depth(), 7u);

  const auto subscriptions = node_->get_subscriptions_info_by_topic("chatter");
  EXPECT_EQ(subscriptions[0].node_namespace(), "/there");
  EXPECT_EQ(subscriptions[0].endpoint_type(), rclcpp::EndpointType::Subscription);
  EXPECT_EQ(subscriptions[0].qos_profile().reliability(), rclcpp::ReliabilityPolicy::Reliable);
  EXPECT_EQ(subscriptions[0].qos_profile().durability(), rclcpp::DurabilityPolicy::TransientLocal);
  EXPECT_EQ(subscriptions[0].qos_profile().history(), rclcpp::HistoryPolicy::Unknown);

  EXPECT_THAT(node_->get_publishers_info_by_topic("silence"), ElementsAre());
  const auto dds = node_->get_publishers_info_by_topic("rt/here/chatter", true);
  ASSERT_EQ(dds.size(), 1u);
  EXPECT_EQ(dds[0].topic_type(), "std_msgs::msg::dds_::String_");
}

TEST_F(GraphTest, TellsWhoCallsAndOffersAService) {
  const Elsewhere other("other");
  const auto service = other.node->create_service<AddTwoInts>(
      "/here/add", [](std::shared_ptr<AddTwoInts::Request>, std::shared_ptr<AddTwoInts::Response>) {},
      rclcpp::QoS(3).best_effort());
  const auto client = node_->create_client<AddTwoInts>("add");
  const auto second_client = node_->create_client<AddTwoInts>("add", rclcpp::QoS(7));
  const auto client_elsewhere = other.node->create_client<AddTwoInts>("/here/add");
  ASSERT_TRUE(wait_for([&] {
    return node_->get_servers_info_by_service("add").size() == 1 &&
           node_->get_clients_info_by_service("add").size() == 3;
  }));

  const rclcpp::ServiceEndpointInfo server = node_->get_servers_info_by_service("add")[0];
  EXPECT_EQ(server.node_name(), "other");
  EXPECT_EQ(server.node_namespace(), "/there");
  EXPECT_EQ(server.service_type(), "example_interfaces/srv/AddTwoInts");
  EXPECT_EQ(server.service_type_hash().version, 0);
  EXPECT_EQ(server.endpoint_type(), rclcpp::EndpointType::Server);
  EXPECT_EQ(server.endpoint_count(), 2u);
  ASSERT_EQ(server.endpoint_gids().size(), 2u);
  const auto reader = node_->get_subscriptions_info_by_topic("rq/here/addRequest", true);
  const auto writer = node_->get_publishers_info_by_topic("rr/here/addReply", true);
  ASSERT_EQ(reader.size(), 1u);
  ASSERT_EQ(writer.size(), 1u);
  EXPECT_EQ(server.endpoint_gids()[0], reader[0].endpoint_gid());
  EXPECT_EQ(server.endpoint_gids()[1], writer[0].endpoint_gid());
  ASSERT_EQ(server.qos_profiles().size(), 2u);
  EXPECT_EQ(server.qos_profiles()[0].reliability(), rclcpp::ReliabilityPolicy::BestEffort);

  std::vector<std::size_t> depths;
  for (const rclcpp::ServiceEndpointInfo& info : node_->get_clients_info_by_service("add")) {
    EXPECT_EQ(info.endpoint_type(), rclcpp::EndpointType::Client);
    // Both endpoints are of one client.
    EXPECT_EQ(info.qos_profiles()[0].depth(), info.qos_profiles()[1].depth());
    depths.push_back(info.qos_profiles()[0].depth());
  }
  EXPECT_THAT(depths, testing::UnorderedElementsAre(0u, 7u, 10u));  // unknown of the other context

  EXPECT_THAT(node_->get_servers_info_by_service("subtract"), ElementsAre());
  EXPECT_EQ(node_->get_servers_info_by_service("add", true)[0].service_type(),
            "example_interfaces::srv::dds_::AddTwoInts_Request_");
}

TEST_F(GraphTest, TellsWhatANodeHas) {
  const Elsewhere other("other");
  const auto service = other.node->create_service<AddTwoInts>(
      "add", [](std::shared_ptr<AddTwoInts::Request>, std::shared_ptr<AddTwoInts::Response>) {});
  const auto client = other.node->create_client<AddTwoInts>("subtract");
  const auto publisher = other.node->create_publisher<String>("chatter", 1);
  const auto subscription = other.node->create_subscription<String>("gossip", 1, [](const String&) {});
  const auto graph = node_->get_node_graph_interface();
  ASSERT_TRUE(wait_for([&] {
    const auto names = graph->get_node_names_and_namespaces();
    return std::count(names.begin(), names.end(), std::pair<std::string, std::string>("other", "/there")) == 1 &&
           graph->get_subscriber_names_and_types_by_node("other", "/there").count("/there/gossip") == 1 &&
           graph->get_publisher_names_and_types_by_node("other", "/there").count("/there/chatter") == 1 &&
           graph->get_client_names_and_types_by_node("other", "/there").count("/there/subtract") == 1;
  }));
  const std::vector<std::string> add = {"example_interfaces/srv/AddTwoInts"};
  const auto services = node_->get_service_names_and_types_by_node("other", "/there");
  EXPECT_THAT(services, Contains(Pair("/there/add", add)));
  EXPECT_THAT(services, Contains(Key("/there/other/get_parameters")));
  EXPECT_THAT(services, Not(Contains(Key("/there/subtract"))));
  EXPECT_THAT(graph->get_client_names_and_types_by_node("other", "/there"), ElementsAre(Pair("/there/subtract", add)));
  EXPECT_THAT(graph->get_publisher_names_and_types_by_node("other", "/there"),
              ElementsAre(Key("/parameter_events"), Key("/rosout"), Key("/there/chatter")));
  // A node has no subscription but its own. It learns of use_sim_time from its parameters, not from /parameter_events.
  EXPECT_THAT(graph->get_subscriber_names_and_types_by_node("other", "/there"), ElementsAre(Key("/there/gossip")));
  EXPECT_THAT(graph->get_subscriber_names_and_types_by_node("other", "/there", true),
              Contains(Pair("rt/there/gossip", ElementsAre("std_msgs::msg::dds_::String_"))));
  EXPECT_THAT(node_->get_service_names_and_types_by_node("watcher", "/here"), Not(Contains(Key("/there/add"))));
}

TEST_F(GraphTest, UnknownNodeIsAnError) {
  try {
    node_->get_service_names_and_types_by_node("nobody", "/");
    FAIL() << "there is such a node";
  } catch (const rclcpp::exceptions::RCLError& error) {
    EXPECT_EQ(error.ret, RCL_RET_NODE_NAME_NON_EXISTENT);
    EXPECT_THAT(error.what(), testing::StartsWith("failed to get service names and types by node: cannot get the names "
                                                  "of a node that is not known"));
  }
}

TEST_F(GraphTest, EventIsSetByAChangeUntilItIsCleared) {
  const auto event = node_->get_graph_event();
  EXPECT_FALSE(event->check());
  const auto publisher = node_->create_publisher<String>("chatter", 1);
  EXPECT_TRUE(event->check());
  EXPECT_TRUE(event->check_and_clear());
  EXPECT_FALSE(event->check_and_clear());
  EXPECT_FALSE(event->set());
  EXPECT_TRUE(event->check());
  EXPECT_TRUE(event->check_and_clear());
  EXPECT_FALSE(event->check());
  node_->wait_for_graph_change(event, std::chrono::milliseconds(1));
  EXPECT_FALSE(event->check());
  EXPECT_THROW(node_->wait_for_graph_change(nullptr, std::chrono::milliseconds(1)),
               rclcpp::exceptions::InvalidEventError);
}

TEST_F(GraphTest, ChangeWakesAllThatWaitAndSoDoesShutdown) {
  for (const bool shutdown : {false, true}) {
    std::vector<std::thread> threads;
    for (int i = 0; i < 3; ++i) {
      threads.emplace_back([this, event = node_->get_graph_event()] {
        node_->wait_for_graph_change(event, std::chrono::nanoseconds(-1));
      });
    }
    rclcpp::Publisher<String>::SharedPtr publisher;
    if (shutdown) {
      rclcpp::shutdown();
    } else {
      publisher = node_->create_publisher<String>("chatter", 1);
    }
    for (std::thread& thread : threads) {
      thread.join();
    }
  }
}

}  // namespace
