// SPDX-License-Identifier: Apache-2.0
// The command line of `launch serve`, and the files that it names.
#pragma once

#include <netinet/in.h>
#include <sys/socket.h>

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace launch::serve {

// A sentence for the user, with what to do.
class ServeError : public std::runtime_error {
 public:
  explicit ServeError(const std::string& what, std::string help = {})
      : std::runtime_error(what), help_(std::move(help)) {}
  const std::string& help() const { return help_; }

 private:
  std::string help_;
};

struct ServeOptions {
  std::string listen = "127.0.0.1:7411";
  std::string token_file;
  std::string tls_certificate;
  std::string tls_key;
  std::vector<std::string> hosts;
  bool allow_control = false;
  bool nodes = false;
  bool open_metrics = false;
  bool insecure = false;
};

// Returns the exit code when there is nothing more to do: after --help, and after an error, which it has printed.
std::optional<int> parse_serve_options(const std::vector<std::string>& words, ServeOptions& options);

struct ListenAddress {
  sockaddr_storage address{};
  socklen_t size = 0;
  bool is_loopback = false;
};
// Of "127.0.0.1:7411", "[::1]:7411", "localhost:7411", or ":7411", which is 127.0.0.1. Port 0 is a free one. Throws
// ServeError.
ListenAddress parse_listen_address(const std::string& text);
// "http://127.0.0.1:7411/" of a socket that listens.
std::string url_of(int listener, bool tls);

// Whatever listens beyond this machine needs TLS, or the user's word that the network is safe. Throws ServeError.
void check_exposure(const ServeOptions& options, const ListenAddress& address);

// The text of the file without white space around it. Throws ServeError if others could read it, or if it is too short
// to be no guess.
std::string read_token(const std::string& path);
// Throws ServeError. `what` is "certificate".
std::string read_pem(const std::string& path, const char* what);

}  // namespace launch::serve
