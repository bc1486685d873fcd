// SPDX-License-Identifier: Apache-2.0
// A ROS domain that no other test of this machine uses.
#pragma once

#include "launcher/base/unique_fd.hpp"

namespace launch_trace_testing {

// Holds the domain until the end of its life. Tests of all users and programs that use this class exclude each other,
// by locks on files in /tmp that the kernel takes back when a process dies.
class OwnDomain {
 public:
  // Throws std::runtime_error when all domains are taken.
  OwnDomain();
  int id() const { return id_; }

 private:
  int id_ = 0;
  launch::UniqueFd lock_;
};

}  // namespace launch_trace_testing
