// SPDX-License-Identifier: Apache-2.0
#include "base/environment/domain_lease.hpp"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <memory>
#include <set>
#include <vector>

#include "base/files/pipe.hpp"

namespace launch {
namespace {

bool can_bind(int type, int port) {
  const UniqueFd socket(::socket(AF_INET, type, 0));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<in_port_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return ::bind(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
}

TEST(DomainLease, GivesEachHolderADomainOfItsOwn) {
  std::vector<DomainLease> leases(5);
  std::set<int> domains;
  for (const DomainLease& lease : leases) {
    EXPECT_GE(lease.id(), 1);
    EXPECT_LE(lease.id(), 101);
    domains.insert(lease.id());
  }
  EXPECT_EQ(domains.size(), leases.size());
}

TEST(DomainLease, IsSeenByTheTestsOfRos2) {
  const DomainLease lease;
  EXPECT_FALSE(can_bind(SOCK_STREAM, 32768 + lease.id())) << "rmw_test_fixture binds this port";
}

TEST(DomainLease, PassesOverADomainThatIsInUse) {
  int domain = 0;
  {
    const DomainLease lease;
    domain = lease.id();
  }
  const UniqueFd participant(::socket(AF_INET, SOCK_DGRAM, 0));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<in_port_t>(7400 + 250 * domain + 10));
  ASSERT_EQ(::bind(participant.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  EXPECT_NE(DomainLease().id(), domain);
}

TEST(DomainLease, EndsWithItsHolderHoweverThatEnds) {
  Pipe domain = make_pipe();
  const pid_t holder = ::fork();
  if (holder == 0) {
    const DomainLease lease;
    const int id = lease.id();
    static_cast<void>(!::write(domain.write.get(), &id, sizeof id));
    ::pause();
    ::_exit(1);
  }
  int id = 0;
  ASSERT_EQ(::read(domain.read.get(), &id, sizeof id), static_cast<ssize_t>(sizeof id));
  EXPECT_FALSE(can_bind(SOCK_STREAM, 32768 + id));
  ::kill(holder, SIGKILL);
  ::waitpid(holder, nullptr, 0);
  EXPECT_TRUE(can_bind(SOCK_STREAM, 32768 + id));
}

}  // namespace
}  // namespace launch
