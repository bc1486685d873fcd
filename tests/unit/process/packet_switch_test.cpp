// SPDX-License-Identifier: Apache-2.0
// The switch between the networks of a test, with sockets for devices and on virtual time.
#include "launcher/process/isolation/packet_switch.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/socket.h>

#include <string>

#include "launcher/process/fake/fake_event_loop.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;

// A network whose only device is a port of the switch.
class Network {
 public:
  Network(PacketSwitch& to, std::uint8_t address) : address_(address) {
    int ends[2];
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK | SOCK_CLOEXEC, 0, ends), 0);
    end_.reset(ends[0]);
    to.add(UniqueFd(ends[1]));
  }

  // To one address, or 255: to all.
  void send(std::uint8_t to, const std::string& text) {
    const std::uint8_t many = to == 255 ? 255 : 2;
    std::string frame = {static_cast<char>(many),     0, 0, 0, 0, static_cast<char>(to), 2, 0, 0, 0, 0,
                         static_cast<char>(address_), 8, 0};
    frame += text;
    EXPECT_EQ(::write(end_.get(), frame.data(), frame.size()), static_cast<ssize_t>(frame.size()));
  }

  std::vector<std::string> received() {
    std::vector<std::string> texts;
    char frame[100];
    for (ssize_t size = 0; (size = ::read(end_.get(), frame, sizeof frame)) > 0;) {
      texts.emplace_back(frame + 14, frame + size);
    }
    return texts;
  }

 private:
  UniqueFd end_;
  std::uint8_t address_;
};

class PacketSwitchTest : public testing::Test {
 protected:
  void run_for(Duration time) {
    const EventLoop::SourcePtr end = loop_.after(time, [this] { loop_.quit(); });
    loop_.run();
  }

  FakeEventLoop loop_;
  PacketSwitch switch_{loop_};
  Network a_{switch_, 1};
  Network b_{switch_, 2};
  Network c_{switch_, 3};
};

TEST_F(PacketSwitchTest, PassesToAllUntilItKnowsAnAddress) {
  a_.send(255, "to all");
  a_.send(2, "to one that is not known");
  run_for(1ms);
  EXPECT_THAT(b_.received(), ElementsAre("to all", "to one that is not known"));
  EXPECT_THAT(c_.received(), ElementsAre("to all", "to one that is not known"));
  b_.send(1, "an answer");
  run_for(1ms);
  EXPECT_THAT(a_.received(), ElementsAre("an answer"));
  a_.send(2, "to one");
  run_for(1ms);
  EXPECT_THAT(c_.received(), IsEmpty());
}

TEST_F(PacketSwitchTest, SeparatesUntilItIsMended) {
  const std::size_t partition = switch_.impair({.one = {0}, .other = {1}, .loss = 1});
  a_.send(255, "lost");
  b_.send(255, "lost as well");
  run_for(1ms);
  EXPECT_THAT(b_.received(), IsEmpty());
  EXPECT_THAT(a_.received(), IsEmpty());
  EXPECT_THAT(c_.received(), ElementsAre("lost", "lost as well"));
  EXPECT_EQ(switch_.packets(partition), 2U);
  switch_.mend(partition);
  a_.send(255, "there");
  run_for(1ms);
  EXPECT_THAT(b_.received(), ElementsAre("there"));
  EXPECT_EQ(switch_.packets(partition), 2U);
}

TEST_F(PacketSwitchTest, LosesWhatTheSeedDraws) {
  const auto lost_of = [this](std::uint64_t seed) {
    const std::size_t loss = switch_.impair({.one = {0}, .other = {1, 2}, .loss = 0.3, .seed = seed});
    std::vector<std::string> all;
    for (int i = 0; i < 200; ++i) {
      a_.send(2, std::to_string(i));
      run_for(1ms);
      const std::vector<std::string> one = b_.received();
      all.insert(all.end(), one.begin(), one.end());
    }
    switch_.mend(loss);
    c_.received();
    return all;
  };
  b_.send(1, "here");
  run_for(1ms);
  const std::vector<std::string> first = lost_of(7);
  EXPECT_NEAR(static_cast<double>(first.size()), 140, 25);
  EXPECT_EQ(lost_of(7), first);
  EXPECT_NE(lost_of(8), first);
}

TEST_F(PacketSwitchTest, DelaysInOrder) {
  const std::size_t delay = switch_.impair({.one = {0}, .other = {1}, .delay = 50ms});
  a_.send(255, "first");
  run_for(20ms);
  a_.send(255, "second");
  run_for(20ms);
  EXPECT_THAT(b_.received(), IsEmpty());
  EXPECT_THAT(c_.received(), ElementsAre("first", "second"));
  run_for(15ms);
  EXPECT_THAT(b_.received(), ElementsAre("first"));
  switch_.mend(delay);
  a_.send(255, "third");
  run_for(1ms);
  EXPECT_THAT(b_.received(), ElementsAre("third"));
  run_for(30ms);
  EXPECT_THAT(b_.received(), ElementsAre("second"));
}

}  // namespace
}  // namespace launch
