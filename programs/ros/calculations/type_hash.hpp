// SPDX-License-Identifier: Apache-2.0
// The hashes of interfaces, RIHS01: all systems have the same hash for the same definition.
#pragma once

#include <string>

#include "launcher/message_types/interface_type.hpp"

namespace launch {

// "RIHS01_" and 64 hexadecimal digits.
std::string type_hash(const MessageType& message);
// `event` is the message of the introspection of the service, NAME_Event.
std::string service_type_hash(const ServiceType& service, const MessageType& event);

}  // namespace launch
