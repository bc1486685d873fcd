// SPDX-License-Identifier: Apache-2.0
// A call of a service that may not exist yet.
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

#include "programs/rclcpp_versions/rclcpp_versions.hpp"
#include "programs/ros_client/operation.hpp"

namespace launch {

// Sends the request once the service is matched, and again whenever one more service of the name appears. The first one
// may belong to a process that was killed, because such a process stays in the graph until its lease ends. The first
// response counts.
template <typename ServiceT>
class ServiceCall {
 public:
  using Request = typename ServiceT::Request;
  using Response = typename ServiceT::Response;

  ServiceCall(rclcpp::Node& node, std::string service, std::shared_ptr<Request> request)
      : node_(node), service_(std::move(service)), request_(std::move(request)) {}

  // Continues the call. Returns the response, or null as long as there is none.
  std::shared_ptr<Response> look() {
    const std::size_t services = rclcpp_versions::count_services(node_, service_);
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

  // Whether all services that got the request have gone.
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

  // A service is matched a moment before or after the graph counts it. Without this pause a request could go twice to a
  // service that is counted only after it got the request.
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
  std::size_t services_ = 0;  // the number of services at the last look
};

// An operation that is only a call.
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
