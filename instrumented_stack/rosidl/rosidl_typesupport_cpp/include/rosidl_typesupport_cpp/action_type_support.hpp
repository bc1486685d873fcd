// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rosidl_runtime_c/action_type_support_struct.h"
#include "rosidl_typesupport_cpp/message_type_support.hpp"
#include "rosidl_typesupport_cpp/service_type_support.hpp"

namespace rosidl_typesupport_cpp {

// The type support of action type T; every interface package specialises it for its types. Never null.
template <typename T>
const rosidl_action_type_support_t* get_action_type_support_handle();

// Combines the type supports of the services and messages that carry the action.
template <typename T>
const rosidl_action_type_support_t* action_type_support(const rosidl_type_description_t* description) {
  static const rosidl_action_type_support_t handle{
      get_service_type_support_handle<typename T::Impl::SendGoalService>(),
      get_service_type_support_handle<typename T::Impl::GetResultService>(),
      get_service_type_support_handle<typename T::Impl::CancelGoalService>(),
      get_message_type_support_handle<typename T::Impl::FeedbackMessage>(),
      get_message_type_support_handle<typename T::Impl::GoalStatusMessage>(),
      description};
  return &handle;
}

}  // namespace rosidl_typesupport_cpp
