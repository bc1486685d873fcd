// SPDX-License-Identifier: Apache-2.0
#ifndef TRACETOOLS__PROVIDER_LOADER_HPP_
#define TRACETOOLS__PROVIDER_LOADER_HPP_

namespace tracetools {

/// Whether a session can record this process, now or later. False if tracing was turned off, or is impossible.
bool is_traceable() noexcept;

}  // namespace tracetools

#endif  // TRACETOOLS__PROVIDER_LOADER_HPP_
