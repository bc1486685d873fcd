// SPDX-License-Identifier: Apache-2.0
// ContentFilterOptions is part of the options of a subscription.
#pragma once

#include "rclcpp/subscription_options.hpp"
