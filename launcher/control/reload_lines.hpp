// SPDX-License-Identifier: Apache-2.0
// The lines of a control socket about reloads (docs/control.md).
#pragma once

#include <string>

#include "launcher/run/reload/reload_report.hpp"

namespace launch {

// Each returns a line without its end.
std::string reload_answer_line(ReloadNumber number);
std::string reload_line(const ReloadReport& report);
std::string reloaded_line(const ReloadEnd& end);

}  // namespace launch
