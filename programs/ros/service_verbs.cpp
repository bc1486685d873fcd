// SPDX-License-Identifier: Apache-2.0
// launch service info, call
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/message_types/print_value.hpp"
#include "launcher/message_types/read_value.hpp"
#include "programs/ros/endpoints.hpp"
#include "programs/ros/graph_names.hpp"
#include "programs/ros/topic_graph.hpp"

namespace launch {

namespace {

class ServiceInfo final : public Verb {
 public:
  void declare(CLI::App& app) override {
    app.add_option("service", service_, "name of the service")->required();
    look_.declare(app);
  }

  int run() override {
    const std::string service = full_name(service_);
    GraphSession session;
    session.discover(look_.time());
    const std::vector<std::string> types = types_of(session, kServices, service);
    put(fmt::format("Type: {}\nClients count: {}\nServices count: {}\n", fmt::join(types, ", "),
                    session.node().count_clients(service), session.node().count_services(service)));
    return 0;
  }

  std::vector<std::string> complete(const std::vector<std::string>& words) override {
    return words.empty() ? all_names(kServices) : std::vector<std::string>();
  }

 private:
  std::string service_;
  LookOptions look_;
};

class ServiceCall final : public Verb {
 public:
  void declare(CLI::App& app) override {
    app.add_option("service", service_, "name of the service")->required();
    app.add_option("type", type_, "type of the service, such as std_srvs/srv/Empty")->required();
    values_.declare(app, "values", "request");
    app.add_option("-r,--rate", rate_, "call again and again, so many times in a second")->check(CLI::PositiveNumber);
    app.add_option("--timeout", timeout_, "fail if it takes so many seconds; default: wait without end")
        ->check(CLI::PositiveNumber);
  }

  int run() override {
    const std::string service = full_name(service_);
    const ServiceType type = installed_interfaces().service(type_);
    MessageText request = read_message(*type.request, values_.read("values"));
    GraphSession session;
    DescribedClient client(session, service, type);
    const auto time = timeout_ ? std::optional<Seconds>(*timeout_) : std::nullopt;
    const auto ready = [&] { return client.service_is_ready(); };
    if (!session.wait_until(ready, Seconds(0.3))) {
      put("waiting for service to become available...\n");
      if (!session.wait_until(ready, time)) {
        return stopped_or(fmt::format("there is no service '{}'", service));
      }
    }
    auto next = SessionClock::now();
    do {
      request.stamp(session.node().now().nanoseconds());
      put(fmt::format("requester: making request: {}\n\n", to_python(*type.request, request.value)));
      const auto response = client.call(request.value, time);
      if (!response) {
        return stopped_or(fmt::format("service '{}' has not answered", service));
      }
      put(fmt::format("response:\n{}\n\n", to_python(*type.response, *response)));
      next += std::chrono::duration_cast<SessionClock::duration>(Seconds(rate_ ? 1.0 / *rate_ : 0.0));
      session.sleep_until(next);
    } while (rate_ && !GraphSession::is_stopped());
    return 0;
  }

  std::vector<std::string> complete(const std::vector<std::string>& words) override {
    if (words.size() == 1) {
      GraphSession session;
      session.discover(std::nullopt);
      return types_of(session, kServices, full_name(words.front()));
    }
    return words.empty() ? all_names(kServices) : std::vector<std::string>();
  }

 private:
  std::string service_, type_;
  ValuesOption values_;
  std::optional<double> rate_;
  std::optional<double> timeout_;
};

}  // namespace

std::vector<VerbInfo> service_verbs() {
  return {{"service", "call", "calls a service", make_verb<ServiceCall>},
          {"service", "info", "describes a service", make_verb<ServiceInfo>}};
}

}  // namespace launch
