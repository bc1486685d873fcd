// SPDX-License-Identifier: Apache-2.0
#include "tracing/testing/own_domain.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <stdexcept>

namespace launch_trace_testing {

namespace {

// Participants of these domains use ports below those that Linux gives to anyone. 0 is what people work with.
constexpr int kFirstDomain = 1;
constexpr int kLastDomain = 101;

}  // namespace

OwnDomain::OwnDomain() {
  constexpr int kCount = kLastDomain - kFirstDomain + 1;
  for (int i = 0; i < kCount; ++i) {
    // Tests that begin at the same time begin at different places.
    const int id = kFirstDomain + (static_cast<int>(::getpid()) + i) % kCount;
    const std::string path = fmt::format("/tmp/.ros_test_domain_{}", id);
    launch::UniqueFd file(::open(path.c_str(), O_RDONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0644));
    if (!file || ::flock(file.get(), LOCK_EX | LOCK_NB) != 0) continue;
    id_ = id;
    lock_ = std::move(file);
    return;
  }
  throw std::runtime_error(
      fmt::format("no ROS domain is free: other tests use all of {} to {}", kFirstDomain, kLastDomain));
}

}  // namespace launch_trace_testing
