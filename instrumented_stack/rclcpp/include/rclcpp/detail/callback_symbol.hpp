// SPDX-License-Identifier: Apache-2.0
// The readable name of a callback for the event rclcpp_callback_register. It is kept in two words until it is needed.
#pragma once

#include <functional>
#include <typeinfo>

namespace rclcpp::detail {

// The name of a function, or the type of any other callable. The type of a lambda names the function around it.
class CallbackSymbol {
 public:
  template <typename CallbackT>
  static CallbackSymbol of(const CallbackT& /*callback*/) {
    return CallbackSymbol(nullptr, &typeid(CallbackT));
  }
  template <typename ResultT, typename... ArgumentTs>
  static CallbackSymbol of(ResultT (*function)(ArgumentTs...)) {
    return CallbackSymbol(reinterpret_cast<const void*>(function), nullptr);
  }
  template <typename ResultT, typename... ArgumentTs>
  static CallbackSymbol of(const std::function<ResultT(ArgumentTs...)>& function) {
    using FunctionT = ResultT (*)(ArgumentTs...);
    const FunctionT* plain = function.template target<FunctionT>();
    return plain ? of(*plain) : CallbackSymbol(nullptr, &function.target_type());
  }

  CallbackSymbol() = default;

  // Fires rclcpp_callback_register. `callback` must be the address that callback_start will report.
  void trace_registration(const void* callback) const;

 private:
  CallbackSymbol(const void* function, const std::type_info* type) : function_(function), type_(type) {}

  const void* function_ = nullptr;
  const std::type_info* type_ = nullptr;
};

}  // namespace rclcpp::detail
