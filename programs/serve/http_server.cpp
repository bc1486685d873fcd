// SPDX-License-Identifier: Apache-2.0
#include "programs/serve/http_server.hpp"

#include <arpa/inet.h>
#include <microhttpd.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <utility>
#include <vector>

#include "programs/serve/open_connections.hpp"

namespace launch::serve {

using Answer = std::function<HttpAnswer(const HttpRequest&)>;
using std::chrono::steady_clock;

struct HttpServer::Daemon {
  Answer answer;
  OpenConnections connections;
  MHD_Daemon* daemon = nullptr;
};

namespace {

constexpr unsigned kIdle = 30;  // seconds without a byte, after which libmicrohttpd closes a connection

// What is known of a request while it comes.
struct Incoming {
  HttpRequest request;
  bool too_long = false;
};

std::string small(const char* text) {
  std::string name(text);
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char byte) { return std::tolower(byte); });
  return name;
}

MHD_Result take_header(void* to, MHD_ValueKind /*kind*/, const char* name, const char* value) {
  auto& request = *static_cast<HttpRequest*>(to);
  const std::string key = small(name);
  const bool decides = key == "host" || key == "origin" || key == "authorization" || key == "content-type";
  request.ambiguous_head = request.ambiguous_head || (decides && request.header.contains(key));
  request.header[key] = value == nullptr ? "" : value;
  return MHD_YES;
}

MHD_Result take_value(void* to, MHD_ValueKind /*kind*/, const char* name, const char* value) {
  (*static_cast<std::map<std::string, std::string>*>(to))[name] = value == nullptr ? "" : value;
  return MHD_YES;
}

std::string address_of(MHD_Connection* connection) {
  const MHD_ConnectionInfo* const info = MHD_get_connection_info(connection, MHD_CONNECTION_INFO_CLIENT_ADDRESS);
  std::array<char, INET6_ADDRSTRLEN> text{};
  if (info == nullptr || info->client_addr == nullptr) {
    return "?";
  }
  const sockaddr* const address = info->client_addr;
  const void* const number = address->sa_family == AF_INET6
                                 ? static_cast<const void*>(&reinterpret_cast<const sockaddr_in6*>(address)->sin6_addr)
                                 : &reinterpret_cast<const sockaddr_in*>(address)->sin_addr;
  return ::inet_ntop(address->sa_family, number, text.data(), text.size()) == nullptr ? "?" : text.data();
}

std::unique_ptr<Incoming> begin(MHD_Connection* connection, const char* path, const char* method) {
  auto incoming = std::make_unique<Incoming>();
  HttpRequest& request = incoming->request;
  request.method = method;
  request.path = path;
  request.client = address_of(connection);
  MHD_get_connection_values(connection, MHD_HEADER_KIND, take_header, &request);
  MHD_get_connection_values(connection, MHD_GET_ARGUMENT_KIND, take_value, &request.query);
  MHD_get_connection_values(connection, MHD_COOKIE_KIND, take_value, &request.cookies);
  return incoming;
}

// The parts of an answer, and what libmicrohttpd had no room for yet.
struct Feed {
  AnswerParts parts;
  std::string rest;
};

ssize_t read_feed(void* from, std::uint64_t /*position*/, char* buffer, std::size_t room) {
  auto& feed = *static_cast<Feed*>(from);
  try {
    while (feed.rest.empty()) {
      std::optional<std::string> next = feed.parts();
      if (!next) {
        return MHD_CONTENT_READER_END_OF_STREAM;
      }
      feed.rest = *std::move(next);
    }
  } catch (const std::exception&) {
    return MHD_CONTENT_READER_END_WITH_ERROR;
  }
  const std::size_t count = std::min(room, feed.rest.size());
  std::memcpy(buffer, feed.rest.data(), count);
  feed.rest.erase(0, count);
  return static_cast<ssize_t>(count);
}

void free_feed(void* feed) {
  delete static_cast<Feed*>(feed);
}

MHD_Response* response_of(HttpAnswer& answer) {
  constexpr std::size_t kBlock = 16UL << 10U;
  if (answer.parts) {
    return MHD_create_response_from_callback(MHD_SIZE_UNKNOWN, kBlock, read_feed, new Feed{std::move(answer.parts), {}},
                                             free_feed);
  }
  return MHD_create_response_from_buffer(answer.body.size(), answer.body.data(), MHD_RESPMEM_MUST_COPY);
}

MHD_Result give(MHD_Connection* connection, HttpAnswer answer) {
  MHD_Response* const response = response_of(answer);
  if (response == nullptr) {
    return MHD_NO;
  }
  MHD_add_response_header(response, "Content-Type", answer.type.c_str());
  for (const auto& [name, value] :
       std::initializer_list<std::pair<const char*, const char*>>{{"Cache-Control", "no-store"},
                                                                  {"X-Content-Type-Options", "nosniff"},
                                                                  {"X-Frame-Options", "DENY"},
                                                                  // Not "no-referrer": a form would then say no Origin.
                                                                  {"Referrer-Policy", "same-origin"},
                                                                  {"Cross-Origin-Resource-Policy", "same-origin"},
                                                                  {"Cross-Origin-Opener-Policy", "same-origin"}}) {
    MHD_add_response_header(response, name, value);
  }
  for (const auto& [name, value] : answer.header) {
    MHD_add_response_header(response, name.c_str(), value.c_str());
  }
  const MHD_Result queued = MHD_queue_response(connection, static_cast<unsigned>(answer.status), response);
  MHD_destroy_response(response);
  return queued;
}

