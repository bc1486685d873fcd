// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "incoming_messages.hpp"
#include "registry.hpp"

namespace rmw_fault_layer {

// Subscriptions and services with faults, by what rmw_wait() calls them: the `data` of their handles.
inline Registry<IncomingMessages>& waited_for() {
  static auto& instance = *new Registry<IncomingMessages>;  // never destroyed: see publishing.cpp
  return instance;
}

}  // namespace rmw_fault_layer
