// SPDX-License-Identifier: Apache-2.0
#pragma once

// Of a library that stands in, and is in each process that a command executes.
namespace tracetools {

// Whether the program, or a library that it has loaded, was linked with libtracetools.so. A library that is preloaded
// for it may be in a program that has no use for it.
bool is_needed() noexcept;

// Takes this library out of LD_PRELOAD, for what the process executes: that may be of another ROS 2, whose calls have
// other parameters. Call it before there are threads.
void keep_from_others();

}  // namespace tracetools
