// SPDX-License-Identifier: Apache-2.0
// Who may ask, and what. Decides by the request alone; all functions may be called by several threads.
//
// A program shows the token with each request (`Authorization: Bearer …`). A browser shows it once, in a form, and gets
// a cookie for a session. The cookie does not hold the token. Requests that a foreign page makes a browser send get no
// cookie (SameSite=Strict), and are refused by their Origin as well; so are requests for a foreign host, which a page
// gets that has made its own name an address of this machine.
#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "programs/serve/http_message.hpp"

namespace launch::serve {

// Compares in a time that depends on the length of `candidate` alone.
bool equal_in_constant_time(std::string_view candidate, std::string_view secret);

// So many random bytes of the kernel, as hexadecimal digits. Throws std::system_error.
std::string random_text(std::size_t bytes);

// "robot:7411" -> "robot", "[::1]:7411" -> "::1". Empty if this is no host with or without a port.
std::string host_without_port(std::string_view host);
bool is_ip_address(const std::string& host);

struct AccessRules {
  std::string token;
  std::vector<std::string> hosts;  // names by which this machine is asked for, besides addresses and "localhost"
  bool tls = false;
  bool allow_control = false;
  bool open_metrics = false;  // metrics are for whoever reaches the service
};

class Access {
 public:
  static constexpr std::size_t kMostSessions = 64;
  static constexpr std::chrono::hours kSession{12};
  using Clock = std::function<std::chrono::steady_clock::time_point()>;

  explicit Access(AccessRules rules, Clock now = std::chrono::steady_clock::now);

  enum class Verdict {
    kAllowed,
    kAmbiguous,      // 400
    kForeignHost,    // 421
    kForeignOrigin,  // 403
    kUnknown,        // 401: no token, or a wrong one
  };
  // Of a request for anything but the login.
  Verdict judge(const HttpRequest& request);
  // Of a request for the login, which needs no token yet.
  Verdict judge_login(const HttpRequest& request) const;

  bool allows_control() const { return rules_.allow_control; }
  bool has_tls() const { return rules_.tls; }
  bool opens_metrics() const { return rules_.open_metrics; }

  // Returns the id of a new session, or "" if the token is wrong. The oldest session ends if there are too many.
  std::string log_in(std::string_view token);
  void log_out(const HttpRequest& request);
  // Whether who has sent this request could send it now.
  bool is_known(const HttpRequest& request);

  // Cookies are for a host, whatever the port, so its name has the port.
  std::string cookie_name(const HttpRequest& request) const;
  // The value of Set-Cookie. An empty session removes the cookie.
  std::string cookie_text(const HttpRequest& request, const std::string& session) const;

 private:
  struct Session {
    std::string id;
    std::chrono::steady_clock::time_point end;
  };

  Verdict judge_place(const HttpRequest& request) const;
  bool is_own_host(std::string_view host) const;
  bool has_session(const HttpRequest& request);

  AccessRules rules_;
  Clock now_;
  std::mutex mutex_;
  std::vector<Session> sessions_;  // the oldest first
};

}  // namespace launch::serve
