// SPDX-License-Identifier: Apache-2.0
// Looks again and again at what shows that a process is healthy: the traffic of a topic, a service, the state of a
// managed node.
//
// An operation looks when its time has come, not at each wake-up of the loop, so that a hundred of them cost little
// more than one.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <lifecycle_msgs/srv/get_state.hpp>
#include <map>
#include <memory>
#include <optional>
#include <rcl_interfaces/srv/get_parameters.hpp>
#include <string>
#include <utility>

#include "programs/rclcpp_versions/rclcpp_versions.hpp"
#include "programs/ros_client/opaque_subscription.hpp"
#include "programs/ros_client/operation.hpp"

namespace launch {

namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

// A look that is later than this shows that this program got no processor: messages may have been lost meanwhile.
constexpr Duration kLate = 250ms;

// Counts by the numbers that publishers give their messages. So a short history is enough, however fast they come.
class TopicMeter final : public Operation {
 public:
  TopicMeter(const MeterTopic& request, rclcpp::Node& node, Answer answer)
      : Operation(std::move(answer)),
        request_(request),
        node_(node),
        step_(std::clamp<Duration>(request.every / 2, 20ms, 500ms)) {}

  void look() override {
    const Clock::time_point now = Clock::now();
    if (now < next_) {
      return;
    }
    traffic_.measured += now - next_ <= kLate ? now - last_ : Duration{0};
    last_ = now;
    next_ = now + step_;
    if (!subscription_) {
      subscribe();
    }
    while (subscription_) {
      const auto message = subscription_->take();
      if (!message) {
        break;
      }
      count(message->info);
    }
    if (now - told_ + step_ / 2 >= request_.every) {
      told_ = now;
      traffic_.publishers = node_.count_publishers(request_.topic);
      RosAnswer answer;
      answer.ok = true;
      answer.traffic = std::exchange(traffic_, {});
      tell(answer);
    }
  }
  std::string waits_for() const override { return describe(request_); }

 private:
  static constexpr std::size_t kHistory = 8;

  // The type is that of the publishers. A subscription of best effort hears each of them.
  void subscribe() {
    if (node_.count_publishers(request_.topic) == 0) {
      return;
    }
    const auto publishers = node_.get_publishers_info_by_topic(request_.topic);
    if (!publishers.empty()) {
      subscription_ = std::make_unique<OpaqueSubscription>(node_, request_.topic, publishers.front().topic_type(),
                                                           rclcpp::QoS(kHistory).best_effort());
    }
  }

  void count(const rmw_message_info_t& info) {
    std::array<std::uint8_t, RMW_GID_STORAGE_SIZE> gid{};
    std::copy(std::begin(info.publisher_gid.data), std::end(info.publisher_gid.data), gid.begin());
    const std::uint64_t number = info.publication_sequence_number;
    const auto [known, is_new] = numbers_.emplace(gid, number);
    if (is_new || number == RMW_MESSAGE_INFO_SEQUENCE_NUMBER_UNSUPPORTED) {
      ++traffic_.messages;
    } else if (number > known->second) {
      traffic_.messages += number - known->second;
      known->second = number;
    }
  }

  const MeterTopic request_;
  rclcpp::Node& node_;
  const Duration step_;
  std::unique_ptr<OpaqueSubscription> subscription_;
  std::map<std::array<std::uint8_t, RMW_GID_STORAGE_SIZE>, std::uint64_t> numbers_;  // of the newest message
  TopicTraffic traffic_;
  Clock::time_point last_ = Clock::now();
  Clock::time_point next_ = last_;
  Clock::time_point told_ = last_;
};

// Asks a service again and again, by one client. A service that hangs gets a few questions more, because one that was
// asked before may have been replaced by another one.
template <typename ServiceT>
class Question {
 public:
  Question(rclcpp::Node& node, const std::string& service) : client_(node.create_client<ServiceT>(service)) {}

  // False if the service is not matched yet.
  bool ask() {
    if (!client_->service_is_ready()) {
      return false;
    }
    client_->async_send_request(std::make_shared<typename ServiceT::Request>());
    is_open_ = true;
    return true;
  }
  bool is_open() const { return is_open_; }
  std::shared_ptr<typename ServiceT::Response> take() {
    auto response = std::make_shared<typename ServiceT::Response>();
    rmw_request_id_t id{};
    bool has_come = false;
    while (client_->take_type_erased_response(response.get(), id)) {
      has_come = true;
    }
    if (!has_come) {
      return nullptr;
    }
    client_->prune_pending_requests();
    is_open_ = false;
    return response;
  }
  void add_to(Operation::WakeUps& wake_ups) const {
    if (is_open_) {
      wake_ups.clients.push_back(client_->get_client_handle().get());
    }
  }

