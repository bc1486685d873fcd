// SPDX-License-Identifier: Apache-2.0
// What the names of LTTng sessions end with in the launches of a test, so that tests with the same launch file run side
// by side. Launches within launches inherit it.
#pragma once

namespace launch {

inline constexpr const char* kSessionSuffixVariable = "LAUNCH_SESSION_SUFFIX";

}  // namespace launch
