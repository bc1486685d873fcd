// SPDX-License-Identifier: Apache-2.0
#include "programs/serve/service.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "launcher/control/control_client.hpp"
#include "launcher/control/control_protocol.hpp"
#include "launcher/control/process_usage.hpp"
#include "programs/serve/launch_feed.hpp"
#include "programs/serve/launch_list.hpp"
#include "programs/serve/page/page.hpp"

namespace launch::serve {
namespace {

using Json = ControlClient::Json;

constexpr std::string_view kLaunches = "/api/launches";
constexpr std::string_view kNodes = "/api/nodes";
constexpr std::string_view kMetrics = "/metrics";

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// As the control protocol says an error.
HttpAnswer error(int status, const std::string& what, const std::string& help = {}) {
  HttpAnswer answer{.status = status};
  answer.body = error_line(what, help) + "\n";
  return answer;
}

HttpAnswer wrong_method(const char* allowed) {
  HttpAnswer answer = error(405, fmt::format("this address takes {} only", allowed));
  answer.header.emplace_back("Allow", allowed);
  return answer;
}

HttpAnswer page_answer(int status, std::string_view page, const std::string& nonce) {
  HttpAnswer answer{.status = status, .type = "text/html; charset=utf-8"};
  answer.body = with_nonce(page, nonce);
  answer.header.emplace_back(
      "Content-Security-Policy",
      fmt::format("default-src 'none'; script-src 'nonce-{0}'; style-src 'nonce-{0}'; connect-src 'self'; "
                  "img-src data:; form-action 'self'; base-uri 'none'; frame-ancestors 'none'",
                  nonce));
  return answer;
}

std::string printable(std::string text) {
  for (char& byte : text) {
    if (static_cast<unsigned char>(byte) < ' ' || byte == '\x7F') {
      byte = '?';
    }
  }
  return text;
}

// 0 if it is none.
pid_t number_of(const std::string& text) {
  pid_t number = 0;
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), number);
  return failed == std::errc() && end == text.data() + text.size() && number > 0 ? number : 0;
}

HttpAnswer too_many_feeds() {
  return error(503, fmt::format("{} pages follow launches already", Service::kMostFeeds));
}

HttpAnswer not_running(const std::string& number) {
  return error(404, fmt::format("launch {} does not run", printable(number)));
}

// Whether it has the shape of a request, whose values are no deeper than a list of texts. Something deep must not be
// written again, for which the stack would not do.
bool is_request(const Json& wanted) {
  if (!wanted.is_object() || !wanted.contains("do") || !wanted["do"].is_string() ||
      (wanted.contains("version") && !wanted["version"].is_number_integer()) ||
      (wanted.contains("signal") && !wanted["signal"].is_string())) {
    return false;
  }
  const auto is_text = [](const Json& value) { return value.is_string(); };
  for (const auto& [key, value] : wanted.items()) {
    const bool is_list = key == "processes" || key == "groups";
    if (is_list ? !value.is_array() || !std::all_of(value.begin(), value.end(), is_text) : value.is_structured()) {
      return false;
    }
  }
  return true;
}

int value_of_digit(char digit) {
  return digit >= '0' && digit <= '9'   ? digit - '0'
         : digit >= 'a' && digit <= 'f' ? digit - 'a' + 10
         : digit >= 'A' && digit <= 'F' ? digit - 'A' + 10
                                        : -1;
}

}  // namespace

std::string form_field(std::string_view form, std::string_view name) {
  while (!form.empty()) {
    const std::size_t end = std::min(form.find('&'), form.size());
    std::string_view field = form.substr(0, end);
    form.remove_prefix(std::min(end + 1, form.size()));
    if (!field.starts_with(name) || !field.substr(name.size()).starts_with('=')) {
      continue;
    }
    field.remove_prefix(name.size() + 1);
    std::string value;
    for (std::size_t i = 0; i < field.size(); ++i) {
      const int high = field[i] == '%' && i + 2 < field.size() ? value_of_digit(field[i + 1]) : -1;
      const int low = high >= 0 ? value_of_digit(field[i + 2]) : -1;
      if (low >= 0) {
        value += static_cast<char>(high * 16 + low);
        i += 2;
      } else {
        value += field[i] == '+' ? ' ' : field[i];
      }
    }
    return value;
  }
  return "";
}

