// SPDX-License-Identifier: Apache-2.0
// Ports that accept, and what processes say by sd_notify(3).
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

#include "launcher/health/notify_probe.hpp"
#include "launcher/health/port_probe.hpp"
#include "launcher/process/fake/fake_event_loop.hpp"

namespace launch {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Protocol = PortAccepts::Protocol;

class PortProbeTest : public testing::Test {
 protected:
  // A port of 127.0.0.1 that is bound; nobody listens yet.
  PortProbeTest() {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socket_.reset(::socket(AF_INET, SOCK_STREAM, 0));
    EXPECT_EQ(::bind(socket_.get(), reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    socklen_t size = sizeof address;
    ::getsockname(socket_.get(), reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
  }
  PortProbe probe_of(const PortAccepts& port) {
    return PortProbe(loop_, port, 3s, [this](const Look& look) { answers_.push_back(look); });
  }
  Look look(PortProbe& probe) {
    probe.begin(::getpid());
    const Look look = probe.look(0s, 0s);
    while (look.result == Look::Result::kPending && answers_.empty()) {
      loop_.run_until_idle();  // the kernel makes the connection
    }
    return answers_.empty() ? look : std::exchange(answers_, {}).front();
  }

  FakeEventLoop loop_;
  UniqueFd socket_;
  std::uint16_t port_ = 0;
  std::vector<Look> answers_;
};

TEST_F(PortProbeTest, SomebodyMustListen) {
  PortProbe probe = probe_of({.host = "127.0.0.1", .port = port_});
  EXPECT_EQ(look(probe).why, "127.0.0.1:" + std::to_string(port_) + " does not accept connections: Connection refused");
  ::listen(socket_.get(), 4);
  EXPECT_EQ(look(probe).result, Look::Result::kGood);
}

TEST_F(PortProbeTest, LocalhostIsTriedByBothOfItsAddresses) {
  ::listen(socket_.get(), 4);
  PortProbe probe = probe_of({.host = "localhost", .port = port_});
  EXPECT_EQ(look(probe).result, Look::Result::kGood);
}

TEST_F(PortProbeTest, AConnectionThatIsNotMadeInTimeIsAFailure) {
  ::listen(socket_.get(), 0);
  std::vector<UniqueFd> others;  // more than the queue takes
  for (int i = 0; i < 5; ++i) {
    others.emplace_back(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0));
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(port_);
    ::connect(others.back().get(), reinterpret_cast<sockaddr*>(&address), sizeof address);
  }
  PortProbe probe = probe_of({.host = "127.0.0.1", .port = port_});
  probe.begin(::getpid());
  EXPECT_EQ(probe.look(0s, 0s).result, Look::Result::kPending);
  EXPECT_EQ(probe.look(1s, 1s).result, Look::Result::kPending) << "one connection at a time";
  loop_.advance(3s);
  ASSERT_EQ(answers_.size(), 1U);
  EXPECT_EQ(answers_[0].why, "127.0.0.1:" + std::to_string(port_) + " has not accepted a connection within 3 s");
}

TEST_F(PortProbeTest, APortOfUdpMustBeBound) {
  UniqueFd datagrams(::socket(AF_INET, SOCK_DGRAM, 0));
  PortProbe probe = probe_of({.protocol = Protocol::kUdp, .port = port_});
  EXPECT_EQ(look(probe).why, "nobody has the UDP port " + std::to_string(port_));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port_);
  ASSERT_EQ(::bind(datagrams.get(), reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  EXPECT_EQ(look(probe).result, Look::Result::kGood);
}

TEST_F(PortProbeTest, ASocketMayBeOfAnyType) {
  for (const int type : {SOCK_STREAM, SOCK_SEQPACKET, SOCK_DGRAM}) {
    const std::string name = "@port-probe-" + std::to_string(::getpid()) + "-" + std::to_string(type);
    PortProbe probe = probe_of({.protocol = Protocol::kUnix, .socket = name});
    EXPECT_THAT(look(probe).why, HasSubstr(name + " does not accept connections: Connection refused"));
    UniqueFd server(::socket(AF_UNIX, type, 0));
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path + 1, name.data() + 1, name.size() - 1);
    ASSERT_EQ(::bind(server.get(), reinterpret_cast<sockaddr*>(&address),
                     static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size())),
              0);
    if (type != SOCK_DGRAM) {
      ::listen(server.get(), 1);
    }
    EXPECT_EQ(look(probe).result, Look::Result::kGood) << type;
  }
}

TEST_F(PortProbeTest, AnotherNetworkIsNotLookedAt) {
  const fs::path proc = fs::path(testing::TempDir()) / ("port_proc_" + std::to_string(::getpid()));
  for (const char* const process : {"self", "7"}) {
    fs::create_directories(proc / process / "ns");
    fs::create_symlink(std::string("net:[") + process + "]", proc / process / "ns" / "net");
  }
  PortProbe probe(
      loop_, {.host = "127.0.0.1", .port = port_}, 3s, [](const Look&) {}, proc.string());
  probe.begin(7);
  EXPECT_EQ(probe.look(0s, 0s).note,
            "it has a network of its own, so its port can't be watched; watch it by a command");
  fs::remove_all(proc);
}

class NotifyProbeTest : public testing::Test {
 protected:
  NotifyProbeTest() { make(true); }
  void make(bool watchdog) {
    probe_.reset();
    probe_ = std::make_unique<NotifyProbe>(
        loop_, path_, watchdog, 3s,
        NotifyProbe::Callbacks{[this](const Look& look) { answers_.push_back(look.result); },
                               [this](const std::string& text) { status_ = text; }},
        ProcessorWait("/no such directory"));
    probe_->begin(1);
  }
  void say(const std::string& news) {
    const UniqueFd out(::socket(AF_UNIX, SOCK_DGRAM, 0));
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path, path_.data(), path_.size());
    EXPECT_GT(::sendto(out.get(), news.data(), news.size(), 0, reinterpret_cast<sockaddr*>(&address), sizeof address),
              0);
    loop_.run_until_idle();
  }
  Look look_for(int seconds) {
    Look look;
    for (int i = 0; i < seconds; ++i) {
      look = probe_->look(0s, 1s);
    }
    return look;
  }

