// SPDX-License-Identifier: Apache-2.0
// The faults that are not those of a process: of messages, of the network, of simulated time, of a disk.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "launcher/language/fields.hpp"
#include "launcher/visit/fault_draw.hpp"
#include "launcher/visit/fault_request.hpp"

namespace launch {

// What a fault does, evaluated in a scope, before anything is drawn.
struct FaultRanges {
  std::string identity;  // as draws of the seed know it
  bool is_random = false;
  std::function<decltype(FaultRequest::what)(const FaultDraw&)> draw;
};

// Evaluates a fault of this process, or clock. Throws LaunchError.
using PerformFault = std::function<FaultRanges(const std::string& process, Scope&)>;

// For each of them the attributes that others don't have, and the evaluation of a fault with these fields. Throws
// LaunchError when attributes don't go together. The fields must live as long as what is returned.
std::vector<AttributeSpec> message_fault_attributes();
PerformFault message_fault(const Fields& fields, MessageFault::Kind kind);
std::vector<AttributeSpec> network_fault_attributes();
PerformFault network_fault(const Fields& fields, NetworkFault::Kind kind);
std::vector<AttributeSpec> clock_fault_attributes();
PerformFault clock_fault(const Fields& fields, ClockFault::Kind kind);
std::vector<AttributeSpec> disk_fault_attributes();
PerformFault disk_fault(const Fields& fields);

}  // namespace launch
