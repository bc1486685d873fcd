// SPDX-License-Identifier: Apache-2.0
// Answers requests whose type is known only by name, at run time. Created by Node::create_generic_service().
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "rclcpp/any_service_callback.hpp"
#include "rclcpp/service_base.hpp"
#include "rclcpp/typesupport_helpers.hpp"

namespace rclcpp {

class GenericService;

// A user's callback in any of the forms of any_service_callback.hpp. Requests and responses are std::shared_ptr<void>,
// the service is a std::shared_ptr<GenericService>.
class GenericServiceCallback : public AnyServiceCallbackBase {
 public:
  using Header = std::shared_ptr<rmw_request_id_t>;
  using SharedRequest = std::shared_ptr<void>;
  using SharedResponse = std::shared_ptr<void>;
  using ServicePtr = std::shared_ptr<GenericService>;

  template <typename CallbackT>
  explicit GenericServiceCallback(CallbackT callback) {
    symbol_ = detail::CallbackSymbol::of(callback);
    if constexpr (std::is_invocable_v<CallbackT&, SharedRequest, SharedResponse>) {
      answer_ = [callback = std::move(callback)](const ServicePtr& service, const Header&,
                                                 SharedRequest request) mutable {
        SharedResponse response = response_of(service);
        callback(std::move(request), response);
        return response;
      };
    } else if constexpr (std::is_invocable_v<CallbackT&, Header, SharedRequest, SharedResponse>) {
      answer_ = [callback = std::move(callback)](const ServicePtr& service, const Header& header,
                                                 SharedRequest request) mutable {
        SharedResponse response = response_of(service);
        callback(header, std::move(request), response);
        return response;
      };
    } else if constexpr (std::is_invocable_v<CallbackT&, Header, SharedRequest>) {
      answer_ = [callback = std::move(callback)](const ServicePtr&, const Header& header,
                                                 SharedRequest request) mutable {
        callback(header, std::move(request));
        return SharedResponse();
      };
    } else {
      static_assert(std::is_invocable_v<CallbackT&, ServicePtr, Header, SharedRequest>,
                    "the callback takes none of the arguments that a service can give it");
      answer_ = [callback = std::move(callback)](const ServicePtr& service, const Header& header,
                                                 SharedRequest request) mutable {
        callback(service, header, std::move(request));
        return SharedResponse();
      };
    }
  }

  // Runs the callback. Returns null if the callback defers the response.
  SharedResponse dispatch(const ServicePtr& service, const Header& header, SharedRequest request);

 private:
  static SharedResponse response_of(const ServicePtr& service);

  std::function<SharedResponse(const ServicePtr&, const Header&, SharedRequest)> answer_;
};

// Requests and responses are messages in memory, as for a Service of the type. Cast them, or read and write them as
// bytes with a SerializationBase.
class GenericService : public ServiceBase, public std::enable_shared_from_this<GenericService> {
 public:
  using Request = void*;
  using Response = void*;
  using SharedRequest = std::shared_ptr<void>;
  using SharedResponse = std::shared_ptr<void>;
  RCLCPP_SMART_PTR_DEFINITIONS(GenericService)

  // `service_type` looks like "std_srvs/srv/SetBool". Throws exceptions::InvalidServiceTypeError if the type cannot be
  // found, and what the constructor of ServiceBase throws.
  GenericService(node_interfaces::NodeBaseInterface* node_base, const std::string& service_name,
                 const std::string& service_type, GenericServiceCallback any_callback, const QoS& qos = ServicesQoS());

  // Takes the next request without running the callback. Returns false if there is none.
  bool take_request(SharedRequest request_out, rmw_request_id_t& request_id_out) {
    return take_type_erased_request(request_out.get(), request_id_out);
  }
  // For callbacks that defer the response. May be called from any thread, once per request.
  void send_response(rmw_request_id_t& request_id, SharedResponse& response) {
    send_type_erased_response(request_id, response.get());
  }

  // New messages with the defaults of their types.
  std::shared_ptr<void> create_request() override;
  SharedResponse create_response();
  // The type support of the two messages, for a SerializationBase.
  const rosidl_service_type_support_t& get_service_type_support_handle() const { return *type_support_; }

  // Executors call it.
  void handle_request(std::shared_ptr<rmw_request_id_t> request_header, std::shared_ptr<void> request) override;

 private:
  GenericService(node_interfaces::NodeBaseInterface* node_base, const std::string& service_name,
                 const rosidl_service_type_support_t* type_support, GenericServiceCallback any_callback,
                 const QoS& qos);

  const rosidl_service_type_support_t* type_support_;
  GenericServiceCallback any_callback_;
};

}  // namespace rclcpp
