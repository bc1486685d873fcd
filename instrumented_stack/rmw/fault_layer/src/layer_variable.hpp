// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rmw_fault_layer {

// Like $RMW_MESSAGE_FAULTS, for this layer alone, which is then needed whatever the middleware does.
inline constexpr const char* kVariableOfLayer = "RMW_FAULT_LAYER";

}  // namespace rmw_fault_layer
