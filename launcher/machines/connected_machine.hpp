// SPDX-License-Identifier: Apache-2.0
// What a visit sees of a machine that its agent has told of. Packages and programs of its own environment are known
// without asking; other questions take a round trip each.
#pragma once

#include <memory>

#include "launcher/machines/machine_connection.hpp"
#include "launcher/substitution/machine_view.hpp"

namespace launch {

// The connection must outlive the view.
std::shared_ptr<MachineView> make_connected_machine(MachineConnection& connection, const AgentHello& hello);

}  // namespace launch
