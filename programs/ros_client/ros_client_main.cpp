// SPDX-License-Identifier: Apache-2.0
// launch-ros-client NODE: answers requests about the ROS graph until its standard input, a socket, closes.
#include <fmt/format.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <rclcpp/rclcpp.hpp>
#include <string>
#include <thread>

#include "programs/ros_client/request_loop.hpp"

namespace {

using launch::RequestLoop;

// Runs until the launcher has gone.
void read_requests(RequestLoop& loop) {
  std::string unread;
  std::array<char, 4096> buffer{};
  while (true) {
    const ssize_t count = ::read(STDIN_FILENO, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) {
      continue;
    }
    if (count <= 0) {
      loop.quit();
      return;
    }
    unread.append(buffer.data(), static_cast<std::size_t>(count));
    std::size_t begin = 0;
    for (std::size_t end = 0; (end = unread.find('\n', begin)) != std::string::npos; begin = end + 1) {
      try {
        loop.post(launch::parse_request_line(std::string_view(unread).substr(begin, end - begin)));
      } catch (const std::exception& error) {
        fmt::print(stderr, "launch-ros-client: {}\n", error.what());
      }
    }
    unread.erase(0, begin);
  }
}

void send_answer(const launch::RosAnswerLine& line) {
  const std::string text = to_line(line);
  for (std::size_t sent = 0; sent < text.size();) {
    const ssize_t count = ::send(STDIN_FILENO, text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
    if (count < 0 && errno != EINTR) {
      return;  // the launcher has gone; the reader notices it, too
    }
    sent += count > 0 ? static_cast<std::size_t>(count) : 0;
  }
}

rclcpp::Node::SharedPtr make_node(const std::string& name) {
  return std::make_shared<rclcpp::Node>(name, rclcpp::NodeOptions()
                                                  .start_parameter_services(false)
                                                  .start_parameter_event_publisher(false)
                                                  .enable_rosout(false)
                                                  .use_global_arguments(false));
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) {
    fmt::print(stderr, "launch-ros-client is started by launch, not by hand\n");
    return EXIT_FAILURE;
  }
  rclcpp::init(0, nullptr, rclcpp::InitOptions().auto_initialize_logging(false), rclcpp::SignalHandlerOptions::None);
  {
    const rclcpp::Node::SharedPtr node = make_node(argv[1]);
    RequestLoop loop(*node, send_answer);
    std::thread reader([&loop] { read_requests(loop); });
    try {
      loop.run();
    } catch (const std::exception& error) {
      fmt::print(stderr, "launch-ros-client: error: {}\n", error.what());
      std::_Exit(EXIT_FAILURE);  // the reader waits for input that may never come
    }
    reader.join();
  }
  rclcpp::shutdown();
  return EXIT_SUCCESS;
} catch (const std::exception& error) {
  fmt::print(stderr, "launch-ros-client: error: {}\n", error.what());
  return EXIT_FAILURE;
}
