// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/lsp/server.hpp"

#include <errno.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#include "launcher/python/interpreter/python_guest.hpp"
#include "programs/launch/lsp/features.hpp"
#include "programs/launch/lsp/python_features.hpp"

namespace launch::lsp {

namespace {

// Error codes of JSON-RPC and of the protocol.
constexpr int kParseError = -32700;
constexpr int kInvalidRequest = -32600;
constexpr int kMethodNotFound = -32601;
constexpr int kInvalidParams = -32602;
constexpr int kInternalError = -32603;
constexpr int kServerNotInitialized = -32002;

constexpr int kIncremental = 2;  // TextDocumentSyncKind

// A check that takes longer while nothing else happens is given up, and the other documents have their turn.
constexpr std::chrono::milliseconds kLongestCheck{60'000};

struct UnknownMethod {};

std::string document_path(const Json& parameters) {
  return path_of(parameters.at("textDocument").at("uri").get_ref<const std::string&>());
}

}  // namespace

bool write_all(int fd, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(fd, text.data(), text.size());
    if (count < 0 && errno != EINTR) {
      return false;
    }
    text.remove_prefix(count > 0 ? static_cast<std::size_t>(count) : 0);
  }
  return true;
}

Server::Server(ServerOptions options, int in, int out) : options_(std::move(options)), in_(in), out_(out) {
  ::signal(SIGPIPE, SIG_IGN);
}

Server::~Server() {
  end_check();
}

int Server::run() {
  std::array<char, 64UL << 10U> bytes{};
  while (!ended_) {
    if (!check_) {
      begin_check();
    }
    std::array<pollfd, 2> events = {{{in_, POLLIN, 0}, {check_ ? check_->result.get() : -1, POLLIN, 0}}};
    const int longest = check_ ? static_cast<int>(kLongestCheck.count()) : -1;
    const int ready = ::poll(events.data(), events.size(), longest);
    if (ready < 0 && errno != EINTR) {
      return EXIT_FAILURE;
    }
    if (ready == 0) {
      // It waits for something: a file that is a pipe.
      std::deque<std::string> rest = std::move(check_->paths);
      end_check();
      if (!rest.empty()) {
        rest.pop_front();
        to_check_.insert(to_check_.begin(), rest.begin(), rest.end());
      }
    }
    if ((events[0].revents & (POLLIN | POLLHUP | POLLERR)) != 0) {
      const ssize_t count = ::read(in_, bytes.data(), bytes.size());
      if (count == 0 || (count < 0 && errno != EINTR && errno != EAGAIN)) {
        break;
      }
      reader_.add({bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0))});
      while (!ended_) {
        const std::optional<Json> message = reader_.next();
        if (!message) {
          break;
        }
        take(*message);
      }
    }
    if (check_ && (events[1].revents & (POLLIN | POLLHUP | POLLERR)) != 0) {
      read_check();
    }
  }
  return shut_down_ ? EXIT_SUCCESS : EXIT_FAILURE;
}

void Server::take(const Json& message) {
  if (message.is_null()) {
    answer_with_error(nullptr, kParseError, "this is not JSON");
    return;
  }
  const auto method = message.is_object() ? message.find("method") : message.end();
  const bool is_request = message.is_object() && message.contains("id");
  if (!message.is_object() || method == message.end() || !method->is_string()) {
    if (!message.is_object() || !message.contains("result")) {
      answer_with_error(is_request ? message.at("id") : Json(), kInvalidRequest, "this is no request");
    }
    return;
  }
  const Json parameters = message.value("params", Json::object());
  const auto& name = method->get_ref<const std::string&>();
  if (!is_request) {
    try {
      notice(name, parameters);
    } catch (const std::exception&) {
      // Notices have no answer.
    }
    return;
  }
  const Json& id = message.at("id");
  try {
    if (!initialized_ && name != "initialize") {
      answer_with_error(id, kServerNotInitialized, "the first request must be 'initialize'");
    } else if (shut_down_) {
      answer_with_error(id, kInvalidRequest, "the server is shut down");
    } else {
      answer_with(id, answer(name, parameters));
    }
  } catch (const UnknownMethod&) {
    answer_with_error(id, kMethodNotFound, fmt::format("'{}' is not known here", name));
  } catch (const Json::exception& error) {
    answer_with_error(id, kInvalidParams, error.what());
  } catch (const std::invalid_argument& error) {
    answer_with_error(id, kInvalidParams, error.what());
  } catch (const std::exception& error) {
    answer_with_error(id, kInternalError, error.what());
  }
}

Json Server::initialize(const Json& parameters) {
  const Json options = parameters.value("initializationOptions", Json());
  if (options.is_object()) {
    options_.runs_python = options.value("runPython", options_.runs_python);
    options_.checks_folder = options.value("checkFolder", options_.checks_folder);
    options_.trace = options.value("fromTrace", options_.trace);
  }
  if (const Json root = parameters.value("rootUri", Json()); root.is_string()) {
    folder_ = path_of(root.get_ref<const std::string&>());
  }
  const Json lenses = parameters.value(Json::json_pointer("/capabilities/workspace/codeLens/refreshSupport"), Json());
  refreshes_lenses_ = lenses.is_boolean() && lenses.get<bool>();
  workspace_.emplace(options_.runs_python);
  if (!options_.trace.empty()) {
    workspace_->use_recorded(read_recorded_nodes(options_.trace).value_or(std::vector<RecordedNode>()));
  }
  initialized_ = true;
  return {{"capabilities",
           {{"textDocumentSync", {{"openClose", true}, {"change", kIncremental}, {"save", true}}},
            {"completionProvider", {{"triggerCharacters", {"<", "\"", "'", "$", "(", " ", "/", "."}}}},
            {"hoverProvider", true},
            {"definitionProvider", true},
            {"referencesProvider", true},
            {"renameProvider", {{"prepareProvider", true}}},
            {"documentSymbolProvider", true},
            {"foldingRangeProvider", true},
            {"inlayHintProvider", true},
            {"codeLensProvider", Json::object()},
            {"semanticTokensProvider", {{"legend", semantic_token_legend()}, {"full", true}}},
            {"codeActionProvider", {{"codeActionKinds", {"quickfix"}}}}}},
          {"serverInfo", {{"name", "launch lsp"}, {"version", LAUNCH_VERSION}}}};
}

