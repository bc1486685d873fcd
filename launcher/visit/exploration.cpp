// SPDX-License-Identifier: Apache-2.0
#include "launcher/visit/exploration.hpp"

#include <vector>

namespace launch {

void Exploration::remark(Diagnostic diagnostic) const {
  if (is_on() && observer_.judges && !scope_.incomplete && !scope_.command_was_left_out()) {
    report(LaunchError(std::vector<Diagnostic>{std::move(diagnostic)}));
  }
}

void Exploration::tell_left_out(Requests requests) const {
  if (observer_.left_out) {
    observer_.left_out(std::move(requests));
  }
}

}  // namespace launch
