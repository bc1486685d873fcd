// SPDX-License-Identifier: Apache-2.0
// `launch serve`: shows the launches of this user in a browser.
#include <errno.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <signal.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <mutex>
#include <system_error>
#include <utility>

#include "base/diagnostics/command_error.hpp"
#include "base/environment/own_environment.hpp"
#include "base/files/unique_fd.hpp"
#include "base/processes/ending_signals.hpp"
#include "programs/serve/access.hpp"
#include "programs/serve/http_server.hpp"
#include "programs/serve/serve_options.hpp"
#include "programs/serve/service.hpp"

namespace launch::serve {
namespace {

UniqueFd listen_on(const ListenAddress& address, const std::string& text) {
  UniqueFd fd(::socket(address.address.ss_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  const int yes = 1;
  ::setsockopt(fd.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  if (!fd || ::bind(fd.get(), reinterpret_cast<const sockaddr*>(&address.address), address.size) != 0 ||
      ::listen(fd.get(), SOMAXCONN) != 0) {
    throw ServeError(fmt::format("can't listen on {}: {}", text, std::generic_category().message(errno)));
  }
  return fd;
}

std::string own_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

void log_line(const std::string& text) {
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  fmt::print("{}\n", text);
  std::fflush(stdout);
}

// Blocked in all threads, those that come later, too.
UniqueFd ending_signals() {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : kEndingSignals) {
    sigaddset(&set, signal);
  }
  ::sigprocmask(SIG_BLOCK, &set, nullptr);
  ::signal(SIGPIPE, SIG_IGN);
  return UniqueFd(::signalfd(-1, &set, SFD_CLOEXEC));
}

int serve(const ServeOptions& options) {
  const ListenAddress address = parse_listen_address(options.listen);
  check_exposure(options, address);
  const bool tls = !options.tls_certificate.empty();
  // Without a token file there are metrics alone, and nobody knows the token.
  constexpr std::size_t kTokenBytes = 32;
  AccessRules rules{.token = options.token_file.empty() ? random_text(kTokenBytes) : read_token(options.token_file),
                    .hosts = options.hosts,
                    .tls = tls,
                    .allow_control = options.allow_control,
                    .open_metrics = options.open_metrics};
  rules.hosts.push_back(own_name());
  const Certificate certificate =
      tls ? Certificate{read_pem(options.tls_certificate, "certificate"), read_pem(options.tls_key, "key")}
          : Certificate{};
  UniqueFd listener = listen_on(address, options.listen);
  const std::string url = url_of(listener.get(), tls);

  const UniqueFd signals = ending_signals();
  const UniqueFd stop(::eventfd(0, EFD_CLOEXEC));
  Access access(std::move(rules));
  Service service(access, own_environment(), stop.get(), log_line, options.nodes);
  HttpServer server(std::move(listener), tls ? &certificate : nullptr,
                    [&service](const HttpRequest& request) { return service.answer(request); });
  log_line(options.token_file.empty() ? fmt::format("metrics at {}metrics, until Ctrl-C", url)
                                      : fmt::format("{} launches at {}, until Ctrl-C",
                                                    options.allow_control ? "shows and steers" : "shows", url));

  constexpr int kTurn = 1000;  // milliseconds
  pollfd ended{signals.get(), POLLIN, 0};
  while (::poll(&ended, 1, kTurn) <= 0) {
    server.cut_late_connections();
    service.rest();
  }
  const std::uint64_t one = 1;
  static_cast<void>(!::write(stop.get(), &one, sizeof one));  // feeds end, and the server with them
  return 0;
}

}  // namespace
}  // namespace launch::serve

int main(int argc, char** argv) {
  using namespace launch::serve;
  constexpr const char* kCommand = "launch serve";
  ServeOptions options;
  if (const auto done = parse_serve_options({argv + 1, argv + argc}, options)) {
    return *done;
  }
  try {
    return serve(options);
  } catch (const ServeError& error) {
    fmt::print(stderr, "{}", launch::command_error(kCommand, error.what(), error.help()));
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}", launch::command_error(kCommand, error.what()));
  }
  return 1;
}