Json Server::answer(const std::string& method, const Json& parameters) {
  if (method == "initialize") {
    return initialize(parameters);
  }
  if (method == "shutdown") {
    shut_down_ = true;
    return nullptr;
  }
  if (!method.starts_with("textDocument/")) {
    throw UnknownMethod();
  }
  const std::string path = document_path(parameters);
  const Document* const document = workspace_->find(path);
  if (document == nullptr) {
    throw std::invalid_argument(fmt::format("'{}' is not open", path));
  }
  const Reading reading = reading_of(path, *document);
  const auto position = [&] { return parameters.at("position"); };
  if (method == "textDocument/completion") {
    return (is_python(path) ? complete_python : complete)(*workspace_, reading, position());
  }
  if (method == "textDocument/hover") {
    return (is_python(path) ? describe_python : describe)(*workspace_, reading, position());
  }
  if (method == "textDocument/definition") {
    return definition(*workspace_, reading, position());
  }
  if (method == "textDocument/references") {
    return references(*workspace_, reading, position(), folder_);
  }
  if (method == "textDocument/prepareRename") {
    return prepare_rename(*workspace_, reading, position());
  }
  if (method == "textDocument/rename") {
    return rename(*workspace_, reading, position(), parameters.at("newName").get<std::string>(), folder_);
  }
  if (method == "textDocument/documentSymbol") {
    return is_python(path) ? python_symbols(*workspace_, reading) : symbols(reading);
  }
  if (method == "textDocument/foldingRange") {
    return is_python(path) ? python_folds(reading) : folds(reading);
  }
  if (method == "textDocument/inlayHint") {
    return inlay_hints(*workspace_, reading, parameters.at("range"));
  }
  if (method == "textDocument/codeLens") {
    const auto known = processes_.find(path);
    return code_lenses(reading, known == processes_.end() ? std::nullopt : std::optional(known->second));
  }
  if (method == "textDocument/semanticTokens/full") {
    return semantic_tokens(reading);
  }
  if (method == "textDocument/codeAction") {
    return code_actions(reading, parameters.at("context").at("diagnostics"));
  }
  throw UnknownMethod();
}

void Server::notice(const std::string& method, const Json& parameters) {
  if (method == "exit") {
    ended_ = true;
    return;
  }
  if (workspace_ && method == "initialized" && options_.checks_folder) {
    check_folder();
  }
  if (workspace_ && method == "workspace/didChangeWatchedFiles" && options_.checks_folder) {
    check_folder();
  }
  if (!workspace_ || !method.starts_with("textDocument/")) {
    return;
  }
  const std::string path = document_path(parameters);
  // A check of an older text has been given up when a result comes.
  if (const Json version = parameters.at("textDocument").value("version", Json()); version.is_number_integer()) {
    versions_[path] = version.get<std::int64_t>();
  }
  if (method == "textDocument/didOpen") {
    workspace_->open(path, parameters.at("textDocument").at("text").get<std::string>());
  } else if (method == "textDocument/didChange") {
    Document* const document = workspace_->find(path);
    if (document == nullptr) {
      return;
    }
    for (const Json& change : parameters.at("contentChanges")) {
      document->change(change);
    }
    run_next_.erase(path);  // nothing runs while somebody is typing
  } else if (method == "textDocument/didClose") {
    workspace_->close(path);
    versions_.erase(path);
    std::erase(to_check_, path);
    if (folder_files_.contains(path)) {
      check_later(path);  // it counts as it is on the disk now
    } else {
      publish(path, Json::array());
    }
    return;
  } else if (method != "textDocument/didSave") {
    return;
  }
  if (method == "textDocument/didOpen" || method == "textDocument/didSave") {
    run_next_.insert(path);
  }
  check_later(path);
  for (const auto& [other, text] : workspace_->texts()) {
    if (other != path && !is_python(other)) {
      check_later(other);  // it may include this one
    }
  }
  if (method == "textDocument/didSave") {
    check_those_that_name(path);
  }
}

void Server::publish(const std::string& path, Json diagnostics) {
  Json parameters = {{"uri", uri_of(path)}, {"diagnostics", std::move(diagnostics)}};
  if (const auto version = versions_.find(path); version != versions_.end()) {
    parameters["version"] = version->second;
  }
  send({{"jsonrpc", "2.0"}, {"method", "textDocument/publishDiagnostics"}, {"params", std::move(parameters)}});
}

void Server::send(const Json& message) {
  if (!write_all(out_, framed(message))) {
    ended_ = true;
  }
}

void Server::answer_with(const Json& id, Json result) {
  send({{"jsonrpc", "2.0"}, {"id", id}, {"result", std::move(result)}});
}

void Server::answer_with_error(const Json& id, int code, const std::string& message) {
  send({{"jsonrpc", "2.0"}, {"id", id}, {"error", {{"code", code}, {"message", message}}}});
}

}  // namespace launch::lsp
