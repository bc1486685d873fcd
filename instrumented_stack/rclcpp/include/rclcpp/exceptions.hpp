// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <sstream>

#include "rclcpp/exceptions/exceptions.hpp"
