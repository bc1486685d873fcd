// SPDX-License-Identifier: Apache-2.0
// Waits until a parameter of a node has a value.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <rcl_interfaces/msg/parameter_event.hpp>
#include <rcl_interfaces/msg/parameter_type.hpp>
#include <rcl_interfaces/srv/get_parameters.hpp>
#include <string>
#include <utility>
#include <vector>

#include "launcher/substitution/parameter.hpp"
#include "programs/ros_client/operation.hpp"
#include "programs/ros_client/service_call.hpp"

namespace launch {

namespace {

using GetParameters = rcl_interfaces::srv::GetParameters;
using ParameterMessage = rcl_interfaces::msg::ParameterValue;
using Types = rcl_interfaces::msg::ParameterType;
using rcl_interfaces::msg::ParameterEvent;

// A node whose event is missed, or that publishes none, is asked again after this time.
constexpr std::chrono::milliseconds kAskForValueAgain{250};

template <typename Item, typename Values>
ParameterValue list_of(const Values& values) {
  std::vector<ParameterScalar> items;
  for (const auto& value : values) {
    items.emplace_back(static_cast<Item>(value));
  }
  return items;
}

// Nothing if the parameter is not set.
std::optional<ParameterValue> value_of(const ParameterMessage& message) {
  switch (message.type) {
    case Types::PARAMETER_BOOL:
      return ParameterScalar(static_cast<bool>(message.bool_value));
    case Types::PARAMETER_INTEGER:
      return ParameterScalar(message.integer_value);
    case Types::PARAMETER_DOUBLE:
      return ParameterScalar(message.double_value);
    case Types::PARAMETER_STRING:
      return ParameterScalar(message.string_value);
    case Types::PARAMETER_BYTE_ARRAY:
      return list_of<std::int64_t>(message.byte_array_value);
    case Types::PARAMETER_BOOL_ARRAY:
      return list_of<bool>(message.bool_array_value);
    case Types::PARAMETER_INTEGER_ARRAY:
      return list_of<std::int64_t>(message.integer_array_value);
    case Types::PARAMETER_DOUBLE_ARRAY:
      return list_of<double>(message.double_array_value);
    case Types::PARAMETER_STRING_ARRAY:
      return list_of<std::string>(message.string_array_value);
    default:
      return std::nullopt;
  }
}

// 3 and 3.0 are equal: a launch file says what a value is, and not of which type the node has declared it.
bool are_equal(const ParameterScalar& a, const ParameterScalar& b) {
  const auto number = [](const ParameterScalar& scalar) -> std::optional<double> {
    if (const auto* const integer = std::get_if<std::int64_t>(&scalar)) {
      return static_cast<double>(*integer);
    }
    const auto* const real = std::get_if<double>(&scalar);
    return real == nullptr ? std::nullopt : std::optional(*real);
  };
  return a == b || (a.index() != b.index() && number(a) && number(a) == number(b));
}

bool are_equal(const ParameterValue& a, const ParameterValue& b) {
  if (a.index() != b.index()) {
    return false;
  }
  if (const auto* const scalar = std::get_if<ParameterScalar>(&a)) {
    return are_equal(*scalar, std::get<ParameterScalar>(b));
  }
  const auto& items = std::get<std::vector<ParameterScalar>>(a);
  const auto& others = std::get<std::vector<ParameterScalar>>(b);
  return std::equal(items.begin(), items.end(), others.begin(), others.end(),
                    [](const ParameterScalar& x, const ParameterScalar& y) { return are_equal(x, y); });
}

class ParameterWait final : public Operation {
 public:
  ParameterWait(const ParameterReached& request, rclcpp::Node& node, Answer answer)
      : Operation(std::move(answer)),
        request_(request),
        node_(node),
        events_(node.create_subscription<ParameterEvent>("/parameter_events", rclcpp::ParameterEventsQoS(),
                                                         [](const ParameterEvent&) {})) {
    ask();
  }

  void look() override {
    if (take_events() || has_ended()) {
      return;
    }
    if (question_) {
      if (const auto response = question_->look()) {
        question_.reset();
        asked_ = Clock::now();
        check(response->values.empty() ? std::nullopt : value_of(response->values.front()));
      } else if (question_->is_orphaned()) {
        ask();  // the process of the node may come back
      }
    } else if (Clock::now() - asked_ >= kAskForValueAgain) {
      ask();
    }
  }

  void add_to(WakeUps& wake_ups) const override {
    wake_ups.subscriptions.push_back(events_->get_subscription_handle().get());
    if (question_) {
      question_->add_to(wake_ups);
    }
  }

  std::string waits_for() const override { return describe(request_); }

 private:
  using Clock = std::chrono::steady_clock;

  void ask() {
    auto request = std::make_shared<GetParameters::Request>();
    request->names = {request_.parameter.name};
    question_.emplace(node_, request_.node + "/get_parameters", std::move(request));
  }

  // True if the parameter has the value now.
  bool take_events() {
    ParameterEvent event;
    rclcpp::MessageInfo info;
    while (events_->take(event, info)) {
      if (event.node != request_.node) {
        continue;
      }
      for (const auto* const changes : {&event.new_parameters, &event.changed_parameters}) {
        for (const auto& change : *changes) {
          if (change.name == request_.parameter.name && check(value_of(change.value))) {
            return true;
          }
        }
      }
    }
    return false;
  }

  bool check(const std::optional<ParameterValue>& value) {
    if (value && are_equal(*value, request_.parameter.value)) {
      RosAnswer answer;
      answer.ok = true;
      end(answer);
      return true;
    }
    const std::string seen = value ? fmt::format("it is {}", to_python_text(*value)) : "it is not set";
    if (seen != seen_) {
      seen_ = seen;
      RosAnswer answer;
      answer.seen = seen;
      tell(answer);
    }
    return false;
  }

  const ParameterReached request_;
  rclcpp::Node& node_;
  rclcpp::Subscription<ParameterEvent>::SharedPtr events_;
  std::optional<ServiceCall<GetParameters>> question_;
  Clock::time_point asked_;
  std::string seen_;
};

}  // namespace

std::unique_ptr<Operation> wait_for(const ParameterReached& request, rclcpp::Node& node, Operation::Answer answer) {
  return std::make_unique<ParameterWait>(request, node, std::move(answer));
}

}  // namespace launch
