// SPDX-License-Identifier: Apache-2.0
// Reads what the tracer's counters say about events that it could not keep.
#pragma once

#include <string>

#include "tracing/record/account/loss_account.hpp"

namespace tracing {

// The losses per channel so far. The session must still exist; the numbers are final once it is stopped and no data is
// pending. Throws TraceError.
LossAccount read_losses(const std::string& lttng_session_name);

}  // namespace tracing
