// SPDX-License-Identifier: Apache-2.0
// Delivers messages within a context without the middleware, and knows which publishers and subscriptions match.
//
// Each context has one manager (Context::get_sub_context<IntraProcessManager>()). A publisher that was added passes its
// messages to do_intra_process_publish(), which puts them into the buffers of the subscriptions that match by topic and
// QoS:
//
// - All subscriptions share messages: there is one message for all and no copy.
// - Some subscriptions own their messages: they get copies, and the last one gets the message itself. So a single
//   subscription never costs a copy.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <set>
#include <shared_mutex>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "rclcpp/allocator/allocator_common.hpp"
#include "rclcpp/experimental/subscription_intra_process.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/publisher_base.hpp"

namespace rclcpp::experimental {

// Thread safe.
class IntraProcessManager {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(IntraProcessManager)

  IntraProcessManager() = default;
  RCLCPP_DISABLE_COPY(IntraProcessManager)

  // Remove both before they are destroyed. `replay`, of a transient local publisher, gives earlier messages to a late
  // subscription.
  using Replay = std::function<void(SubscriptionIntraProcessBase&)>;
  uint64_t add_publisher(const PublisherBase& publisher, Replay replay = nullptr);
  uint64_t add_subscription(const SubscriptionIntraProcessBase::SharedPtr& subscription);
  void remove_publisher(uint64_t intra_process_publisher_id);
  void remove_subscription(uint64_t intra_process_subscription_id);

  // Whether a message of that sender also came, or will come, through a buffer.
  bool matches_any_publishers(const rmw_gid_t& id) const;
  // 0 for an unknown publisher.
  size_t get_subscription_count(uint64_t intra_process_publisher_id) const;
  // Null if it is unknown or gone.
  SubscriptionIntraProcessBase::SharedPtr get_subscription_intra_process(uint64_t intra_process_subscription_id) const;
  // The number of messages that every subscription of the publisher can take without losing one. 0 for an unknown
  // publisher and for one without subscriptions.
  size_t lowest_available_capacity(uint64_t intra_process_publisher_id) const;

  // MessageT is the ROS message type or the custom type of a TypeAdapter. Does nothing for an unknown publisher. Throws
  // std::runtime_error if a subscription has another allocator.
  template <typename MessageT, typename ROSMessageT, typename AllocatorT>
  void do_intra_process_publish(uint64_t id, allocator::UniquePtr<MessageT, AllocatorT> message,
                                const AllocatorT& allocator) const {
    const std::shared_lock lock(mutex_);
    const auto found = publishers_.find(id);
    if (found == publishers_.end()) {
      return;
    }
    const Recipients& sharing = found->second.sharing;
    const Recipients& owning = found->second.owning;
    if (owning.empty()) {
      share<MessageT, ROSMessageT, AllocatorT>(sharing, std::move(message));
      return;
    }
    // A single sharing subscription can own its message instead: that saves a copy.
    if (sharing.size() > 1) {
      share<MessageT, ROSMessageT, AllocatorT>(sharing, allocator::make_unique<MessageT>(allocator, *message));
    } else if (!sharing.empty()) {
      provide<MessageT, ROSMessageT, AllocatorT>(sharing.front(),
                                                 allocator::make_unique<MessageT>(allocator, *message));
    }
    give<MessageT, ROSMessageT, AllocatorT>(owning, std::move(message), allocator);
  }

  // Like the function above, and the message stays readable. `keep` is called with it before subscriptions can come or
  // go.
  template <typename MessageT, typename ROSMessageT, typename AllocatorT, typename KeepT>
  std::shared_ptr<const MessageT> do_intra_process_publish_and_return_shared(
      uint64_t id, allocator::UniquePtr<MessageT, AllocatorT> message, const AllocatorT& allocator, KeepT keep) const {
    const std::shared_lock lock(mutex_);
    const auto found = publishers_.find(id);
    const bool is_copied = found != publishers_.end() && !found->second.owning.empty();
    std::shared_ptr<const MessageT> shared;
    if (is_copied) {
      shared = allocator::make_shared<MessageT>(allocator, *message);
      give<MessageT, ROSMessageT, AllocatorT>(found->second.owning, std::move(message), allocator);
    } else {
      shared = std::move(message);
    }
    if (found != publishers_.end()) {
      share<MessageT, ROSMessageT, AllocatorT>(found->second.sharing, shared);
    }
    keep(shared);
    return shared;
  }