Service::Service(Access& access, Environment environment, int stop, std::function<void(const std::string&)> log,
                 bool shows_nodes)
    : access_(access),
      environment_(std::move(environment)),
      stop_(stop),
      log_(std::move(log)),
      shows_nodes_(shows_nodes) {}

HttpAnswer Service::answer(const HttpRequest& request) {
  const bool is_login = request.path == "/login" && request.method == "POST";
  const Access::Verdict verdict = is_login ? access_.judge_login(request) : access_.judge(request);
  switch (verdict) {
    case Access::Verdict::kAmbiguous:
      return error(400, "a header that decides something is there twice");
    case Access::Verdict::kForeignHost:
      return error(421, "this service is not asked for by this name",
                   "ask by address, or start the service with --host NAME");
    case Access::Verdict::kForeignOrigin:
      return error(403, "this request comes from a page of another site");
    case Access::Verdict::kUnknown:
      if (request.path == "/" && request.method == "GET") {
        return page(false);
      }
      if (request.path == kMetrics && request.method == "GET" && access_.opens_metrics()) {
        return metrics(request);
      }
      if (!request.header_or_empty("authorization").empty()) {
        log_(fmt::format("wrong token from {}", request.client));
      }
      {
        HttpAnswer refused = error(401, "the token is missing or wrong", "send 'Authorization: Bearer TOKEN'");
        refused.header.emplace_back("WWW-Authenticate", "Bearer");
        return refused;
      }
    case Access::Verdict::kAllowed:
      break;
  }
  if (is_login) {
    return log_in(request);
  }
  if (request.path == "/") {
    return request.method == "GET" ? page(true) : wrong_method("GET");
  }
  if (request.path == "/logout") {
    return request.method == "POST" ? log_out(request) : wrong_method("POST");
  }
  if (request.path == kLaunches) {
    return request.method == "GET" ? launches() : wrong_method("GET");
  }
  if (request.path == kMetrics) {
    return request.method == "GET" ? metrics(request) : wrong_method("GET");
  }
  if (request.path == kNodes) {
    return request.method == "GET" ? nodes(request) : wrong_method("GET");
  }
  if (request.path.starts_with(kLaunches) && request.path[kLaunches.size()] == '/') {
    return of_launch(request, request.path.substr(kLaunches.size() + 1));
  }
  return error(404, "there is nothing at this address");
}

HttpAnswer Service::page(bool is_known) {
  return is_known ? page_answer(200, kPage, random_text(16)) : page_answer(401, kLoginPage, random_text(16));
}

HttpAnswer Service::log_in(const HttpRequest& request) {
  const std::string session = access_.log_in(form_field(request.body, "token"));
  if (session.empty()) {
    log_(fmt::format("wrong token from {}", request.client));
    return page_answer(401, kWrongTokenPage, random_text(16));
  }
  HttpAnswer answer{.status = 303, .type = "text/plain"};
  answer.header.emplace_back("Location", "/");
  answer.header.emplace_back("Set-Cookie", access_.cookie_text(request, session));
  return answer;
}

HttpAnswer Service::log_out(const HttpRequest& request) {
  access_.log_out(request);
  HttpAnswer answer{.status = 303, .type = "text/plain"};
  answer.header.emplace_back("Location", "/");
  answer.header.emplace_back("Set-Cookie", access_.cookie_text(request, ""));
  return answer;
}

HttpAnswer Service::launches() {
  HttpAnswer answer;
  answer.body = text_of({{"version", kControlVersion},
                         {"ok", true},
                         {"launch_version", LAUNCH_VERSION},
                         {"control", access_.allows_control()},
                         {"nodes", shows_nodes_},
                         {"launches", launch_list(environment_)}}) +
                "\n";
  return answer;
}

// "123" or "123/events".
HttpAnswer Service::of_launch(const HttpRequest& request, const std::string& rest) {
  const std::size_t slash = std::min(rest.find('/'), rest.size());
  const std::string number = rest.substr(0, slash);
  try {
    if (rest.substr(slash) == "/events") {
      return request.method == "GET" ? feed(request, number) : wrong_method("GET");
    }
    if (slash == rest.size()) {
      return request.method == "GET" || request.method == "POST" ? control(request, number) : wrong_method("GET, POST");
    }
  } catch (const ControlError& failed) {
    return error(504, failed.what(), failed.help());
  }
  return error(404, "there is nothing at this address");
}

