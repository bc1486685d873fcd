// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "launcher/deploy/deployment.hpp"

namespace launch {

// Adds what neither Compose nor Kubernetes can say of a service.
void leave_out_of_containers(const Service& service, const DeploymentOptions& options, std::vector<LeftOut>& left_out);

}  // namespace launch
