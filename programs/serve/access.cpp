// SPDX-License-Identifier: Apache-2.0
#include "programs/serve/access.hpp"

#include <arpa/inet.h>
#include <errno.h>
#include <fmt/format.h>
#include <strings.h>
#include <sys/random.h>

#include <algorithm>
#include <array>
#include <system_error>
#include <utility>

namespace launch::serve {
namespace {

constexpr std::size_t kSessionBytes = 32;

bool same_name(const std::string& left, const std::string& right) {
  return ::strcasecmp(left.c_str(), right.c_str()) == 0;
}

bool changes_something(const HttpRequest& request) {
  return request.method != "GET" && request.method != "HEAD";
}

std::string_view bearer_of(const HttpRequest& request) {
  constexpr std::string_view kScheme = "Bearer ";
  const std::string& value = request.header_or_empty("authorization");
  return value.size() > kScheme.size() && ::strncasecmp(value.c_str(), kScheme.data(), kScheme.size()) == 0
             ? std::string_view(value).substr(kScheme.size())
             : std::string_view();
}

}  // namespace

bool equal_in_constant_time(std::string_view candidate, std::string_view secret) {
  unsigned different = candidate.size() == secret.size() && !secret.empty() ? 0U : 1U;
  for (std::size_t i = 0; i < candidate.size(); ++i) {
    const char expected = secret.empty() ? '\0' : secret[i % secret.size()];
    different |= static_cast<unsigned char>(candidate[i]) ^ static_cast<unsigned char>(expected);
  }
  return different == 0;
}

std::string random_text(std::size_t bytes) {
  std::string random(bytes, '\0');
  if (::getrandom(random.data(), bytes, 0) != static_cast<ssize_t>(bytes)) {
    throw std::system_error(errno, std::system_category(), "the kernel gives no random bytes");
  }
  std::string text;
  for (const char byte : random) {
    text += fmt::format("{:02x}", static_cast<unsigned char>(byte));
  }
  return text;
}

std::string host_without_port(std::string_view host) {
  const auto is_port = [](std::string_view text) {
    return text.empty() || (text.size() > 1 && text[0] == ':' && text.find_first_not_of("0123456789", 1) == text.npos);
  };
  if (host.starts_with('[')) {
    const std::size_t end = host.find(']');
    return end != std::string_view::npos && is_port(host.substr(end + 1)) ? std::string(host.substr(1, end - 1))
                                                                          : std::string();
  }
  const std::size_t colon = std::min(host.find(':'), host.size());
  return is_port(host.substr(colon)) ? std::string(host.substr(0, colon)) : std::string();
}

bool is_ip_address(const std::string& host) {
  std::array<unsigned char, sizeof(in6_addr)> address{};
  return ::inet_pton(AF_INET, host.c_str(), address.data()) == 1 ||
         ::inet_pton(AF_INET6, host.c_str(), address.data()) == 1;
}

Access::Access(AccessRules rules, Clock now) : rules_(std::move(rules)), now_(std::move(now)) {}

// A page whose own name leads here keeps its name in Host. An address is no name, so it can't be made to lead here.
bool Access::is_own_host(std::string_view host) const {
  const std::string name = host_without_port(host);
  return same_name(name, "localhost") || is_ip_address(name) ||
         std::any_of(rules_.hosts.begin(), rules_.hosts.end(),
                     [&](const std::string& own) { return !name.empty() && same_name(name, own); });
}

Access::Verdict Access::judge_place(const HttpRequest& request) const {
  if (request.ambiguous_head) {
    return Verdict::kAmbiguous;
  }
  const std::string& host = request.header_or_empty("host");
  if (!is_own_host(host)) {
    return Verdict::kForeignHost;
  }
  // Browsers send it with everything that changes something; other programs need not.
  const std::string& origin = request.header_or_empty("origin");
  if (!origin.empty() && !same_name(origin, (rules_.tls ? "https://" : "http://") + host)) {
    return Verdict::kForeignOrigin;
  }
  const std::string& site = request.header_or_empty("sec-fetch-site");
  if (changes_something(request) && !site.empty() && site != "same-origin" && site != "none") {
    return Verdict::kForeignOrigin;
  }
  return Verdict::kAllowed;
}

Access::Verdict Access::judge_login(const HttpRequest& request) const {
  return judge_place(request);
}

Access::Verdict Access::judge(const HttpRequest& request) {
  if (const Verdict place = judge_place(request); place != Verdict::kAllowed) {
    return place;
  }
  if (equal_in_constant_time(bearer_of(request), rules_.token)) {
    return Verdict::kAllowed;
  }
  if (!has_session(request)) {
    return Verdict::kUnknown;
  }
  // Whoever has the cookie is a browser, and says which page wants this.
  return changes_something(request) && request.header_or_empty("origin").empty() ? Verdict::kForeignOrigin
                                                                                 : Verdict::kAllowed;
}

std::string Access::log_in(std::string_view token) {
  if (!equal_in_constant_time(token, rules_.token)) {
    return "";
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  if (sessions_.size() == kMostSessions) {
    sessions_.erase(sessions_.begin());
  }
  sessions_.push_back({random_text(kSessionBytes), now_() + kSession});
  return sessions_.back().id;
}

void Access::log_out(const HttpRequest& request) {
  const auto cookie = request.cookies.find(cookie_name(request));
  if (cookie == request.cookies.end()) {
    return;
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  std::erase_if(sessions_, [&](const Session& session) { return equal_in_constant_time(cookie->second, session.id); });
}

bool Access::is_known(const HttpRequest& request) {
  return equal_in_constant_time(bearer_of(request), rules_.token) || has_session(request);
}

bool Access::has_session(const HttpRequest& request) {
  const auto cookie = request.cookies.find(cookie_name(request));
  if (cookie == request.cookies.end()) {
    return false;
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto now = now_();
  std::erase_if(sessions_, [&](const Session& session) { return session.end <= now; });
  bool found = false;
  for (const Session& session : sessions_) {
    found = equal_in_constant_time(cookie->second, session.id) || found;
  }
  return found;
}

std::string Access::cookie_name(const HttpRequest& request) const {
  const std::string& host = request.header_or_empty("host");
  const std::size_t colon = host.rfind(':');
  const bool has_port = colon != std::string::npos && host.find(']', colon) == std::string::npos;
  return "launch-" + (has_port ? host.substr(colon + 1) : rules_.tls ? "443" : "80");
}

std::string Access::cookie_text(const HttpRequest& request, const std::string& session) const {
  return fmt::format("{}={}; Path=/; HttpOnly; SameSite=Strict{}{}", cookie_name(request), session,
                     rules_.tls ? "; Secure" : "", session.empty() ? "; Max-Age=0" : "");
}

}  // namespace launch::serve
