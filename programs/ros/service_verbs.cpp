// SPDX-License-Identifier: Apache-2.0
// launch service info, call
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/message_types/print_value.hpp"
#include "launcher/message_types/read_value.hpp"
#include "programs/rclcpp_versions/rclcpp_versions.hpp"
#include "programs/ros/calculations/type_hash.hpp"
#include "programs/ros/endpoint_text.hpp"
#include "programs/ros/endpoints.hpp"
#include "programs/ros/graph_names.hpp"
#include "programs/ros/topic_graph.hpp"

namespace launch {

namespace {

// An end of a service: a topic for the requests and one for the responses, of which it publishes one.
struct ServiceEnd {
  rclcpp::TopicEndpointInfo published;
  rclcpp::TopicEndpointInfo taken;
};

std::vector<ServiceEnd> service_ends(GraphSession& session, const std::string& service, bool clients) {
  const std::string requests = fmt::format("rq{}Request", service);
  const std::string responses = fmt::format("rr{}Reply", service);
  constexpr bool kNamesOfDds = true;
  std::vector<rclcpp::TopicEndpointInfo> taken =
      session.node().get_subscriptions_info_by_topic(clients ? responses : requests, kNamesOfDds);
  std::vector<ServiceEnd> ends;
  for (const auto& published :
       session.node().get_publishers_info_by_topic(clients ? requests : responses, kNamesOfDds)) {
    const auto of_same_node = std::find_if(taken.begin(), taken.end(), [&published](const auto& other) {
      return other.node_name() == published.node_name() && other.node_namespace() == published.node_namespace();
    });
    if (of_same_node != taken.end()) {
      ends.push_back({published, *of_same_node});
      taken.erase(of_same_node);
    }
  }
  return ends;
}

// The hash of the type that both know, "INVALID" if it is not installed here, or the end has another definition of it.
std::string hash_of_type(const ServiceEnd& end, const std::string& name, bool is_client) {
  try {
    const ServiceType type = installed_interfaces().service(name);
    const std::string announced = rclcpp_versions::type_hash_text(is_client ? end.published : end.taken);
    if (announced == type_hash(*type.request)) {
      return service_type_hash(type, *installed_interfaces().message(name + "_Event"));
    }
  } catch (const LaunchError&) {
    // said by the word for it
  }
  return "INVALID";
}

std::string service_end_text(const ServiceEnd& end, const std::string& type, bool is_client) {
  std::string text = fmt::format(
      "Node name: {}\nNode namespace: {}\nService type: {}\nService type hash: {}\nEndpoint type: {}\n"
      "Endpoint count: 2\nGIDs:\n",
      end.published.node_name(), end.published.node_namespace(), type, hash_of_type(end, type, is_client),
      is_client ? "CLIENT" : "SERVER");
  const std::pair<const char*, const rclcpp::TopicEndpointInfo&> endpoints[] = {
      {is_client ? "Request Writer" : "Request Reader", is_client ? end.published : end.taken},
      {is_client ? "Response Reader" : "Response Writer", is_client ? end.taken : end.published}};
  for (const auto& [what, endpoint] : endpoints) {
    text += fmt::format("- {} : {}\n", what, gid_text(endpoint));
  }
  text += "QoS profiles:";
  for (const auto& [what, endpoint] : endpoints) {
    text += fmt::format("\n- {} :\n{}", what, qos_text(endpoint, "      "));
  }
  return text;
}

class ServiceInfo final : public Verb {
 public:
  void declare(CLI::App& app) override {
    app.add_option("service", service_, "name of the service")->required();
    look_.declare(app);
    app.add_flag("-v,--verbose", verbose_,
                 "also print node, hash of the type, GIDs and quality of service of each client and server");
  }

  int run() override {
    const std::string service = full_name(service_);
    GraphSession session;
    session.discover(look_.time());
    const std::string type = fmt::format("{}", fmt::join(types_of(session, kServices, service), ", "));
    const char* const line_end = verbose_ ? "\n\n" : "\n";
    put(fmt::format("Type: {}\nClients count: {}{}", type, rclcpp_versions::count_clients(session.node(), service),
                    line_end));
    put_ends(session, service, type, true);
    put(fmt::format("Services count: {}{}", rclcpp_versions::count_services(session.node(), service), line_end));
    put_ends(session, service, type, false);
    return 0;
  }

  std::vector<std::string> complete(const std::vector<std::string>& words) override {
    return words.empty() ? all_names(kServices) : std::vector<std::string>();
  }

 private:
  void put_ends(GraphSession& session, const std::string& service, const std::string& type, bool clients) const {
    if (verbose_) {
      for (const ServiceEnd& end : service_ends(session, service, clients)) {
        put(service_end_text(end, type, clients) + "\n\n");
      }
    }
  }

  std::string service_;
  LookOptions look_;
  bool verbose_ = false;
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
    qos_.declare(app, "call", "services_default");
  }

  int run() override {
    const std::string service = full_name(service_);
    const ServiceType type = installed_interfaces().service(type_);
    MessageText request = read_message(*type.request, values_.read("values"));
    GraphSession session;
    DescribedClient client(session, service, type, qos_.make());
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
  QosOptions qos_;
};

}  // namespace

std::vector<VerbInfo> service_verbs() {
  return {{"service", "call", "calls a service", make_verb<ServiceCall>},
          {"service", "info", "describes a service", make_verb<ServiceInfo>}};
}

}  // namespace launch
