// SPDX-License-Identifier: Apache-2.0
// Whether a trace tells at which addresses the files of a process are loaded (`lttng_ust_statedump:bin_info` and its
// like).
//
// LTTng-UST collects the addresses in every process: when the process starts, and once more for each session that
// records it. For that it reads the section headers of all files, in some thousand system calls: 1 to 2 ms each time.
#pragma once

#include <string>
#include <vector>

namespace tracing {

// In the environment of a process, it makes LTTng-UST collect nothing. Its value does not matter.
inline constexpr const char* kWithoutLoadAddresses = "LTTNG_UST_WITHOUT_BADDR_STATEDUMP";

bool records_load_addresses(const std::vector<std::string>& events_ust);

}  // namespace tracing
