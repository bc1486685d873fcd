// SPDX-License-Identifier: Apache-2.0
// What an agent has to know of a process to start it. What follows after its end is decided by the launcher: respawn,
// limits of starts and health are not among it.
#pragma once

#include "launcher/machines/protocol/wire.hpp"
#include "launcher/process/process_spec.hpp"

namespace launch {

void put(WireWriter& writer, const ProcessSpec& spec);
// Throws WireError, also for a spec that could not be started by anybody, such as one without words.
ProcessSpec get_spec(WireReader& reader);

}  // namespace launch
