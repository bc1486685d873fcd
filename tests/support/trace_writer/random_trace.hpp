// SPDX-License-Identifier: Apache-2.0
// Writes a valid CTF 1.8 trace whose shape depends on a seed: both event headers, clocks that wrap, byte orders,
// alignments, contexts of streams and of events, every kind of field including nested ones, losses, several streams.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

namespace tracing::testing {

// Creates the directory. The same seed gives the same trace.
void write_random_trace(const std::filesystem::path& directory, std::uint32_t seed);

// The numbers decide the shape and the values. They may end in zeros.
void write_random_trace(const std::filesystem::path& directory, std::function<std::uint64_t()> random);

}  // namespace tracing::testing
