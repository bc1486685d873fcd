// SPDX-License-Identifier: Apache-2.0
// The floor of a tracepoint behind a library's function: the call alone.
extern "C" void empty_call(const void*, const void*) {}
