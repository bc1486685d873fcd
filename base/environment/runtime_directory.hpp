// SPDX-License-Identifier: Apache-2.0
// Where the control sockets of a user's launches are: $XDG_RUNTIME_DIR/launch, else /tmp/launch-UID.
//
// Everybody can write to /tmp, so nothing there is trusted: a directory counts only if this user owns it and nobody
// else may look into it, and it is never reached through a link. It stays open, and sockets are reached through the
// descriptor, so nobody can exchange the directory afterwards.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "base/environment/environment.hpp"
#include "base/files/unique_fd.hpp"

namespace launch {

struct RuntimeDirectory {
  std::string path;
  UniqueFd fd;
  uid_t owner;

  // The address of a socket in the directory, short enough for every directory (sun_path has 108 bytes).
  std::string address(const std::string& name) const;

  // The first one that can be used; it is made if it is missing. Throws std::system_error.
  static RuntimeDirectory make(const Environment& environment);
  // Those that exist and can be used: a launch and its user may have different environments.
  static std::vector<RuntimeDirectory> find(const Environment& environment);
  // Those of other users, where they are without a variable; only root may look into them.
  static std::vector<RuntimeDirectory> find_of_others();
};

}  // namespace launch
