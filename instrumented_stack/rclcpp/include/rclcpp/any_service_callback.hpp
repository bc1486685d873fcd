// SPDX-License-Identifier: Apache-2.0
// A user's service callback in any of its forms.
//
//   void(std::shared_ptr<Request>, std::shared_ptr<Response>)
//   void(std::shared_ptr<rmw_request_id_t>, std::shared_ptr<Request>, std::shared_ptr<Response>)
// fill in the response, which is sent when the callback returns;
//   void(std::shared_ptr<rmw_request_id_t>, std::shared_ptr<Request>)
//   void(std::shared_ptr<Service>, std::shared_ptr<rmw_request_id_t>, std::shared_ptr<Request>)
// defer the response: the callback, or other code later, calls Service::send_response().
#pragma once

#include <rmw/types.h>

#include <functional>
#include <memory>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "rclcpp/detail/callback_symbol.hpp"

namespace rclcpp {

template <typename ServiceT>
class Service;

namespace detail {

// Whether a callback of this type can be null: functions and pointers to functions.
template <typename CallbackT>
struct CanBeNull : std::is_pointer<CallbackT> {};
template <typename SignatureT>
struct CanBeNull<std::function<SignatureT>> : std::true_type {};

}  // namespace detail

// The part that does not depend on the service type. The address of this object is the `callback` of the trace events,
// so it must not move after trace_registration().
class AnyServiceCallbackBase {
 public:
  void trace_registration() const { symbol_.trace_registration(this); }

 protected:
  // Fire callback_start and callback_end.
  void trace_start() const;
  void trace_end() const;

  detail::CallbackSymbol symbol_;
};

template <typename ServiceT>
class AnyServiceCallback : public AnyServiceCallbackBase {
 public:
  using Request = typename ServiceT::Request;
  using Response = typename ServiceT::Response;
  using Header = std::shared_ptr<rmw_request_id_t>;

  AnyServiceCallback() = default;
  template <typename CallbackT>
  explicit AnyServiceCallback(CallbackT callback) {
    set(std::move(callback));
  }

  // Throws std::invalid_argument for a null function or pointer.
  template <typename CallbackT>
  void set(CallbackT callback) {
    if constexpr (detail::CanBeNull<CallbackT>::value) {
      if (callback == nullptr) {
        throw std::invalid_argument("AnyServiceCallback::set(): callback cannot be nullptr");
      }
    }
    symbol_ = detail::CallbackSymbol::of(callback);
    using RequestPtr = std::shared_ptr<Request>;
    using ResponsePtr = std::shared_ptr<Response>;
    using ServicePtr = std::shared_ptr<Service<ServiceT>>;
    if constexpr (std::is_invocable_v<CallbackT&, RequestPtr, ResponsePtr>) {
      answer_ = [callback = std::move(callback)](const ServicePtr&, const Header&, RequestPtr request) mutable {
        auto response = std::make_shared<Response>();
        callback(std::move(request), response);
        return response;
      };
    } else if constexpr (std::is_invocable_v<CallbackT&, Header, RequestPtr, ResponsePtr>) {
      answer_ = [callback = std::move(callback)](const ServicePtr&, const Header& header, RequestPtr request) mutable {
        auto response = std::make_shared<Response>();
        callback(header, std::move(request), response);
        return response;
      };
    } else if constexpr (std::is_invocable_v<CallbackT&, Header, RequestPtr>) {
      answer_ = [callback = std::move(callback)](const ServicePtr&, const Header& header, RequestPtr request) mutable {
        callback(header, std::move(request));
        return ResponsePtr();
      };
    } else {
      static_assert(std::is_invocable_v<CallbackT&, ServicePtr, Header, RequestPtr>,
                    "the callback takes none of the arguments that a service can give it");
      answer_ = [callback = std::move(callback)](const ServicePtr& service, const Header& header,
                                                 RequestPtr request) mutable {
        callback(service, header, std::move(request));
        return ResponsePtr();
      };
    }
  }

  // Runs the callback. Returns null if the callback defers the response. Throws std::runtime_error if none is set.
  std::shared_ptr<Response> dispatch(const std::shared_ptr<Service<ServiceT>>& service, const Header& header,
                                     std::shared_ptr<Request> request) {
    if (!answer_) {
      throw std::runtime_error("unexpected request without any callback set");
    }
    trace_start();
    std::shared_ptr<Response> response = answer_(service, header, std::move(request));
    trace_end();
    return response;
  }

 private:
  std::function<std::shared_ptr<Response>(const std::shared_ptr<Service<ServiceT>>&, const Header&,
                                          std::shared_ptr<Request>)>
      answer_;
};

}  // namespace rclcpp
