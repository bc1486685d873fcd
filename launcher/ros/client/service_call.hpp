// SPDX-License-Identifier: Apache-2.0
// A call of a service that may not be there yet.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <rclcpp/rclcpp.hpp>
#include <string>
#include <utility>
#include <vector>

#include "launcher/ros/client/operation.hpp"

namespace launch {

// Sends the request once the service is matched, and again whenever one more service of the name appears: a process
// that was killed stays in the graph until its lease ends, so the first may have been a ghost. The first response
// counts.
template <typename ServiceT>
class ServiceCall {
 public:
  using Request = typename ServiceT::Request;
  using Response = typename ServiceT::Response;

  ServiceCall(rclcpp::Node& node, std::string service, std::shared_ptr<Request> request)
      : node_(node), service_(std::move(service)), request_(std::move(request)) {}

  // The response when there is one, null as long as there is none.
  std::shared_ptr<Response> look() {
    const std::size_t services = node_.count_services(service_);
    if (tries_.empty() || (tries_.back().sent && services > services_)) {
      tries_.push_back({node_.create_client<ServiceT>(service_)});
    }
    Try& last = tries_.back();
    if (!last.sent && is_settled(last, services)) {
      last.client->async_send_request(request_);
      last.sent = true;
    }
    if (last.sent) {
      services_ = services;
    }
    for (const Try& tried : tries_) {
      auto response = std::make_shared<Response>();
      rmw_request_id_t id{};
      if (tried.sent && tried.client->take_type_erased_response(response.get(), id)) {
        return response;
      }
    }
    return nullptr;
  }

  // All that were asked have gone.
  bool is_orphaned() const { return !tries_.empty() && tries_.back().sent && services_ == 0; }

  void add_to(Operation::WakeUps& wake_ups) const {
    for (const Try& tried : tries_) {
      wake_ups.clients.push_back(tried.client->get_client_handle().get());
      if (tried.ready_since && !tried.sent) {
        wake_ups.patience = std::min(wake_ups.patience, kSettling);
      }
    }
  }

  const std::string& service() const { return service_; }

 private:
  using Clock = std::chrono::steady_clock;
  struct Try {
    typename rclcpp::Client<ServiceT>::SharedPtr client;
    bool sent = false;
    std::optional<Clock::time_point> ready_since = {};
  };

  // A service is matched before or after the graph counts it, a moment apart. A request that went to a service which is
  // counted only afterwards would go to it twice.
  static constexpr std::chrono::nanoseconds kSettling = std::chrono::milliseconds(5);

  bool is_settled(Try& tried, std::size_t services) {
    if (services == 0 || !tried.client->service_is_ready()) {
      tried.ready_since.reset();
      return false;
    }
    if (!tried.ready_since || services != services_) {
      tried.ready_since = Clock::now();
      services_ = services;
    }
    return Clock::now() - *tried.ready_since >= kSettling;
  }

  rclcpp::Node& node_;
  std::string service_;
  std::shared_ptr<Request> request_;
  std::vector<Try> tries_;
  std::size_t services_ = 0;  // that there were when it was looked last
};

// An operation that is nothing but a call.
template <typename ServiceT>
class CallOperation : public Operation {
 public:
  using Read = std::function<RosAnswer(const typename ServiceT::Response&)>;

  CallOperation(Answer answer, ServiceCall<ServiceT> call, Read read)
      : Operation(std::move(answer)), call_(std::move(call)), read_(std::move(read)) {}

  void look() override {
    if (const auto response = call_.look()) {
      end(read_(*response));
    } else if (call_.is_orphaned()) {
      fail("the '" + call_.service() + "' service has gone before it answered");
    }
  }
  void add_to(WakeUps& wake_ups) const override { call_.add_to(wake_ups); }
  std::string waits_for() const override { return "the '" + call_.service() + "' service"; }

 private:
  ServiceCall<ServiceT> call_;
  Read read_;
};

}  // namespace launch
