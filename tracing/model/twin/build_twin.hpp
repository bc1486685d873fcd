// SPDX-License-Identifier: Apache-2.0
// Makes a twin of a recorded system.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "tracing/model/twin/description/twin_system.hpp"
#include "tracing/model/twin/recording.hpp"

namespace tracing::twin {

struct BuildOptions {
  std::size_t cpus = 1;  // of the machine that was recorded
  std::uint64_t seed = 1;
  std::uint64_t bytes = 64;                    // of a message: a trace does not tell
  std::map<std::string, std::uint64_t> sizes;  // of topics for which it is known
};

// The sentences of System::missing say what the twin lacks.
System build_twin(const Recording& recording, const BuildOptions& options);

}  // namespace tracing::twin