  FakeEventLoop loop_;
  std::string path_ = testing::TempDir() + "notify-probe-" + std::to_string(::getpid());
  std::vector<Look::Result> answers_;
  std::string status_;
  std::unique_ptr<NotifyProbe> probe_;
};

TEST_F(NotifyProbeTest, WantsToHearThatTheProcessIsReady) {
  EXPECT_EQ(look_for(2).result, Look::Result::kPending);
  EXPECT_EQ(look_for(1).why, "it has not said that it is ready (READY=1) for 3.0 s");
  say("STATUS=loading\nREADY=1\n");
  EXPECT_THAT(answers_, ElementsAre(Look::Result::kGood)) << "at once: others may wait for it";
  EXPECT_EQ(status_, "loading");
}

TEST_F(NotifyProbeTest, WantsTheWatchdogToBeFed) {
  say("READY=1");
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(look_for(2).result, Look::Result::kGood);
    say("WATCHDOG=1");
  }
  EXPECT_EQ(look_for(3).why, "it has not said that it lives (WATCHDOG=1) for 3.0 s");
  say("WATCHDOG=1");
  EXPECT_EQ(look_for(1).result, Look::Result::kGood);
}

TEST_F(NotifyProbeTest, WithoutAWatchdogReadyIsEnough) {
  make(false);
  say("READY=1");
  EXPECT_EQ(look_for(100).result, Look::Result::kGood);
}

TEST_F(NotifyProbeTest, TheTimeCanBeChangedByTheProcess) {
  say("EXTEND_TIMEOUT_USEC=5000000");
  EXPECT_EQ(look_for(4).result, Look::Result::kPending);
  say("READY=1\nWATCHDOG_USEC=10000000");
  EXPECT_EQ(look_for(9).result, Look::Result::kGood);
  EXPECT_EQ(look_for(1).result, Look::Result::kBad);
}

TEST_F(NotifyProbeTest, AProcessMayAskForTheActionOfItsWatchdog) {
  say("READY=1");
  say("WATCHDOG=trigger");
  EXPECT_THAT(answers_, ElementsAre(Look::Result::kGood, Look::Result::kBad));
}

TEST_F(NotifyProbeTest, OneThatEndsIsNotJudged) {
  say("READY=1");
  say("STOPPING=1");
  EXPECT_EQ(look_for(10).result, Look::Result::kPending);
}

TEST_F(NotifyProbeTest, EachRunBeginsAnew) {
  say("READY=1");
  probe_->end();
  say("READY=1\nSTATUS=late");
  probe_->begin(2);
  EXPECT_EQ(look_for(1).result, Look::Result::kPending);
  EXPECT_EQ(status_, "");
}

TEST_F(NotifyProbeTest, TakesNonsense) {
  for (const char* const news : {"=", "READY", "READY=2", "WATCHDOG_USEC=-1", "WATCHDOG_USEC=99999999999999999999",
                                 "EXTEND_TIMEOUT_USEC=x", "\n\n=\n"}) {
    say(news);
  }
  say("STATUS=" + std::string(99, 'a') + "ä\t");
  EXPECT_EQ(status_, std::string(99, 'a'));
  EXPECT_THAT(answers_, IsEmpty());
  EXPECT_EQ(look_for(3).result, Look::Result::kBad);
}

TEST_F(NotifyProbeTest, RemovesItsSocket) {
  EXPECT_TRUE(fs::exists(path_));
  probe_.reset();
  EXPECT_FALSE(fs::exists(path_));
}

TEST_F(NotifyProbeTest, APathThatIsTooLongIsAnError) {
  const std::string path = "/tmp/" + std::string(200, 'x');
  EXPECT_THROW(NotifyProbe(loop_, path, false, 3s, {}), std::system_error);
}

}  // namespace
}  // namespace launch
