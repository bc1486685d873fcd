// SPDX-License-Identifier: Apache-2.0
// The launches of this user, and one of them by its number. Each function connects anew, and waits some seconds at most
// for a launch that is busy. Several threads may call them.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

#include "base/environment/environment.hpp"
#include "launcher/control/control_client.hpp"

namespace launch::serve {

// What each launch says to "info", sorted by number. One that does not answer has `pid`, and `error` with the reason.
ControlClient::Json launch_list(const Environment& environment);

// Nothing if it does not run.
std::optional<ControlClient> find_launch(const Environment& environment, pid_t pid);

}  // namespace launch::serve
