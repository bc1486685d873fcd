// SPDX-License-Identifier: Apache-2.0
#include "programs/ros/graph_session.hpp"

#include <fmt/format.h>
#include <rcl/graph.h>
#include <rcl/wait.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <rclcpp/exceptions.hpp>

#include "programs/ros/calculations/participants.hpp"

namespace launch {

namespace {

// A participant is found within a few hundredths of a second, and announced anew each tenth. On a busy machine this and
// what it has to tell may take longer, as everything does.
constexpr std::chrono::milliseconds kShortestLook{300};
constexpr std::chrono::milliseconds kQuiet{200};
constexpr int kQuietOfLateness = 5;
// Each participant tells its nodes on this topic of DDS.
constexpr const char* kTopicOfParticipants = "ros_discovery_info";
constexpr const char* kUnknownNode = "_NODE_NAME_UNKNOWN_";
constexpr const char* kTopicsOfMostNodes[] = {"rt/rosout", "rt/parameter_events"};
// It tells them a moment after it was found. One that has no node tells none.
constexpr std::chrono::milliseconds kLongestSilence{1000};
// Matches are no changes of the graph, and a signal may come just before a wait.
constexpr std::chrono::milliseconds kPatience{50};

volatile sig_atomic_t stopped = 0;

void stop(int /*signal*/) {
  stopped = 1;
}

void require_ok(rcl_ret_t ret) {
  if (ret != RCL_RET_OK) {
    rclcpp::exceptions::throw_from_rcl_error(ret, "cannot wait for the graph");
  }
}

EndpointGid gid_of(const rclcpp::TopicEndpointInfo& endpoint) {
  EndpointGid gid{};  // that of Humble is longer
  std::copy_n(endpoint.endpoint_gid().begin(), gid.size(), gid.begin());
  return gid;
}

std::string full_name(const rclcpp::TopicEndpointInfo& endpoint) {
  const std::string& space = endpoint.node_namespace();
  return (space == "/" ? space : space + "/") + endpoint.node_name();
}

class WaitSet {
 public:
  WaitSet(const GraphSession::WakeUps& wake_ups, rcl_context_t* context) {
    require_ok(rcl_wait_set_init(&set_, wake_ups.subscriptions.size(), 1, 0, wake_ups.clients.size(), 0, 0, context,
                                 rcl_get_default_allocator()));
  }
  ~WaitSet() { (void)rcl_wait_set_fini(&set_); }
  WaitSet(const WaitSet&) = delete;
  WaitSet& operator=(const WaitSet&) = delete;

  rcl_wait_set_t& set() { return set_; }

