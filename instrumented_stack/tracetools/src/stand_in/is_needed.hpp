// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tracetools {

// Whether the program, or a library that it has loaded, was linked with libtracetools.so. A library that is preloaded
// for it may be in a program that has no use for it.
bool is_needed() noexcept;

}  // namespace tracetools
