// SPDX-License-Identifier: Apache-2.0
// A server on the real loop, and clients on a thread of their own.
#include "launcher/control/control_server.hpp"

#include <gmock/gmock.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <thread>
#include <vector>

namespace launch {
namespace {

using testing::HasSubstr;

constexpr int kPatience = 60'000;  // milliseconds, before a test fails

class ControlServerTest : public testing::Test {
 protected:
  ControlServerTest() : loop_(make_sd_event_loop()), listener_(::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0)) {
    // The kernel chooses a name that is no file.
    sockaddr_un any{};
    any.sun_family = AF_UNIX;
    EXPECT_EQ(::bind(listener_.get(), reinterpret_cast<sockaddr*>(&any), sizeof(sa_family_t)), 0);
    EXPECT_EQ(::listen(listener_.get(), 100), 0);
    server_ = std::make_unique<ControlServer>(
        *loop_, listener_.get(),
        ControlServer::Callbacks{[this](auto client, std::string_view line) { on_request(client, line); },
                                 [this](auto) { ++ready_; }, [this](auto) { ++gone_; },
                                 [](std::string_view why) { return "sorry: " + std::string(why); }});
  }

  // Echoes a line; "big N" gets N bytes as an answer, "offer" is offered lines until the queue is full.
  void on_request(ControlServer::ClientId client, std::string_view line) {
    if (line.starts_with("big ")) {
      server_->send(client, std::string(std::stoul(std::string(line.substr(4))), 'b'));
    } else if (line == "offer") {
      while (server_->offer(client, std::string(1000, 'o'))) {
        ++offered_;
      }
      server_->send(client, "full");
    } else {
      server_->send(client, std::string(line));
    }
  }

  // Runs the server while `clients` runs on another thread.
  void serve(const std::function<void()>& clients) {
    std::thread thread([&] {
      clients();
      loop_->post([this] { loop_->quit(); });
    });
    loop_->run();
    thread.join();
  }

  UniqueFd connect() const {
    sockaddr_un address{};
    socklen_t size = sizeof address;
    ::getsockname(listener_.get(), reinterpret_cast<sockaddr*>(&address), &size);
    UniqueFd fd(::socket(AF_UNIX, SOCK_STREAM, 0));
    EXPECT_EQ(::connect(fd.get(), reinterpret_cast<sockaddr*>(&address), size), 0);
    return fd;
  }

  static void send(const UniqueFd& fd, std::string_view text) {
    while (!text.empty()) {
      const ssize_t count = ::send(fd.get(), text.data(), text.size(), MSG_NOSIGNAL);
      if (count <= 0) {
        return;  // the server has dropped us
      }
      text.remove_prefix(static_cast<std::size_t>(count));
    }
  }

  // What comes until `text` ends with `end`, or until the server closes.
  static std::string receive(const UniqueFd& fd, std::string_view end = "\n") {
    std::string text;
    std::array<char, 65536> bytes{};
    pollfd readable{fd.get(), POLLIN, 0};
    while (::poll(&readable, 1, kPatience) == 1) {
      const ssize_t count = ::recv(fd.get(), bytes.data(), bytes.size(), 0);
      if (count <= 0) {
        break;
      }
      text.append(bytes.data(), static_cast<std::size_t>(count));
      if (!end.empty() && text.ends_with(end)) {
        break;
      }
    }
    return text;
  }

  std::unique_ptr<EventLoop> loop_;
  UniqueFd listener_;
  std::unique_ptr<ControlServer> server_;
  int ready_ = 0;
  int gone_ = 0;
  std::size_t offered_ = 0;
};

TEST_F(ControlServerTest, AnswersEachLineInOrder) {
  serve([&] {
    const UniqueFd client = connect();
    send(client, "one\ntwo\nthr");
    EXPECT_EQ(receive(client, "two\n"), "one\ntwo\n");
    send(client, "ee\n");
    EXPECT_EQ(receive(client), "three\n");
  });
}

TEST_F(ControlServerTest, AClientThatHasSentEverythingStillGetsItsAnswers) {
  serve([&] {
    const UniqueFd client = connect();
    send(client, "big 3000000\nlast\n");
    ::shutdown(client.get(), SHUT_WR);
    const std::string all = receive(client, "");
    EXPECT_EQ(all.size(), 3'000'001 + 5U);
    EXPECT_TRUE(all.ends_with("\nlast\n"));
  });
  EXPECT_EQ(gone_, 1);
}

TEST_F(ControlServerTest, AClientThatDoesNotReadBlocksNobody) {
  serve([&] {
    const UniqueFd lazy = connect();
    for (int i = 0; i < 20; ++i) {
      send(lazy, "big 500000\n");
    }
    const UniqueFd client = connect();
    send(client, "hello\n");
    EXPECT_EQ(receive(client), "hello\n");
    // Its requests have waited, none is lost.
    std::size_t size = 0;
    while (size < 20 * 500'001U) {
      const std::string part = receive(lazy);
      ASSERT_FALSE(part.empty());
      size += part.size();
    }
    EXPECT_EQ(size, 20 * 500'001U);
  });
}

TEST_F(ControlServerTest, AFullQueueTakesNoOfferUntilItHasRoom) {
  serve([&] {
    const UniqueFd client = connect();
    send(client, "offer\n");
    const std::string all = receive(client, "full\n");
    EXPECT_TRUE(all.ends_with("full\n"));
    send(client, "again\n");
    EXPECT_EQ(receive(client), "again\n");
  });
  EXPECT_GE(offered_ * 1001, ControlServer::kFullQueue);
  EXPECT_LE(offered_ * 1001, ControlServer::kFullQueue + 4'000'000) << "what the kernel takes, too";
  EXPECT_EQ(ready_, 1);
}

TEST_F(ControlServerTest, AnEndlessLineIsRefused) {
  serve([&] {
    const UniqueFd client = connect();
    send(client, std::string(10'000'000, 'x'));
    EXPECT_EQ(receive(client, ""), "sorry: a request is too long\n");
    const UniqueFd other = connect();
    send(other, "still there\n");
    EXPECT_EQ(receive(other), "still there\n");
  });
}

TEST_F(ControlServerTest, TooManyClientsAreRefused) {
  serve([&] {
    std::vector<UniqueFd> clients;
    for (std::size_t i = 0; i < ControlServer::kMostClients; ++i) {
      clients.push_back(connect());
      send(clients.back(), "in\n");
      EXPECT_EQ(receive(clients.back()), "in\n");
    }
    EXPECT_EQ(receive(connect(), ""), "sorry: too many clients\n");
    clients.clear();
    // The places become free as soon as the server has seen the ends.
    for (std::string answer; answer != "in\n";) {
      const UniqueFd client = connect();
      send(client, "in\n");
      answer = receive(client);
      ASSERT_FALSE(answer.empty());
    }
  });
}

TEST_F(ControlServerTest, AClientThatGoesAwayInTheMiddleIsForgotten) {
  serve([&] {
    {
      const UniqueFd client = connect();
      send(client, "big 5000000\nbig 5000000\n");
    }
    const UniqueFd other = connect();
    send(other, "hello\n");
    EXPECT_EQ(receive(other), "hello\n");
  });
  EXPECT_GE(gone_, 1);
}

}  // namespace
}  // namespace launch
