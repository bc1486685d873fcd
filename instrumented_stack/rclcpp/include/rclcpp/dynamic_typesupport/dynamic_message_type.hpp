// SPDX-License-Identifier: Apache-2.0
// DynamicMessageType, of which rclcpp has only the name.
#pragma once

#include "rclcpp/dynamic_typesupport/dynamic_serialization_support.hpp"
