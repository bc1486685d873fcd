// SPDX-License-Identifier: Apache-2.0
// launch topic info
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "programs/ros/graph_names.hpp"
#include "programs/ros/topic_graph.hpp"

namespace launch {

namespace {

std::string duration_text(const rmw_time_t& time) {
  const rmw_time_t infinite = RMW_DURATION_INFINITE;
  const rmw_time_t unspecified = RMW_DURATION_UNSPECIFIED;
  const auto is = [&](const rmw_time_t& other) { return time.sec == other.sec && time.nsec == other.nsec; };
  if (is(infinite) || is(unspecified)) {
    return "Infinite";
  }
  return fmt::format("{} nanoseconds", time.sec * 1'000'000'000 + time.nsec);
}

const char* text_of(rmw_qos_reliability_policy_t policy) {
  switch (policy) {
    case RMW_QOS_POLICY_RELIABILITY_RELIABLE:
      return "RELIABLE";
    case RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT:
      return "BEST_EFFORT";
    case RMW_QOS_POLICY_RELIABILITY_SYSTEM_DEFAULT:
      return "SYSTEM_DEFAULT";
    default:
      return "UNKNOWN";
  }
}

const char* text_of(rmw_qos_durability_policy_t policy) {
  switch (policy) {
    case RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL:
      return "TRANSIENT_LOCAL";
    case RMW_QOS_POLICY_DURABILITY_VOLATILE:
      return "VOLATILE";
    case RMW_QOS_POLICY_DURABILITY_SYSTEM_DEFAULT:
      return "SYSTEM_DEFAULT";
    default:
      return "UNKNOWN";
  }
}

const char* text_of(rmw_qos_liveliness_policy_t policy) {
  switch (policy) {
    case RMW_QOS_POLICY_LIVELINESS_AUTOMATIC:
      return "AUTOMATIC";
    case RMW_QOS_POLICY_LIVELINESS_MANUAL_BY_TOPIC:
      return "MANUAL_BY_TOPIC";
    case RMW_QOS_POLICY_LIVELINESS_SYSTEM_DEFAULT:
      return "SYSTEM_DEFAULT";
    default:
      return "UNKNOWN";
  }
}

std::string history_text(const rmw_qos_profile_t& qos) {
  switch (qos.history) {
    case RMW_QOS_POLICY_HISTORY_KEEP_LAST:
      return fmt::format("KEEP_LAST ({})", qos.depth);
    case RMW_QOS_POLICY_HISTORY_KEEP_ALL:
      return "KEEP_ALL";
    case RMW_QOS_POLICY_HISTORY_SYSTEM_DEFAULT:
      return "SYSTEM_DEFAULT";
    default:
      return "UNKNOWN";
  }
}

std::string hash_text(const rosidl_type_hash_t& hash) {
  if (hash.version == 0) {
    return "INVALID";
  }
  std::string text = fmt::format("RIHS{:02}_", hash.version);
  for (const std::uint8_t byte : hash.value) {
    text += fmt::format("{:02x}", byte);
  }
  return text;
}

// Several lines, without an end of the last one.
std::string endpoint_text(const rclcpp::TopicEndpointInfo& endpoint) {
  std::string gid;
  for (const std::uint8_t byte : endpoint.endpoint_gid()) {
    gid += fmt::format("{}{:02x}", gid.empty() ? "" : ".", byte);
  }
  const rmw_qos_profile_t& qos = endpoint.qos_profile().get_rmw_qos_profile();
  const bool is_publisher = endpoint.endpoint_type() == rclcpp::EndpointType::Publisher;
  return fmt::format(
      "Node name: {}\n"
      "Node namespace: {}\n"
      "Topic type: {}\n"
      "Topic type hash: {}\n"
      "Endpoint type: {}\n"
      "GID: {}\n"
      "QoS profile:\n"
      "  Reliability: {}\n"
      "  History (Depth): {}\n"
      "  Durability: {}\n"
      "  Lifespan: {}\n"
      "  Deadline: {}\n"
      "  Liveliness: {}\n"
      "  Liveliness lease duration: {}",
      endpoint.node_name(), endpoint.node_namespace(), endpoint.topic_type(), hash_text(endpoint.topic_type_hash()),
      is_publisher ? "PUBLISHER" : "SUBSCRIPTION", gid, text_of(qos.reliability), history_text(qos),
      text_of(qos.durability), duration_text(qos.lifespan), duration_text(qos.deadline), text_of(qos.liveliness),
      duration_text(qos.liveliness_lease_duration));
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
