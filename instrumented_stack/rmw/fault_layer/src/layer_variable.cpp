// SPDX-License-Identifier: Apache-2.0
#include "layer_variable.hpp"

#include <cstdlib>

#include "faults/message_faults.hpp"

namespace rmw_fastrtps {

const char* variable_of_faults() {
  return std::getenv(rmw_fault_layer::kVariableOfLayer) != nullptr ? rmw_fault_layer::kVariableOfLayer
                                                                   : rmw_message_faults::kVariable;
}

}  // namespace rmw_fastrtps
