// SPDX-License-Identifier: Apache-2.0
// What threads waited for processors is in the times that were recorded, and the simulation lets them wait once more.
#pragma once

#include "tracing/model/twin/description/twin_system.hpp"

namespace tracing::twin {

// Makes the delays of the callbacks, and their run times unless these are processor times, so much shorter that they
// and what threads wait for in the simulation together are as the system has them now. For simulations only: a stand-in
// waits while it takes the time that was recorded.
void take_off_simulated_waits(System& system);

}  // namespace tracing::twin
