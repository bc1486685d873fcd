// SPDX-License-Identifier: Apache-2.0
#include "launcher/visit/requests.hpp"

namespace launch {

bool Requests::empty() const {
  return scopes.empty() && processes.empty() && handlers.empty() && unregistered.empty() && commands.empty() &&
         coroutines.empty() && loads.empty() && transitions.empty() && timers.empty() && tests.empty() && !shutdown;
}

}  // namespace launch
