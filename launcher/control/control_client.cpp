// SPDX-License-Identifier: Apache-2.0
#include "launcher/control/control_client.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <utility>

#include "launcher/control/control_protocol.hpp"

namespace launch {
namespace {

using Json = ControlClient::Json;
using std::chrono::milliseconds;

// A launcher answers within microseconds. One that has been stopped does not answer at all.
constexpr milliseconds kPatience{5000};
constexpr int kForEver = -1;

}  // namespace

void ControlClient::send_request(const Json& request) {
  if (!found_.connected) {
    throw_no_answer();
  }
  Json whole{{"version", kControlVersion}};
  whole.update(request);
  send(whole.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
}

void ControlClient::throw_no_answer() const {
  const std::string of = found_.user.empty() ? "" : fmt::format(" of {}", found_.user);
  throw ControlError(fmt::format("launch {}{} does not answer", pid(), of),
                     "it is busy or stopped: see its terminal, or end it by 'kill'");
}

template <typename HasAnswer>
void ControlClient::wait_for_answer(const HasAnswer& has_answer) {
  const auto until = std::chrono::steady_clock::now() + kPatience;
  while (!has_answer()) {
    if (ended_) {
      throw ControlError(fmt::format("launch {} has ended", pid()));
    }
    const auto left = std::chrono::duration_cast<milliseconds>(until - std::chrono::steady_clock::now()).count();
    if (left <= 0) {
      throw_no_answer();
    }
    receive(static_cast<int>(left));
  }
}

Json ControlClient::ask(const Json& request) {
  send_request(request);
  std::optional<Json> answer;
  wait_for_answer([&] { return (answer = take(true)).has_value(); });
  if (!answer->value("ok", false)) {
    throw ControlError(answer->value("error", "the launch has given no reason"), answer->value("help", ""));
  }
  return *std::move(answer);
}

std::string ControlClient::ask_for_line(const Json& request) {
  send_request(request);
  std::size_t end = 0;
  wait_for_answer([&] { return (end = buffer_.find('\n')) != std::string::npos; });
  std::string line = std::exchange(buffer_, buffer_.substr(end + 1));
  line.resize(end);
  return line;
}

std::optional<Json> ControlClient::next() {
  std::optional<Json> event;
  while (!(event = take(false)) && !ended_) {
    receive(kForEver);
  }
  return event;
}

std::optional<Json> ControlClient::next(milliseconds patience) {
  std::optional<Json> event = take(false);
  if (!event && !ended_ && receive(static_cast<int>(patience.count()))) {
    event = take(false);
  }
  return event;
}

// Events may come before the answer to a request.
std::optional<Json> ControlClient::take(bool answer) {
  std::optional<Json> found;
  const auto take_kept = [&] {
    if (!answer && !found && !events_.empty()) {
      found = std::move(events_.front());
      events_.pop_front();
    }
  };
  take_kept();
  std::size_t begin = 0;
  for (std::size_t end; !found && (end = buffer_.find('\n', begin)) != std::string::npos; begin = end + 1) {
    Json line = Json::parse(buffer_.begin() + static_cast<std::ptrdiff_t>(begin),
                            buffer_.begin() + static_cast<std::ptrdiff_t>(end), nullptr, false);
    if (!line.is_object()) {
      throw ControlError(fmt::format("launch {} speaks another language", pid()));
    }
    if (line.contains("ok") == answer) {
      found = std::move(line);
    } else {
      events_.push_back(std::move(line));
    }
  }
  buffer_.erase(0, begin);
  take_kept();  // an answer that nobody has waited for
  return found;
}

bool ControlClient::receive(int patience) {
  pollfd readable{fd(), POLLIN, 0};
  if (::poll(&readable, 1, patience) <= 0) {
    return false;
  }
  std::array<char, 64 * 1024> bytes;  // not initialised: it is read into
  const ssize_t count = ::recv(fd(), bytes.data(), bytes.size(), 0);
  if (count > 0) {
    buffer_.append(bytes.data(), static_cast<std::size_t>(count));
  } else if (count == 0 || (errno != EINTR && errno != EAGAIN)) {
    ended_ = true;
  }
  return true;
}

void ControlClient::send(std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::send(fd(), text.data(), text.size(), MSG_NOSIGNAL);
    if (count > 0) {
      text.remove_prefix(static_cast<std::size_t>(count));
    } else if (errno == EAGAIN) {
      pollfd writable{fd(), POLLOUT, 0};
      if (::poll(&writable, 1, static_cast<int>(kPatience.count())) == 0) {
        throw_no_answer();
      }
    } else if (errno != EINTR) {
      ended_ = true;
      throw ControlError(fmt::format("launch {} has ended", pid()));
    }
  }
}

std::string files_of(const Json& answer) {
  std::string names;
  for (const Json& file : answer.at("launch").at("files")) {
    names += (names.empty() ? "" : ", ") + std::filesystem::path(file.get<std::string>()).filename().string();
  }
  return names;
}

namespace {

// Whether the launch has the file: by its name, or by a path, from here or absolute.
bool is_file_of(const Json& answer, const std::string& wanted) {
  std::error_code unknown;
  const std::filesystem::path path = std::filesystem::weakly_canonical(wanted, unknown);
  const std::string files = files_of(answer);
  const Json& paths = answer.at("launch").at("files");
  return (", " + files + ", ").find(", " + wanted + ", ") != std::string::npos ||
         std::any_of(paths.begin(), paths.end(), [&](const Json& file) {
           const auto& text = file.get_ref<const std::string&>();
           return text == wanted || (!path.empty() && std::filesystem::weakly_canonical(text, unknown) == path);
         });
}

}  // namespace

ControlClient choose_launch(const Environment& environment, const std::string& wanted) {
  std::vector<ControlClient> all;
  for (FoundLaunch& found : find_launches(environment, WhoseLaunches::kAll)) {
    all.emplace_back(std::move(found));
  }
  if (all.empty()) {
    throw ControlError("no launch runs");
  }
  std::string list;
  std::vector<ControlClient> chosen;
  const auto is_own = [](const ControlClient& client) { return client.user().empty(); };
  const bool has_own = std::any_of(all.begin(), all.end(), is_own);
  if (wanted.empty() && has_own) {
    std::erase_if(all, [&](const ControlClient& client) { return !is_own(client); });
  }
  const bool only = all.size() == 1 && wanted.empty() && has_own;
  for (ControlClient& client : all) {
    if (only) {
      return std::move(client);
    }
    std::string files;
    bool named = false;
    try {
      const Json answer = client.ask("info");
      files = files_of(answer);
      named = is_file_of(answer, wanted);
    } catch (const ControlError& error) {
      if (client.ended()) {
        continue;
      }
      files = error.what();
    }
    list += fmt::format("\n  {:<8} {}{}", client.pid(), files, is_own(client) ? "" : ", of " + client.user());
    if ((wanted.empty() && has_own) || wanted == std::to_string(client.pid()) || named) {
      chosen.push_back(std::move(client));
    }
  }
  if (list.empty()) {
    throw ControlError("no launch runs");
  }
  if (chosen.empty() && wanted.empty()) {
    throw ControlError(fmt::format("no launch of this user runs; choose one with --launch NUMBER:{}", list));
  }
  if (chosen.empty()) {
    throw ControlError(fmt::format("launch '{}' does not run; there are:{}", wanted, list));
  }
  if (chosen.size() > 1) {
    throw ControlError(wanted.empty() ? fmt::format("several launches run; choose one with --launch NUMBER:{}", list)
                                      : fmt::format("several launches have the file '{}':{}", wanted, list));
  }
  return std::move(chosen.front());
}

}  // namespace launch
