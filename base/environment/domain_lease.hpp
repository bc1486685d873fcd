// SPDX-License-Identifier: Apache-2.0
// A ROS domain that nobody else on this network has leased.
#pragma once

#include "base/files/unique_fd.hpp"

namespace launch {

// The lease is a bound TCP port, 32768 plus the domain. ROS 2's own tests (domain_coordinator, rmw_test_fixture) lease
// domains in the same way, so neither takes a domain of the other. Ports are shared by all users and belong to a
// network, as domains do. The kernel takes a port back when the last process that holds its socket has ended.
class DomainLease {
 public:
  // Passes over domains in which somebody communicates. Throws std::runtime_error when all domains are taken.
  DomainLease();

  int id() const { return id_; }
  // The socket, close-on-exec: a process that inherits it holds the lease, too.
  int fd() const { return socket_.get(); }

 private:
  int id_ = 0;
  UniqueFd socket_;
};

}  // namespace launch
