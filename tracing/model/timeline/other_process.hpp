// SPDX-License-Identifier: Apache-2.0
// A process that the session of a launch has recorded although it does not belong to the launch.
#pragma once

#include <cstdint>
#include <string>

#include "tracing/model/analysis/results/field.hpp"

namespace tracing {

struct OtherProcess {
  std::int64_t vpid = 0;
  std::string name;
  std::string host;
  std::uint64_t events = 0;

  static const Field<OtherProcess> kFields[];
};
inline constexpr Field<OtherProcess> OtherProcess::kFields[] = {
    {"vpid", &OtherProcess::vpid, ""},
    {"name", &OtherProcess::name, "of its main thread, if that has events"},
    {"host", &OtherProcess::host, ""},
    {"events", &OtherProcess::events, "that were left out"},
};

}  // namespace tracing