 private:
  rcl_wait_set_t set_ = rcl_get_zero_initialized_wait_set();
};

}  // namespace

GraphSession::GraphSession(const std::string& name) {
  rclcpp::init(0, nullptr, rclcpp::InitOptions().auto_initialize_logging(false), rclcpp::SignalHandlerOptions::None);
  struct sigaction action {};
  action.sa_handler = stop;
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
  node_ = std::make_shared<rclcpp::Node>(name.empty() ? fmt::format("_launch_{}", ::getpid()) : name,
                                         rclcpp::NodeOptions()
                                             .start_parameter_services(false)
                                             .start_parameter_event_publisher(false)
                                             .enable_rosout(false)
                                             .use_global_arguments(false));
  last_change_ = SessionClock::now();
}

GraphSession::~GraphSession() {
  node_.reset();
  rclcpp::shutdown();
}

rcl_node_t& GraphSession::rcl_node() {
  return *node_->get_node_base_interface()->get_rcl_node_handle();
}

bool GraphSession::is_stopped() {
  return stopped != 0;
}

void GraphSession::forget_stop() {
  stopped = 0;
}

void GraphSession::discover(std::optional<Seconds> time) {
  const SessionClock::time_point begin = SessionClock::now();
  const auto longest = begin + std::chrono::duration_cast<SessionClock::duration>(time.value_or(kLongestLook));
  while (!is_stopped() && SessionClock::now() < longest) {
    const SessionClock::time_point quiet =
        std::max(last_change_ + kQuiet + kQuietOfLateness * lateness_, begin + kShortestLook);
    if (time || SessionClock::now() < quiet) {
      wait({}, time ? longest : std::min(quiet, longest));
    } else if (has_found_host() &&
               ((has_heard_nodes() && has_heard_services()) || SessionClock::now() >= quiet + kLongestSilence)) {
      return;
    } else {
      wait({}, longest);
    }
  }
}

bool GraphSession::has_found_host() const {
  constexpr bool kNameOfDds = true;
  return node_->get_publishers_info_by_topic(kTopicOfParticipants, kNameOfDds).size() >=
         participants_of_host(node_->get_node_base_interface()->get_context()->get_domain_id());
}

bool GraphSession::has_heard_nodes() const {
  constexpr bool kNameOfDds = true;
  std::vector<EndpointGid> participants;
  for (const auto& endpoint : node_->get_publishers_info_by_topic(kTopicOfParticipants, kNameOfDds)) {
    participants.push_back(gid_of(endpoint));
  }
  std::vector<EndpointOfNode> endpoints;
  for (const char* const topic : kTopicsOfMostNodes) {
    for (const auto& endpoint : node_->get_publishers_info_by_topic(topic, kNameOfDds)) {
      if (endpoint.node_name() != kUnknownNode) {
        endpoints.push_back({gid_of(endpoint), endpoint.node_namespace() + "/" + endpoint.node_name()});
      }
    }
  }
  return have_told_nodes(participants, endpoints, node_->get_node_names().size());
}

// Almost each node that tells changes of its parameters has services for them. They may be heard of seconds later.
bool GraphSession::has_heard_services(const std::string& of_node) const {
  constexpr bool kNameOfDds = true;
  const auto services = node_->get_service_names_and_types();
  const auto endpoints = node_->get_publishers_info_by_topic("rt/parameter_events", kNameOfDds);
  return std::all_of(endpoints.begin(), endpoints.end(), [&](const auto& endpoint) {
    const std::string node = full_name(endpoint);
    const std::string service = node + "/list_parameters";
    // It is there as soon as what answers is heard of. What takes requests comes with the subscriptions of the node.
    return endpoint.node_name() == kUnknownNode || (!of_node.empty() && node != of_node) ||
           (services.count(service) != 0 &&
            !node_->get_subscriptions_info_by_topic("rq" + service + "Request", kNameOfDds).empty());
  });
}

// What has services for parameters tells their changes, too. Publications and subscriptions come one after the other.
void GraphSession::hear_endpoints(const std::string& node) {
  const auto has_heard = [&] {
    const auto services = node_->get_service_names_and_types();
    const auto endpoints = node_->get_publishers_info_by_topic("/parameter_events");
    const bool tells_changes = std::any_of(endpoints.begin(), endpoints.end(),
                                           [&](const auto& endpoint) { return full_name(endpoint) == node; });
    return has_heard_services(node) && (tells_changes || services.count(node + "/list_parameters") == 0);
  };
  if (!has_heard()) {
    (void)wait_until(has_heard, kLongestLook);
    discover(std::nullopt);  // more of the node may follow
  }
}

bool GraphSession::wait_until(const std::function<bool()>& holds, std::optional<Seconds> time) {
  const auto end = time ? SessionClock::now() + std::chrono::duration_cast<SessionClock::duration>(*time)
                        : SessionClock::time_point::max();
  while (true) {
    if (holds()) {
      return true;
    }
    if (is_stopped() || SessionClock::now() >= end) {
      return false;
    }
    wait({}, end);
  }
}

void GraphSession::wait(const WakeUps& wake_ups, SessionClock::time_point until) {
  const auto now = SessionClock::now();
  if (is_stopped()) {
    return;
  }
  const auto time = std::clamp<SessionClock::duration>(until - now, SessionClock::duration(0), kPatience);
  rcl_node_t* const node = &rcl_node();
  WaitSet wait(wake_ups, node->context);
  const rcl_guard_condition_t* const graph = rcl_node_get_graph_guard_condition(node);
  require_ok(rcl_wait_set_add_guard_condition(&wait.set(), graph, nullptr));
  for (const rcl_subscription_t* subscription : wake_ups.subscriptions) {
    require_ok(rcl_wait_set_add_subscription(&wait.set(), subscription, nullptr));
  }
  for (const rcl_client_t* client : wake_ups.clients) {
    require_ok(rcl_wait_set_add_client(&wait.set(), client, nullptr));
  }
  const rcl_ret_t ret = rcl_wait(&wait.set(), std::chrono::nanoseconds(time).count());
  lateness_ = std::max(lateness_, SessionClock::now() - (now + time));
  if (ret == RCL_RET_TIMEOUT) {
    rcl_reset_error();
    return;
  }
  require_ok(ret);
  if (wait.set().guard_conditions[0] != nullptr) {
    last_change_ = SessionClock::now();
  }
}

void GraphSession::sleep_until(SessionClock::time_point until) {
  while (!is_stopped() && SessionClock::now() < until) {
    wait({}, until);
  }
}

}  // namespace launch
