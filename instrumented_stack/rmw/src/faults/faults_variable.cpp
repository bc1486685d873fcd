// SPDX-License-Identifier: Apache-2.0
// The rmw of this stack applies the faults of $RMW_MESSAGE_FAULTS by itself.
#include "faults/message_faults.hpp"

// The library that does it for other middlewares (fault_layer) finds it and leaves the process alone.
extern "C" {
extern const int rmw_applies_message_faults;
const int rmw_applies_message_faults = 1;
}

namespace rmw_fastrtps {

const char* variable_of_faults() {
  return rmw_message_faults::kVariable;
}

}  // namespace rmw_fastrtps
