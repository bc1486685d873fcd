// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "launcher/deploy/deployment.hpp"

namespace launch {

// Writes the files into the folder, which it makes. Files that an earlier export of this name has left there, and that
// are none of these, are removed. Throws std::runtime_error, and has written nothing, if a file is there that no export
// of this name has made.
void write_exported_files(const Deployment& deployment, const DeploymentOptions& options);

}  // namespace launch
