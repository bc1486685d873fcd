// SPDX-License-Identifier: Apache-2.0
// launch topic info
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <type_traits>

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

template <typename Policy>
std::string text_of(Policy policy, const std::map<std::type_identity_t<Policy>, const char*>& names) {
  const auto found = names.find(policy);
  return found == names.end() ? "UNKNOWN" : found->second;
}

std::string history_text(const rmw_qos_profile_t& qos) {
  return qos.history == RMW_QOS_POLICY_HISTORY_KEEP_LAST
             ? fmt::format("KEEP_LAST ({})", qos.depth)
             : text_of(qos.history, {{RMW_QOS_POLICY_HISTORY_KEEP_ALL, "KEEP_ALL"},
                                     {RMW_QOS_POLICY_HISTORY_SYSTEM_DEFAULT, "SYSTEM_DEFAULT"}});
}

std::string reliability_text(const rmw_qos_profile_t& qos) {
  return text_of(qos.reliability, {{RMW_QOS_POLICY_RELIABILITY_RELIABLE, "RELIABLE"},
                                   {RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT, "BEST_EFFORT"},
                                   {RMW_QOS_POLICY_RELIABILITY_SYSTEM_DEFAULT, "SYSTEM_DEFAULT"}});
}

std::string durability_text(const rmw_qos_profile_t& qos) {
  return text_of(qos.durability, {{RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL, "TRANSIENT_LOCAL"},
                                  {RMW_QOS_POLICY_DURABILITY_VOLATILE, "VOLATILE"},
                                  {RMW_QOS_POLICY_DURABILITY_SYSTEM_DEFAULT, "SYSTEM_DEFAULT"}});
}

std::string liveliness_text(const rmw_qos_profile_t& qos) {
  return text_of(qos.liveliness, {{RMW_QOS_POLICY_LIVELINESS_AUTOMATIC, "AUTOMATIC"},
                                  {RMW_QOS_POLICY_LIVELINESS_MANUAL_BY_TOPIC, "MANUAL_BY_TOPIC"},
                                  {RMW_QOS_POLICY_LIVELINESS_SYSTEM_DEFAULT, "SYSTEM_DEFAULT"}});
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
      is_publisher ? "PUBLISHER" : "SUBSCRIPTION", gid, reliability_text(qos), history_text(qos), durability_text(qos),
      duration_text(qos.lifespan), duration_text(qos.deadline), liveliness_text(qos),
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