HttpAnswer too_long() {
  return {.status = 413, .body = "{\"version\":1,\"ok\":false,\"error\":\"the request is too long\"}\n"};
}

HttpAnswer failed(const std::exception& /*error*/) {
  return {.status = 500, .body = "{\"version\":1,\"ok\":false,\"error\":\"the service has failed\"}\n"};
}

// Called when the head of a request is there, for each piece of its body, and at its end.
MHD_Result on_request(void* with, MHD_Connection* connection, const char* path, const char* method,
                      const char* /*version*/, const char* data, std::size_t* size, void** of_request) {
  auto& daemon = *static_cast<HttpServer::Daemon*>(with);
  if (*of_request == nullptr) {
    *of_request = begin(connection, path, method).release();
    return MHD_YES;
  }
  auto& incoming = *static_cast<Incoming*>(*of_request);
  if (*size > 0) {
    incoming.too_long = incoming.too_long || incoming.request.body.size() + *size > HttpServer::kLongestBody;
    if (!incoming.too_long) {
      incoming.request.body.append(data, *size);
    }
    *size = 0;
    return MHD_YES;
  }
  daemon.connections.set(connection, OpenConnections::Doing::kAnswer, steady_clock::now());
  HttpAnswer answer;
  try {
    answer = incoming.too_long ? too_long() : daemon.answer(incoming.request);
  } catch (const std::exception& error) {
    answer = failed(error);
  }
  if (answer.parts) {
    daemon.connections.set(connection, OpenConnections::Doing::kFeed, steady_clock::now());
  }
  return give(connection, std::move(answer));
}

void on_answered(void* with, MHD_Connection* connection, void** of_request, MHD_RequestTerminationCode /*how*/) {
  delete static_cast<Incoming*>(std::exchange(*of_request, nullptr));
  static_cast<HttpServer::Daemon*>(with)->connections.set(connection, OpenConnections::Doing::kRequest,
                                                          steady_clock::now());
}

void on_connection(void* with, MHD_Connection* connection, void** /*unused*/, MHD_ConnectionNotificationCode what) {
  OpenConnections& connections = static_cast<HttpServer::Daemon*>(with)->connections;
  if (what == MHD_CONNECTION_NOTIFY_CLOSED) {
    connections.remove(connection);
  } else if (const auto* const info = MHD_get_connection_info(connection, MHD_CONNECTION_INFO_CONNECTION_FD)) {
    connections.add(connection, info->connect_fd, steady_clock::now());
  }
}

}  // namespace

HttpServer::HttpServer(UniqueFd listener, const Certificate* certificate, Answer answer)
    : daemon_(std::make_unique<Daemon>()) {
  daemon_->answer = std::move(answer);
  unsigned flags = MHD_USE_THREAD_PER_CONNECTION | MHD_USE_INTERNAL_POLLING_THREAD | MHD_USE_POLL;
  std::vector<MHD_OptionItem> options = {
      {MHD_OPTION_LISTEN_SOCKET, listener.get(), nullptr},
      {MHD_OPTION_CONNECTION_LIMIT, kMostConnections, nullptr},
      {MHD_OPTION_PER_IP_CONNECTION_LIMIT, kMostOfClient, nullptr},
      {MHD_OPTION_CONNECTION_TIMEOUT, kIdle, nullptr},
      {MHD_OPTION_CONNECTION_MEMORY_LIMIT, kLongestHead, nullptr},
      {MHD_OPTION_NOTIFY_COMPLETED, reinterpret_cast<intptr_t>(&on_answered), daemon_.get()},
      {MHD_OPTION_NOTIFY_CONNECTION, reinterpret_cast<intptr_t>(&on_connection), daemon_.get()}};
  if (certificate != nullptr) {
    flags |= MHD_USE_TLS;
    options.push_back({MHD_OPTION_HTTPS_MEM_CERT, 0, const_cast<char*>(certificate->certificate.c_str())});
    options.push_back({MHD_OPTION_HTTPS_MEM_KEY, 0, const_cast<char*>(certificate->key.c_str())});
    options.push_back(
        {MHD_OPTION_HTTPS_PRIORITIES, 0, const_cast<char*>("NORMAL:-VERS-ALL:+VERS-TLS1.3:+VERS-TLS1.2")});
  }
  options.push_back({MHD_OPTION_END, 0, nullptr});
  daemon_->daemon = MHD_start_daemon(flags, 0, nullptr, nullptr, &on_request, daemon_.get(), MHD_OPTION_ARRAY,
                                     options.data(), MHD_OPTION_END);
  if (daemon_->daemon == nullptr) {
    throw std::runtime_error(certificate == nullptr
                                 ? "the HTTP server does not start"
                                 : "the HTTPS server does not start: the certificate or its key can't "
                                   "be used, or they don't belong together");
  }
  static_cast<void>(listener.release());  // libmicrohttpd closes it
}

HttpServer::~HttpServer() {
  MHD_stop_daemon(daemon_->daemon);
}

void HttpServer::cut_late_connections() {
  daemon_->connections.cut_late(steady_clock::now());
}

}  // namespace launch::serve
