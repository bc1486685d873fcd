// SPDX-License-Identifier: Apache-2.0
#include "context/graph_channel.hpp"

#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "endpoint/endpoint.hpp"
#include "rcutils/logging.h"
#include "rmw/error_handling.h"
#include "rosidl_typesupport_cpp/message_type_support.hpp"

namespace rmw_fastrtps {
namespace {

constexpr const char* kTopic = "ros_discovery_info";

rmw_qos_profile_t channel_profile() {
  rmw_qos_profile_t profile = rmw_qos_profile_default;
  profile.reliability = RMW_QOS_POLICY_RELIABILITY_RELIABLE;
  profile.durability = RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL;
  profile.avoid_ros_namespace_conventions = true;
  return profile;
}

GidLength first_gid_length() {
  const char* const distribution = std::getenv("ROS_DISTRO");
  return distribution != nullptr && std::string_view(distribution) == "humble" ? GidLength::kOfHumble
                                                                               : GidLength::kOfToday;
}

// Frees itself.
struct SerializedMessage : rmw_serialized_message_t {
  SerializedMessage() : rmw_serialized_message_t(rmw_get_zero_initialized_serialized_message()) {
    const rcutils_allocator_t heap = rcutils_get_default_allocator();
    (void)rmw_serialized_message_init(this, 0, &heap);
  }
  SerializedMessage(const SerializedMessage&) = delete;
  SerializedMessage& operator=(const SerializedMessage&) = delete;
  ~SerializedMessage() { (void)rmw_serialized_message_fini(this); }
};

std::optional<rmw_time_t> time_until(std::optional<UnansweredParticipants::TimePoint> time) {
  if (!time) {
    return std::nullopt;
  }
  const auto left = std::chrono::ceil<std::chrono::nanoseconds>(*time - std::chrono::steady_clock::now());
  return rmw_time_from_nsec(std::max<rmw_duration_t>(left.count(), 0));
}

}  // namespace

GraphChannel::GraphChannel(rmw_context_t& context, Participant& participant, GraphCache& graph)
    : participant_(participant),
      graph_(graph),
      gid_length_(first_gid_length()),
      introduction_(std::in_place, Clock::now(), [creator = gettid()] { return is_busy(creator); }) {
  const auto& type_support = *rosidl_typesupport_cpp::get_message_type_support_handle<GraphCache::EntitiesInfo>();
  // Only the last state of a participant counts. But a burst of states of many participants must not push out any of
  // them.
  rmw_qos_profile_t profile = channel_profile();
  profile.history = RMW_QOS_POLICY_HISTORY_KEEP_LAST;
  profile.depth = 1;
  // A history of one message is always full. Fast DDS 2.9 would then ask all readers whenever one of them, which has
  // come late, gets the message.
  publisher_ = create_publisher(participant, type_support, kTopic, profile, rmw_get_default_publisher_options(),
                                Heartbeats::kPeriodic);
  profile.history = RMW_QOS_POLICY_HISTORY_KEEP_ALL;
  rmw_subscription_options_t options = rmw_get_default_subscription_options();
  options.ignore_local_publications = true;
  subscription_ = create_subscription(participant, type_support, kTopic, profile, options);
  wait_set_ = rmw_create_wait_set(&context, 4);
  stop_ = rmw_create_guard_condition(&context);

  // Signals are left to the threads of the application.
  sigset_t all;
  sigset_t before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  thread_ = rcutils::JoinedThread([this] { listen(); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  ended_with_process_.emplace([this] { stop(); });
}

GraphChannel::~GraphChannel() {
  ended_with_process_.reset();
  if (thread_.joinable()) {
    stop();
  }
  (void)rmw_destroy_guard_condition(stop_);
  (void)rmw_destroy_wait_set(wait_set_);
  destroy_subscription(subscription_);
  destroy_publisher(publisher_);
}

void GraphChannel::stop() {
  (void)rmw_trigger_guard_condition(stop_);
  thread_.join();
}

void GraphChannel::announce(GraphCache::EntitiesInfo info) {
  {
    const std::lock_guard lock(mutex_);
    if (ended_) {
      return;
    }
    unpublished_ = std::move(info);
    if (introduction_) {
      introduction_->put_off(Clock::now());
      return;  // the thread will look at it
    }
  }
  changed_.trigger();
}

void GraphChannel::end() {
  const std::lock_guard lock(mutex_);
  ended_ = true;
}

void GraphChannel::listen() {
  UnansweredParticipants& unanswered = participant_.unanswered();
  while (true) {
    void* subscription = subscription_->data;
    void* conditions[] = {stop_->data, static_cast<Waitable*>(&unanswered.changed()),
                          static_cast<Waitable*>(&changed_)};
    rmw_subscriptions_t subscriptions{1, &subscription};
    rmw_guard_conditions_t guard_conditions{std::size(conditions), conditions};
    const std::optional<rmw_time_t> timeout = time_until(next_time());
    (void)rmw_wait(&subscriptions, &guard_conditions, nullptr, nullptr, nullptr, wait_set_,
                   timeout ? &*timeout : nullptr);
    if (conditions[0] != nullptr) {
      return;
    }
    introduce_if_due();
    publish();
    if (subscription != nullptr) {
      take();
    }
    if (const std::vector<Gid> silent = unanswered.take_due(Clock::now()); !silent.empty()) {
      participant_.announce_again(silent);
    }
  }
}

std::optional<GraphChannel::Clock::time_point> GraphChannel::next_time() const {
  {
    const std::lock_guard lock(mutex_);
    if (introduction_) {
      return introduction_->next();
    }
  }
  return participant_.unanswered().next();
}

void GraphChannel::introduce_if_due() {
  {
    const std::lock_guard lock(mutex_);
    if (!introduction_ || !introduction_->is_due(Clock::now())) {
      return;
    }
    introduction_.reset();
  }
  participant_.introduce();
}

void GraphChannel::publish() {
  std::optional<GraphCache::EntitiesInfo> info;
  {
    const std::lock_guard lock(mutex_);
    if (introduction_ || ended_) {
      return;
    }
    info.swap(unpublished_);
  }
  if (!info) {
    return;
  }
  published_ = std::move(info);
  rmw_ret_t result = RMW_RET_OK;
  if (gid_length_ == GidLength::kOfToday) {
    result = rmw_publish(publisher_, &*published_, nullptr);
  } else {
    std::vector<std::uint8_t> bytes = write_entities(*published_, gid_length_);
    rmw_serialized_message_t message = rmw_get_zero_initialized_serialized_message();
    message.buffer = bytes.data();
    message.buffer_length = message.buffer_capacity = bytes.size();
    result = rmw_publish_serialized_message(publisher_, &message, nullptr);
  }
  if (result != RMW_RET_OK) {
    rcutils_log(nullptr, RCUTILS_LOG_SEVERITY_ERROR, "rmw_fastrtps", "other processes do not see all nodes: %s",
                rmw_get_error_string().str);
    rmw_reset_error();
  }
}

void GraphChannel::take() {
  SerializedMessage message;
  bool taken = true;
  while (taken && rmw_take_serialized_message(subscription_, &message, &taken, nullptr) == RMW_RET_OK) {
    if (const auto read = taken ? read_entities({message.buffer, message.buffer_length}) : std::nullopt) {
      graph_.update_nodes(read->info);
      write_as(read->length);
    }
  }
}

// Whoever has learned to write as Humble does goes on: nodes of today that read it only miss the names of nodes.
void GraphChannel::write_as(GidLength length) {
  if (length == GidLength::kOfToday || gid_length_ == length) {
    return;
  }
  gid_length_ = length;
  const std::lock_guard lock(mutex_);
  if (published_ && !unpublished_) {
    unpublished_ = published_;
    changed_.trigger();
  }
}

}  // namespace rmw_fastrtps
