// SPDX-License-Identifier: Apache-2.0
// A hidden node of one command, from which it looks at the ROS graph and takes part in it.
#pragma once

#include <rcl/client.h>
#include <rcl/subscription.h>

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <rclcpp/rclcpp.hpp>
#include <string>
#include <vector>

#include "programs/rclcpp_versions/rclcpp_versions.hpp"

namespace launch {

using SessionClock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

// So long a command looks for what it has not found.
inline constexpr Seconds kLongestLook = rclcpp_versions::kLongestDiscovery;

// One at a time. All functions are called on one thread.
class GraphSession {
 public:
  // `name` is that of the node; empty: a hidden one. SIGINT and SIGTERM end waiting from now on.
  explicit GraphSession(const std::string& name = {});
  ~GraphSession();
  GraphSession(const GraphSession&) = delete;
  GraphSession& operator=(const GraphSession&) = delete;

  rclcpp::Node& node() { return *node_; }

  // How long services may take to answer; 10 seconds unless it was set.
  Seconds answer_time() const { return answer_time_; }
  void set_answer_time(Seconds time) { answer_time_ = time; }
  rcl_node_t& rcl_node();

  // Whether the user has asked to stop.
  static bool is_stopped();
  // So that what must be done before the end can wait. Only the next signal stops it.
  static void forget_stop();

  // Waits until all participants of this host have been found, and nothing more for a moment. With `time`: exactly so
  // long.
  void discover(std::optional<Seconds> time);
  // Waits until the services of this node and its topic of parameters have been heard of, as far as one of them tells
  // of the other: the node may itself have been found long before them.
  void hear_endpoints(const std::string& node);
  // Looks again after each change until `holds` is true. False when `time` is over or the user has asked to stop.
  bool wait_until(const std::function<bool()>& holds, std::optional<Seconds> time = std::nullopt);

  struct WakeUps {
    std::vector<const rcl_subscription_t*> subscriptions = {};
    std::vector<const rcl_client_t*> clients = {};
  };
  // Waits for one of these, for a change of the graph, for the signal or for the time.
  void wait(const WakeUps& wake_ups, SessionClock::time_point until);
  // Waits for the time, or for the signal.
  void sleep_until(SessionClock::time_point until);

 private:
  std::shared_ptr<rclcpp::Node> node_;
  bool has_found_host() const;
  bool has_heard_nodes() const;
  bool has_heard_services(const std::string& of_node = {}) const;  // empty: of all nodes

  SessionClock::time_point last_change_;
  SessionClock::duration lateness_{0};  // the longest time that a busy machine has kept this thread waiting
  Seconds answer_time_{10};
};

}  // namespace launch
