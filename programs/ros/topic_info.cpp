// SPDX-License-Identifier: Apache-2.0
// launch topic info
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <string>

#include "programs/rclcpp_versions/rclcpp_versions.hpp"
#include "programs/ros/endpoint_text.hpp"
#include "programs/ros/graph_names.hpp"
#include "programs/ros/topic_graph.hpp"

namespace launch {

namespace {

// Several lines, without an end of the last one.
std::string endpoint_text(const rclcpp::TopicEndpointInfo& endpoint) {
  const bool is_publisher = endpoint.endpoint_type() == rclcpp::EndpointType::Publisher;
  return fmt::format(
      "Node name: {}\n"
      "Node namespace: {}\n"
      "Topic type: {}\n"
      "Topic type hash: {}\n"
      "Endpoint type: {}\n"
      "GID: {}\n"
      "QoS profile:\n"
      "{}",
      endpoint.node_name(), endpoint.node_namespace(), endpoint.topic_type(), rclcpp_versions::type_hash_text(endpoint),
      is_publisher ? "PUBLISHER" : "SUBSCRIPTION", gid_text(endpoint), qos_text(endpoint, "  "));
}

class TopicInfo final : public Verb {
 public:
  void declare(CLI::App& app) override {
    app.add_option("topic", topic_, "name of the topic")->required();
    look_.declare(app);
    app.add_flag("-v,--verbose", verbose_, "also print node, type, GID and quality of service of each end");
  }

  int run() override {
    const std::string topic = full_name(topic_);
    GraphSession session;
    session.discover(look_.time());
    const std::vector<std::string> types = types_of(session, kTopics, topic);
    const char* const line_end = verbose_ ? "\n\n" : "\n";
    put(types.size() == 1 ? fmt::format("Type: {}{}", types.front(), line_end)
                          : fmt::format("Type: ['{}']{}", fmt::join(types, "', '"), line_end));
    put(fmt::format("Publisher count: {}{}", session.node().count_publishers(topic), line_end));
    if (verbose_) {
      put_endpoints(session.node().get_publishers_info_by_topic(topic));
    }
    put(fmt::format("Subscription count: {}{}", session.node().count_subscribers(topic), line_end));
    if (verbose_) {
      put_endpoints(session.node().get_subscriptions_info_by_topic(topic));
    }
    return 0;
  }

  std::vector<std::string> complete(const std::vector<std::string>& words) override {
    return words.empty() ? all_names(kTopics) : std::vector<std::string>();
  }

 private:
  static void put_endpoints(const std::vector<rclcpp::TopicEndpointInfo>& endpoints) {
    for (const rclcpp::TopicEndpointInfo& endpoint : endpoints) {
      put(endpoint_text(endpoint) + "\n\n");
    }
  }

  std::string topic_;
  LookOptions look_;
  bool verbose_ = false;
};

}  // namespace

std::vector<VerbInfo> topic_info_verbs() {
  return {{"topic", "info", "describes a topic", make_verb<TopicInfo>}};
}

}  // namespace launch