 private:
  struct Recipient {
    uint64_t id;
    SubscriptionIntraProcessBase::WeakPtr subscription;
  };
  using Recipients = std::vector<Recipient>;
  struct PublisherEntry {
    std::string topic_name;
    QoS qos;
    std::array<uint8_t, RMW_GID_STORAGE_SIZE> gid;
    Replay replay;
    Recipients sharing;
    Recipients owning;
  };

  static bool can_communicate(const PublisherEntry& publisher, const SubscriptionIntraProcessBase& subscription);
  static void connect(PublisherEntry& entry, uint64_t subscription_id,
                      const SubscriptionIntraProcessBase::SharedPtr& subscription);

  // Puts a shared or unique pointer to a message into a subscription's buffer.
  template <typename MessageT, typename ROSMessageT, typename AllocatorT, typename PointerT>
  static void provide(const Recipient& recipient, PointerT message) {
    const SubscriptionIntraProcessBase::SharedPtr subscription = recipient.subscription.lock();
    if (!subscription) {
      return;
    }
    using SameType = SubscriptionIntraProcessBuffer<MessageT, ROSMessageT, AllocatorT>;
    using ROSType = SubscriptionROSMsgIntraProcessBuffer<ROSMessageT, AllocatorT>;
    if (auto* same_type = dynamic_cast<SameType*>(subscription.get())) {
      same_type->provide_intra_process_data(std::move(message));
      return;
    }
    auto* ros_type = dynamic_cast<ROSType*>(subscription.get());
    if (!ros_type) {
      throw std::runtime_error(std::string("the publisher and a subscription of topic '") +
                               subscription->get_topic_name() +
                               "' use different allocator types, which intra-process communication does not support");
    }
    if constexpr (std::is_same_v<MessageT, ROSMessageT>) {
      ros_type->provide_intra_process_message(std::move(message));
    } else {
      auto ros_message = std::make_shared<ROSMessageT>();
      TypeAdapter<MessageT, ROSMessageT>::convert_to_ros_message(*message, *ros_message);
      ros_type->provide_intra_process_message(std::shared_ptr<const ROSMessageT>(std::move(ros_message)));
    }
  }

  template <typename MessageT, typename ROSMessageT, typename AllocatorT>
  static void share(const Recipients& recipients, std::shared_ptr<const MessageT> message) {
    for (const Recipient& recipient : recipients) {
      provide<MessageT, ROSMessageT, AllocatorT>(recipient, message);
    }
  }

  // `recipients` must not be empty.
  template <typename MessageT, typename ROSMessageT, typename AllocatorT>
  static void give(const Recipients& recipients, allocator::UniquePtr<MessageT, AllocatorT> message,
                   const AllocatorT& allocator) {
    for (size_t i = 0; i + 1 < recipients.size(); ++i) {
      provide<MessageT, ROSMessageT, AllocatorT>(recipients[i], allocator::make_unique<MessageT>(allocator, *message));
    }
    provide<MessageT, ROSMessageT, AllocatorT>(recipients.back(), std::move(message));
  }

  mutable std::shared_mutex mutex_;
  uint64_t last_id_ = 0;
  std::unordered_map<uint64_t, PublisherEntry> publishers_;
  std::unordered_map<uint64_t, SubscriptionIntraProcessBase::WeakPtr> subscriptions_;
  std::set<std::array<uint8_t, RMW_GID_STORAGE_SIZE>> gids_;  // ids of the publishers
};

}  // namespace rclcpp::experimental