// A request of the control protocol. GET is for "ps".
HttpAnswer Service::control(const HttpRequest& request, const std::string& number) {
  const bool asks = request.method == "GET";
  const std::string& type = request.header_or_empty("content-type");
  if (!asks && type.substr(0, type.find(';')) != "application/json") {
    return error(415, "a request is JSON", "send 'Content-Type: application/json'");
  }
  const Json wanted = asks ? Json{{"do", "ps"}} : Json::parse(request.body, nullptr, false);
  if (!is_request(wanted)) {
    return error(400, "a request is a JSON object with the text 'do', and others as docs/control.md says");
  }
  const std::string what = wanted["do"].get<std::string>();
  if (what == "events" || what == "output") {
    return error(400, fmt::format("'{}' has an address of its own", what),
                 fmt::format("GET {}/{}/events", kLaunches, printable(number)));
  }
  if (what == "attach" || what == "input" || what == "resize") {
    return error(400, fmt::format("'{}' is for a terminal", what), "use launch attach");
  }
  const bool changes = what != "info" && what != "ps";
  if (changes && !access_.allows_control()) {
    return error(403, "this service only shows launches", "it steers them if it is started with --allow-control");
  }
  std::optional<ControlClient> launch = find_launch(environment_, number_of(number));
  if (!launch) {
    return not_running(number);
  }
  if (changes) {
    const std::string names = wanted.contains("processes") ? " " + text_of(wanted["processes"]) : "";
    log_(printable(fmt::format("{}{} of launch {}, for {}", what, names, number, request.client)));
  }
  Json sent = wanted;
  sent.emplace("version", kControlVersion);
  HttpAnswer answer;
  const std::string line = launch->ask_for_line(sent);
  Json told = Json::parse(line, nullptr, false);
  if (!told.is_object()) {
    return error(504, fmt::format("launch {} speaks another language", number));
  }
  answer.status = told.value("ok", false) ? 200 : 409;
  if (answer.status == 200 && what == "ps") {
    add_usage(told["processes"]);
  }
  answer.body = text_of(told) + "\n";
  return answer;
}

std::shared_ptr<void> Service::count_feed() {
  if (feeds_->fetch_add(1) >= kMostFeeds) {
    feeds_->fetch_sub(1);
    return nullptr;
  }
  return {feeds_.get(), [feeds = feeds_](void*) { feeds->fetch_sub(1); }};
}

HttpAnswer Service::nodes(const HttpRequest& request) {
  if (!shows_nodes_) {
    return error(403, "this service does not record nodes", "it shows what they do if it is started with --nodes");
  }
  const std::shared_ptr<void> counted = count_feed();
  if (!counted) {
    return too_many_feeds();
  }
  const auto feed = std::make_shared<NodeFeed>(recordings_.join(), stop_);
  HttpAnswer answer{.type = "text/event-stream"};
  answer.parts = [feed, counted, request, this]() -> std::optional<std::string> {
    return access_.is_known(request) ? feed->next() : std::nullopt;
  };
  return answer;
}

HttpAnswer Service::metrics(const HttpRequest& request) {
  std::string families = launch_metrics(ask_all_launches(environment_));
  if (shows_nodes_) {
    families += node_metrics_.families();
  }
  const MetricsFormat format = metrics_format_for(request.header_or_empty("accept"));
  HttpAnswer answer{.type = metrics_content_type(format)};
  answer.body = metrics_text(families, format);
  return answer;
}

HttpAnswer Service::feed(const HttpRequest& request, const std::string& number) {
  std::optional<ControlClient> launch = find_launch(environment_, number_of(number));
  if (!launch) {
    return not_running(number);
  }
  const std::shared_ptr<void> counted = count_feed();
  if (!counted) {
    return too_many_feeds();
  }
  const auto process = request.query.find("output");
  const auto feed =
      std::make_shared<LaunchFeed>(*std::move(launch), process == request.query.end() ? "" : process->second, stop_);
  HttpAnswer answer{.type = "text/event-stream"};
  answer.parts = [feed, counted, request, this]() -> std::optional<std::string> {
    return access_.is_known(request) ? feed->next() : std::nullopt;
  };
  return answer;
}

}  // namespace launch::serve
