// SPDX-License-Identifier: Apache-2.0
// Counts the messages of a topic of which a condition holds.
//
// It subscribes before there is a publisher, so that it misses as little as a subscription can. The quality of service
// of publishers is not known then. Of the three subscriptions, one hears every publisher, one gets all messages of a
// reliable publisher, and one gets those that a publisher keeps for late subscriptions. A message that comes twice
// counts once.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/environment/own_environment.hpp"
#include "base/environment/own_prefix.hpp"
#include "launcher/message_types/cdr/cdr_codec.hpp"
#include "launcher/message_types/interface_library.hpp"
#include "launcher/message_types/message_condition.hpp"
#include "launcher/message_types/print_value.hpp"
#include "programs/ros_client/opaque_subscription.hpp"
#include "programs/ros_client/operation.hpp"

namespace launch {

namespace {

constexpr std::size_t kHistory = 1000;
constexpr std::size_t kKeptMessages = 8;
constexpr std::size_t kLongestText = 200;

// Tells which messages have come before, by their publishers and numbers.
class KnownMessages {
 public:
  // False if it has come before.
  bool add(const rmw_message_info_t& info) {
    std::array<std::uint8_t, RMW_GID_STORAGE_SIZE> gid{};
    std::copy(std::begin(info.publisher_gid.data), std::end(info.publisher_gid.data), gid.begin());
    std::set<std::uint64_t>& numbers = numbers_[gid];
    const bool is_new = numbers.insert(info.publication_sequence_number).second;
    if (numbers.size() > 2 * kHistory) {
      numbers.erase(numbers.begin());
    }
    return is_new;
  }

 private:
  std::map<std::array<std::uint8_t, RMW_GID_STORAGE_SIZE>, std::set<std::uint64_t>> numbers_;
};

class MessageCounter final : public Operation {
 public:
  MessageCounter(const WatchMessages& request, rclcpp::Node& node, Answer answer)
      : Operation(std::move(answer)), request_(request), node_(node) {
    InterfaceLibrary library(PackageIndex(own_prefix()), own_environment());
    type_ = library.message(request.type);
    if (!request.condition.empty()) {
      condition_ = std::make_unique<MessageCondition>(type_, LocatedText(request.condition));
    }
    for (const rclcpp::QoS& qos : {rclcpp::QoS(kHistory).best_effort(), rclcpp::QoS(kHistory).reliable(),
                                   rclcpp::QoS(kHistory).reliable().transient_local()}) {
      subscriptions_.push_back(std::make_unique<OpaqueSubscription>(node, request.topic, type_->name, qos));
    }
  }

  void look() override {
    bool has_changed = look_at_graph();
    for (const auto& subscription : subscriptions_) {
      while (const auto message = subscription->take()) {
        if (known_.add(message->info)) {
          count(*message);
          has_changed = true;
        }
      }
    }
    if (has_changed) {
      RosAnswer answer;
      answer.ok = true;
      answer.messages = seen_;
      tell(answer);
    }
  }

  void add_to(WakeUps& wake_ups) const override {
    for (const auto& subscription : subscriptions_) {
      wake_ups.subscriptions.push_back(subscription->handle());
    }
  }

  std::string waits_for() const override { return describe(request_); }

 private:
  // True if there is something to tell. A publisher that has gone was there.
  bool look_at_graph() {
    const std::size_t publishers = node_.count_publishers(request_.topic);
    if (publishers == publishers_ || publishers == 0) {
      return false;
    }
    publishers_ = publishers;
    seen_.publishers = publishers;
    for (const auto& publisher : node_.get_publishers_info_by_topic(request_.topic)) {
      if (const std::string type = publisher.topic_type();
          std::find(seen_.types.begin(), seen_.types.end(), type) == seen_.types.end()) {
        seen_.types.push_back(type);
      }
    }
    return true;
  }

  void count(const OpaqueSubscription::Message& message) {
    const rmw_serialized_message_t& bytes = message.bytes.get_rcl_serialized_message();
    ++seen_.all;
    MessageValue value;
    std::string text;
    bool matches = false;
    try {
      value = from_cdr(*type_, bytes.buffer, bytes.buffer_length);
      text = to_yaml({.kind = FieldKind::kMessage, .message = type_}, value, {.truncate = 32, .flow = true});
      matches = condition_ == nullptr || condition_->holds(value);
    } catch (const std::exception& error) {
      text = fmt::format("a message that can't be read: {}", error.what());
    }
    text.erase(text.find_last_not_of('\n') + 1);
    seen_.last.push_back(shortened(std::move(text)));
    if (seen_.last.size() > kKeptMessages) {
      seen_.last.erase(seen_.last.begin());
    }
    if (!matches) {
      return;
    }
    const std::int64_t time = message.info.received_timestamp;
    seen_.first_ns = seen_.matching == 0 ? time : std::min(seen_.first_ns, time);
    seen_.last_ns = std::max(seen_.last_ns, time);
    ++seen_.matching;
  }

  static std::string shortened(std::string text) {
    if (text.size() > kLongestText) {
      text.resize(kLongestText);
      while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xC0U) == 0x80U) {
        text.pop_back();  // not within a character
      }
      if (!text.empty() && (static_cast<unsigned char>(text.back()) & 0x80U) != 0) {
        text.pop_back();
      }
      text += "…";
    }
    return text;
  }

  const WatchMessages request_;
  rclcpp::Node& node_;
  std::shared_ptr<const MessageType> type_;
  std::unique_ptr<MessageCondition> condition_;
  std::vector<std::unique_ptr<OpaqueSubscription>> subscriptions_;
  KnownMessages known_;
  SeenMessages seen_;
  std::size_t publishers_ = 0;
};

}  // namespace

std::unique_ptr<Operation> watch(const WatchMessages& request, rclcpp::Node& node, Operation::Answer answer) {
  return std::make_unique<MessageCounter>(request, node, std::move(answer));
}

}  // namespace launch
