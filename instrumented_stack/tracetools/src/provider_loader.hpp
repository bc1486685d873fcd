// SPDX-License-Identifier: Apache-2.0
#ifndef TRACETOOLS__PROVIDER_LOADER_HPP_
#define TRACETOOLS__PROVIDER_LOADER_HPP_

namespace tracetools {

/// Whether libtracetools_provider.so was opened when this library was loaded.
bool provider_is_loaded() noexcept;

}  // namespace tracetools

#endif  // TRACETOOLS__PROVIDER_LOADER_HPP_
