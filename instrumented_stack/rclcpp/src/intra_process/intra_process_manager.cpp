// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/experimental/intra_process_manager.hpp"

#include <rmw/qos_profiles.h>

#include <algorithm>
#include <limits>
#include <mutex>
#include <stdexcept>

#include "rclcpp/detail/require_ok.hpp"
#include "rclcpp/detail/resolve_use_intra_process.hpp"

namespace rclcpp::experimental {

namespace {

std::array<uint8_t, RMW_GID_STORAGE_SIZE> bytes_of(const rmw_gid_t& gid) {
  std::array<uint8_t, RMW_GID_STORAGE_SIZE> bytes;
  std::copy(std::begin(gid.data), std::end(gid.data), bytes.begin());
  return bytes;
}

}  // namespace

uint64_t IntraProcessManager::add_publisher(const PublisherBase& publisher, Replay replay) {
  PublisherEntry entry{
      publisher.get_topic_name(), publisher.get_actual_qos(), bytes_of(publisher.get_gid()), std::move(replay), {}, {}};
  const std::unique_lock lock(mutex_);
  for (const auto& [id, weak] : subscriptions_) {
    const SubscriptionIntraProcessBase::SharedPtr subscription = weak.lock();
    if (subscription && can_communicate(entry, *subscription)) {
      connect(entry, id, subscription);
    }
  }
  gids_.insert(entry.gid);
  publishers_.emplace(++last_id_, std::move(entry));
  return last_id_;
}

uint64_t IntraProcessManager::add_subscription(const SubscriptionIntraProcessBase::SharedPtr& subscription) {
  const std::unique_lock lock(mutex_);
  subscriptions_.emplace(++last_id_, subscription);
  for (auto& [id, entry] : publishers_) {
    if (can_communicate(entry, *subscription)) {
      connect(entry, last_id_, subscription);
      if (entry.replay && subscription->is_durability_transient_local()) {
        entry.replay(*subscription);
      }
    }
  }
  return last_id_;
}

void IntraProcessManager::remove_publisher(uint64_t intra_process_publisher_id) {
  const std::unique_lock lock(mutex_);
  const auto found = publishers_.find(intra_process_publisher_id);
  if (found != publishers_.end()) {
    gids_.erase(found->second.gid);
    publishers_.erase(found);
  }
}

void IntraProcessManager::remove_subscription(uint64_t intra_process_subscription_id) {
  const std::unique_lock lock(mutex_);
  subscriptions_.erase(intra_process_subscription_id);
  const auto is_it = [intra_process_subscription_id](const Recipient& recipient) {
    return recipient.id == intra_process_subscription_id;
  };
  for (auto& [id, entry] : publishers_) {
    for (Recipients* recipients : {&entry.sharing, &entry.owning}) {
      recipients->erase(std::remove_if(recipients->begin(), recipients->end(), is_it), recipients->end());
    }
  }
}

bool IntraProcessManager::matches_any_publishers(const rmw_gid_t& id) const {
  const std::shared_lock lock(mutex_);
  return gids_.count(bytes_of(id)) != 0;
}

size_t IntraProcessManager::get_subscription_count(uint64_t intra_process_publisher_id) const {
  const std::shared_lock lock(mutex_);
  const auto found = publishers_.find(intra_process_publisher_id);
  return found == publishers_.end() ? 0 : found->second.sharing.size() + found->second.owning.size();
}

SubscriptionIntraProcessBase::SharedPtr IntraProcessManager::get_subscription_intra_process(
    uint64_t intra_process_subscription_id) const {
  const std::shared_lock lock(mutex_);
  const auto found = subscriptions_.find(intra_process_subscription_id);
  return found == subscriptions_.end() ? nullptr : found->second.lock();
}

size_t IntraProcessManager::lowest_available_capacity(uint64_t intra_process_publisher_id) const {
  const std::shared_lock lock(mutex_);
  const auto found = publishers_.find(intra_process_publisher_id);
  if (found == publishers_.end() || (found->second.sharing.empty() && found->second.owning.empty())) {
    return 0;
  }
  size_t lowest = std::numeric_limits<size_t>::max();
  for (const Recipients* recipients : {&found->second.sharing, &found->second.owning}) {
    for (const Recipient& recipient : *recipients) {
      if (const auto subscription = recipient.subscription.lock()) {
        lowest = std::min(lowest, subscription->available_capacity());
      }
    }
  }
  return lowest == std::numeric_limits<size_t>::max() ? 0 : lowest;
}

bool IntraProcessManager::can_communicate(const PublisherEntry& publisher,
                                          const SubscriptionIntraProcessBase& subscription) {
  if (publisher.topic_name != subscription.get_topic_name()) {
    return false;
  }
  rmw_qos_compatibility_type_t compatibility = RMW_QOS_COMPATIBILITY_ERROR;
  detail::require_ok(
      rmw_qos_profile_check_compatible(publisher.qos.get_rmw_qos_profile(),
                                       subscription.get_actual_qos().get_rmw_qos_profile(), &compatibility, nullptr, 0),
      "failed to check the compatibility of quality of service");
  return compatibility != RMW_QOS_COMPATIBILITY_ERROR;
}

void IntraProcessManager::connect(PublisherEntry& entry, uint64_t subscription_id,
                                  const SubscriptionIntraProcessBase::SharedPtr& subscription) {
  (subscription->use_take_shared_method() ? entry.sharing : entry.owning).push_back({subscription_id, subscription});
}

}  // namespace rclcpp::experimental

namespace rclcpp {

void detail::require_intra_process_qos(const QoS& qos, const std::string& topic_name) {
  if (qos.history() != HistoryPolicy::KeepLast) {
    throw std::invalid_argument("intraprocess communication on topic '" + topic_name +
                                "' allowed only with keep last history qos policy");
  }
  if (qos.depth() == 0) {
    throw std::invalid_argument("intraprocess communication on topic '" + topic_name +
                                "' is not allowed with a zero qos history depth value");
  }
}

}  // namespace rclcpp
