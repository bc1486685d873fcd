// SPDX-License-Identifier: Apache-2.0
// launch service list, type, find, info, call
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <iterator>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/message_types/python_text.hpp"
#include "launcher/message_types/read_value.hpp"
#include "programs/ros/endpoints.hpp"
#include "programs/ros/graph_names.hpp"
#include "programs/ros/topic_graph.hpp"

namespace launch {

namespace {

std::vector<std::string> service_names() {
  GraphSession session;
  session.discover(std::nullopt);
  std::vector<std::string> names;
  for (const auto& [name, types] : session.node().get_service_names_and_types()) {
    names.push_back(name);
  }
  return names;
}

// The types of a service. Throws CommandError if there is none of this name.
std::vector<std::string> types_of_service(GraphSession& session, const std::string& service) {
  const NamesAndTypes services = session.node().get_service_names_and_types();
  const auto found = services.find(service);
  if (found == services.end()) {
    std::vector<std::string> names;
    for (const auto& [name, types] : services) {
      names.push_back(name);
    }
    throw CommandError(fmt::format("unknown service '{}'", service), did_you_mean(service, names));
  }
  return found->second;
}

class ServiceList final : public Verb {
 public:
  void declare(CLI::App& app) override {
    look_.declare(app);
    app.add_flag("-t,--show-types", show_types_, "also print the types");
    app.add_flag("-c,--count-services", count_, "print only how many there are");
    app.add_flag("--include-hidden-services", hidden_, "also services whose name begins with '_'");
  }

  int run() override {
    GraphSession session;
    session.discover(look_.time());
    NamesAndTypes services = session.node().get_service_names_and_types();
    std::erase_if(services, [this](const auto& service) { return !hidden_ && is_hidden(service.first); });
    put_names(services, show_types_, count_);
    return 0;
  }

 private:
  LookOptions look_;
  bool show_types_ = false;
  bool count_ = false;
  bool hidden_ = false;
};

// What is known of one service: `type` prints only its type.
class ServiceInfo final : public Verb {
 public:
  explicit ServiceInfo(bool only_type) : only_type_(only_type) {}

  void declare(CLI::App& app) override {
    app.add_option("service", service_, "name of the service")->required();
    look_.declare(app);
  }

  int run() override {
    const std::string service = full_name(service_);
    GraphSession session;
    session.discover(look_.time());
    const std::vector<std::string> types = types_of_service(session, service);
    if (only_type_) {
      put(fmt::format("{}\n", fmt::join(types, "\n")));
      return 0;
    }
    put(fmt::format("Type: {}\nClients count: {}\nServices count: {}\n", fmt::join(types, ", "),
                    session.node().count_clients(service), session.node().count_services(service)));
    return 0;
  }

  std::vector<std::string> complete(const std::vector<std::string>& words) override {
    return words.empty() ? service_names() : std::vector<std::string>();
  }

 private:
  bool only_type_;
  std::string service_;
  LookOptions look_;
};

class ServiceFind final : public Verb {
 public:
  void declare(CLI::App& app) override {
    app.add_option("type", type_, "type of the services, such as std_srvs/srv/Empty")->required();
    look_.declare(app);
    app.add_flag("-c,--count-services", count_, "print only how many there are");
    app.add_flag("--include-hidden-services", hidden_, "also services whose name begins with '_'");
  }

  int run() override {
    if (std::count(type_.begin(), type_.end(), '/') == 1) {
      type_.insert(type_.find('/'), "/srv");
    }
    GraphSession session;
    session.discover(look_.time());
    std::vector<std::string> found;
    for (const auto& [name, types] : session.node().get_service_names_and_types()) {
      if ((hidden_ || !is_hidden(name)) && std::find(types.begin(), types.end(), type_) != types.end()) {
        found.push_back(name);
      }
    }
    put(count_ ? fmt::format("{}\n", found.size()) : found.empty() ? "" : fmt::format("{}\n", fmt::join(found, "\n")));
    return 0;
  }

  std::vector<std::string> complete(const std::vector<std::string>& words) override {
    return words.empty() ? installed_interfaces().names("srv") : std::vector<std::string>();
  }

 private:
  std::string type_;
  LookOptions look_;
  bool count_ = false;
  bool hidden_ = false;
};

class ServiceCall final : public Verb {
 public:
  void declare(CLI::App& app) override {
    app.add_option("service", service_, "name of the service")->required();
    app.add_option("type", type_, "type of the service, such as std_srvs/srv/Empty")->required();
    CLI::Option* const values = app.add_option("values", values_, "the request as YAML; default: {}");
    app.add_flag("--stdin", stdin_, "read the request from standard input")->excludes(values);
    app.add_option("-r,--rate", rate_, "call again and again, so many times in a second")->check(CLI::PositiveNumber);
    app.add_option("--timeout", timeout_, "fail if it takes so many seconds; default: wait without end")
        ->check(CLI::PositiveNumber);
  }

  int run() override {
    const std::string service = full_name(service_);
    const ServiceType type = installed_interfaces().service(type_);
    if (stdin_) {
      values_.assign(std::istreambuf_iterator<char>(std::cin), {});
    }
    MessageText request =
        read_message(*type.request, word_of_command_line(stdin_ ? "standard input" : "values", values_));
    GraphSession session;
    DescribedClient client(session, service, type);
    const auto time = timeout_ ? std::optional<Seconds>(*timeout_) : std::nullopt;
    const auto ready = [&] { return client.service_is_ready(); };
    if (!session.wait_until(ready, Seconds(0.3))) {
      put("waiting for service to become available...\n");
      if (!session.wait_until(ready, time)) {
        return failed(fmt::format("there is no service '{}'", service));
      }
    }
    auto next = SessionClock::now();
    do {
      request.stamp(session.node().now().nanoseconds());
      put(fmt::format("requester: making request: {}\n\n", to_python(*type.request, request.value)));
      const auto response = client.call(request.value, time);
      if (!response) {
        return failed(fmt::format("service '{}' has not answered", service));
      }
      put(fmt::format("response:\n{}\n\n", to_python(*type.response, *response)));
      next += std::chrono::duration_cast<SessionClock::duration>(Seconds(rate_ ? 1.0 / *rate_ : 0.0));
      while (rate_ && !GraphSession::is_stopped() && SessionClock::now() < next) {
        session.wait({}, next);
      }
    } while (rate_ && !GraphSession::is_stopped());
    return 0;
  }

  std::vector<std::string> complete(const std::vector<std::string>& words) override {
    if (words.size() == 1) {
      GraphSession session;
      session.discover(std::nullopt);
      return types_of_service(session, full_name(words.front()));
    }
    return words.empty() ? service_names() : std::vector<std::string>();
  }

 private:
  // Nobody wants to hear of it who has asked to stop.
  static int failed(const std::string& message) {
    if (GraphSession::is_stopped()) {
      return 1;
    }
    throw CommandError(message);
  }

  std::string service_, type_, values_ = "{}";
  bool stdin_ = false;
  std::optional<double> rate_;
  std::optional<double> timeout_;
};

}  // namespace

std::unique_ptr<Verb> make_service_list() {
  return std::make_unique<ServiceList>();
}
std::unique_ptr<Verb> make_service_type() {
  return std::make_unique<ServiceInfo>(true);
}
std::unique_ptr<Verb> make_service_info() {
  return std::make_unique<ServiceInfo>(false);
}
std::unique_ptr<Verb> make_service_find() {
  return std::make_unique<ServiceFind>();
}
std::unique_ptr<Verb> make_service_call() {
  return std::make_unique<ServiceCall>();
}

}  // namespace launch