 private:
  typename rclcpp::Client<ServiceT>::SharedPtr client_;
  bool is_open_ = false;
};

template <typename ServiceT>
class ServiceWatch final : public Operation {
 public:
  // Of an answer: what it says.
  using Read = std::string (*)(const typename ServiceT::Response&);

  ServiceWatch(RosRequest request, std::string service, const char* type, Duration every, rclcpp::Node& node, Read read,
               Answer answer)
      : Operation(std::move(answer)),
        request_(std::move(request)),
        service_(std::move(service)),
        type_(type),
        every_(std::max<Duration>(every, 20ms)),
        node_(node),
        read_(read) {}

  void look() override {
    if (question_) {
      if (const auto response = question_->take()) {
        conclude(ServiceFinding::kFound, read_(*response));
      }
    }
    const Clock::time_point now = Clock::now();
    if (now < next_) {
      return;
    }
    next_ = now + every_ / 2;
    if (rclcpp_versions::count_services(node_, service_) == 0) {
      is_asked_.reset();
      conclude(ServiceFinding::kGone);
    } else if (!may_be_asked()) {
      conclude(ServiceFinding::kFound);
    } else if (now >= next_question_) {
      if (!question_) {
        question_.emplace(node_, service_);
      }
      next_question_ = question_->ask() ? now + every_ : next_;
      // A good answer holds until the next one is due.
      if (!is_good()) {
        conclude(ServiceFinding::kAsked, state_);
      }
    } else if (question_ && question_->is_open()) {
      conclude(ServiceFinding::kAsked, state_);
    }
    if (!is_good()) {
      send();
    }
  }
  void add_to(WakeUps& wake_ups) const override {
    if (question_) {
      question_->add_to(wake_ups);
    }
  }
  std::string waits_for() const override { return describe(request_); }

 private:
  // Whether its type is one that is asked. To look it up takes long in a large graph.
  bool may_be_asked() {
    if (!is_asked_) {
      const auto services = node_.get_service_names_and_types();
      const auto found = services.find(service_);
      is_asked_ = found != services.end() &&
                  std::find(found->second.begin(), found->second.end(), type_) != found->second.end();
    }
    return *is_asked_;
  }
  bool is_good() const { return finding_ == ServiceFinding::kFound; }
  void conclude(ServiceFinding finding, std::string state = {}) {
    const bool is_news = finding != finding_ || state != state_;
    finding_ = finding;
    state_ = std::move(state);
    if (is_news && is_good()) {
      send();
    }
  }
  void send() {
    RosAnswer answer;
    answer.ok = true;
    answer.found = finding_;
    answer.state = state_;
    tell(answer);
  }

  const RosRequest request_;
  const std::string service_;
  const std::string type_;
  const Duration every_;
  rclcpp::Node& node_;
  const Read read_;
  std::optional<bool> is_asked_;
  std::optional<Question<ServiceT>> question_;
  std::optional<ServiceFinding> finding_;
  std::string state_;
  Clock::time_point next_;
  Clock::time_point next_question_;
};

}  // namespace

std::unique_ptr<Operation> watch(const MeterTopic& request, rclcpp::Node& node, Operation::Answer answer) {
  return std::make_unique<TopicMeter>(request, node, std::move(answer));
}

std::unique_ptr<Operation> watch(const AskService& request, rclcpp::Node& node, Operation::Answer answer) {
  using rcl_interfaces::srv::GetParameters;
  return std::make_unique<ServiceWatch<GetParameters>>(
      request, request.service, "rcl_interfaces/srv/GetParameters", request.every, node,
      [](const GetParameters::Response&) { return std::string(); }, std::move(answer));
}

std::unique_ptr<Operation> watch(const AskState& request, rclcpp::Node& node, Operation::Answer answer) {
  using lifecycle_msgs::srv::GetState;
  return std::make_unique<ServiceWatch<GetState>>(
      request, request.node + "/get_state", "lifecycle_msgs/srv/GetState", request.every, node,
      [](const GetState::Response& response) { return response.current_state.label; }, std::move(answer));
}

}  // namespace launch
