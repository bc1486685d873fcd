// SPDX-License-Identifier: Apache-2.0
// The launch file of a twin: a stand-in for each process, recorded as the system was.
#pragma once

#include <string>

#include "tracing/model/twin/description/twin_system.hpp"

namespace tracing::twin {

struct LaunchFileOptions {
  std::string description = "twin.json";  // the name of the file beside the launch file
  bool ext_events = false;                // record provider ros2_ext, too
  std::size_t cpus = 0;                   // let the stand-ins run on so many processors only; 0: on all
};

std::string launch_file_of(const System& system, const LaunchFileOptions& options);

}  // namespace tracing::twin
