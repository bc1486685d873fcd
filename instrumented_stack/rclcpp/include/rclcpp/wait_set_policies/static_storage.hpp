// SPDX-License-Identifier: Apache-2.0
// Where rclcpp has the wait set whose entities are given to its constructor: StaticWaitSet.
#pragma once

#include "rclcpp/wait_set.hpp"
