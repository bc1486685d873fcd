// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tracetools {

// Whether a session can record this process, now or later. False if tracing was turned off, or is impossible.
bool is_traceable() noexcept;

}  // namespace tracetools
