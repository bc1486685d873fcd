// SPDX-License-Identifier: Apache-2.0
#include "programs/serve/serve_options.hpp"

#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <cstdint>

#include "base/diagnostics/command_error.hpp"
#include "base/files/pipe.hpp"
#include "base/files/unique_fd.hpp"
#include "programs/command_line/subcommand.hpp"
#include "programs/serve/access.hpp"

namespace launch::serve {
namespace {

constexpr const char* kCommand = "launch serve";
constexpr std::size_t kShortestToken = 16;

int wrong(const std::string& what, const std::string& help = {}) {
  fmt::print(stderr, "{}", usage_error(kCommand, what, help));
  return kWrongCommandLine;
}

// How to make a file with a token that nobody guesses.
std::string token_recipe(const std::string& path) {
  return fmt::format("(umask 077; head -c 24 /dev/urandom | base64 > {})", path);
}

UniqueFd open_file(const std::string& path, const std::string& what, const std::string& help) {
  UniqueFd fd(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!fd) {
    throw ServeError(fmt::format("can't read the {} '{}': {}", what, path, ::strerror(errno)),
                     errno == ENOENT ? help : std::string());
  }
  return fd;
}

std::string trimmed(const std::string& text) {
  constexpr const char* kBlanks = " \t\r\n";
  const std::size_t begin = text.find_first_not_of(kBlanks);
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(kBlanks) + 1 - begin);
}

}  // namespace

std::optional<int> parse_serve_options(const std::vector<std::string>& words, ServeOptions& options) {
  Subcommand command(kCommand, "Shows the launches of this user in a browser, and steers them if it is allowed to.");
  command.take_text("--listen", options.listen, "ADDRESS:PORT; without it 127.0.0.1:7411; port 0 takes a free one");
  command.take_text("--token-file", options.token_file, "a file with the token that a user or a program must know");
  command.take_text("--tls-cert", options.tls_certificate, "the certificate, PEM; then HTTPS is spoken");
  command.take_text("--tls-key", options.tls_key, "the key of the certificate, PEM");
  command.take_texts("--host", options.hosts, "another name by which browsers ask for this machine");
  command.take_flag("--allow-control", options.allow_control, "not only show: start, stop, signal, shut down");
  command.take_flag("--nodes", options.nodes,
                    "show what nodes do: record them while a page shows it, or while /metrics is read");
  command.take_flag("--open-metrics", options.open_metrics, "answer /metrics without the token");
  command.take_flag("--insecure", options.insecure, "listen on other addresses without TLS");
  if (const auto exit_code = command.parse(words)) {
    return exit_code;
  }
  if (options.token_file.empty() && !options.open_metrics) {
    return wrong("--token-file is required", token_recipe("FILE"));
  }
  if (options.token_file.empty() && options.allow_control) {
    return wrong("--allow-control needs --token-file", token_recipe("FILE"));
  }
  if (options.tls_certificate.empty() != options.tls_key.empty()) {
    return wrong("--tls-cert and --tls-key belong together");
  }
  try {
    parse_listen_address(options.listen);
  } catch (const ServeError& error) {
    fmt::print(stderr, "{}", command_error(kCommand, error.what(), error.help()));
    return kWrongCommandLine;
  }
  return std::nullopt;
}

ListenAddress parse_listen_address(const std::string& text) {
  const ServeError error(fmt::format("--listen '{}' is no ADDRESS:PORT", text),
                         "an address is a number, such as 127.0.0.1:7411, 0.0.0.0:7411 or [::1]:7411");
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos) {
    throw error;
  }
  std::uint16_t port = 0;
  const char* const end = text.data() + text.size();
  if (const auto read = std::from_chars(text.data() + colon + 1, end, port);
      read.ec != std::errc() || read.ptr != end) {
    throw error;
  }
  std::string host = text.substr(0, colon);
  if (host.empty() || host == "localhost") {
    host = "127.0.0.1";
  }
  ListenAddress result;
  auto& four = reinterpret_cast<sockaddr_in&>(result.address);
  auto& six = reinterpret_cast<sockaddr_in6&>(result.address);
  const bool in_brackets = host.size() > 2 && host.front() == '[' && host.back() == ']';
  if (in_brackets && ::inet_pton(AF_INET6, host.substr(1, host.size() - 2).c_str(), &six.sin6_addr) == 1) {
    six.sin6_family = AF_INET6;
    six.sin6_port = htons(port);
    result.size = sizeof six;
    result.is_loopback = IN6_IS_ADDR_LOOPBACK(&six.sin6_addr);
  } else if (::inet_pton(AF_INET, host.c_str(), &four.sin_addr) == 1) {
    four.sin_family = AF_INET;
    four.sin_port = htons(port);
    result.size = sizeof four;
    constexpr unsigned kLoopback = 127;
    result.is_loopback = ntohl(four.sin_addr.s_addr) >> 24U == kLoopback;
  } else {
    throw error;
  }
  return result;
}

std::string url_of(int listener, bool tls) {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  ::getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size);
  std::array<char, INET6_ADDRSTRLEN> host{};
  const auto& four = reinterpret_cast<const sockaddr_in&>(address);
  const auto& six = reinterpret_cast<const sockaddr_in6&>(address);
  const bool is_six = address.ss_family == AF_INET6;
  ::inet_ntop(address.ss_family, is_six ? static_cast<const void*>(&six.sin6_addr) : &four.sin_addr, host.data(),
              host.size());
  return fmt::format("{}://{}{}{}:{}/", tls ? "https" : "http", is_six ? "[" : "", host.data(), is_six ? "]" : "",
                     ntohs(is_six ? six.sin6_port : four.sin_port));
}

void check_exposure(const ServeOptions& options, const ListenAddress& address) {
  if (!address.is_loopback && options.tls_certificate.empty() && !options.insecure) {
    throw ServeError(
        fmt::format("does not listen on {} without TLS: others could read the token", options.listen),
        "give --tls-cert and --tls-key, reach 127.0.0.1 through 'ssh -L', or say --insecure on a network of your own");
  }
}

std::string read_token(const std::string& path) {
  const UniqueFd fd = open_file(path, "token file", token_recipe(path));
  struct stat status {};
  if (::fstat(fd.get(), &status) != 0 || !S_ISREG(status.st_mode)) {
    throw ServeError(fmt::format("the token file '{}' is no file", path));
  }
  if ((status.st_mode & (S_IRWXG | S_IRWXO)) != 0 || (status.st_uid != ::geteuid() && status.st_uid != 0)) {
    throw ServeError(fmt::format("others than its user may read or change the token file '{}'", path),
                     fmt::format("chmod 600 {}, if nobody has read it so far", path));
  }
  std::string token = trimmed(read_to_end(fd));
  if (token.size() < kShortestToken) {
    throw ServeError(
        fmt::format("the token in '{}' has {} characters, and {} are the least", path, token.size(), kShortestToken),
        token_recipe(path));
  }
  if (token.find_first_of(" \t\r\n") != std::string::npos) {
    throw ServeError(fmt::format("the token in '{}' has blanks or several lines", path), token_recipe(path));
  }
  return token;
}

std::string read_pem(const std::string& path, const char* what) {
  return read_to_end(open_file(path, what, {}));
}

}  // namespace launch::serve
