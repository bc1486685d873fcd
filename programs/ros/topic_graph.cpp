// SPDX-License-Identifier: Apache-2.0
#include "programs/ros/topic_graph.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <rmw/qos_profiles.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <iterator>
#include <map>

#include "base/diagnostics/diagnostic.hpp"
#include "programs/ros/graph_names.hpp"

namespace launch {

namespace {

const std::map<std::string, rmw_qos_profile_t>& profiles() {
  static const std::map<std::string, rmw_qos_profile_t> known = {
      {"unknown", rmw_qos_profile_unknown},
      {"default", rmw_qos_profile_default},
      {"system_default", rmw_qos_profile_system_default},
      {"sensor_data", rmw_qos_profile_sensor_data},
      {"services_default", rmw_qos_profile_services_default},
      {"parameters", rmw_qos_profile_parameters},
      {"parameter_events", rmw_qos_profile_parameter_events}};
  return known;
}

template <typename T>
using Words = std::map<std::string, T>;

const Words<rmw_qos_history_policy_t> kHistory = {{"system_default", RMW_QOS_POLICY_HISTORY_SYSTEM_DEFAULT},
                                                  {"keep_last", RMW_QOS_POLICY_HISTORY_KEEP_LAST},
                                                  {"keep_all", RMW_QOS_POLICY_HISTORY_KEEP_ALL}};
const Words<rmw_qos_reliability_policy_t> kReliability = {{"system_default", RMW_QOS_POLICY_RELIABILITY_SYSTEM_DEFAULT},
                                                          {"reliable", RMW_QOS_POLICY_RELIABILITY_RELIABLE},
                                                          {"best_effort", RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT}};
const Words<rmw_qos_durability_policy_t> kDurability = {{"system_default", RMW_QOS_POLICY_DURABILITY_SYSTEM_DEFAULT},
                                                        {"transient_local", RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL},
                                                        {"volatile", RMW_QOS_POLICY_DURABILITY_VOLATILE}};
const Words<rmw_qos_liveliness_policy_t> kLiveliness = {{"system_default", RMW_QOS_POLICY_LIVELINESS_SYSTEM_DEFAULT},
                                                        {"automatic", RMW_QOS_POLICY_LIVELINESS_AUTOMATIC},
                                                        {"manual_by_topic", RMW_QOS_POLICY_LIVELINESS_MANUAL_BY_TOPIC}};

template <typename T>
std::vector<std::string> names_of(const std::map<std::string, T>& words) {
  std::vector<std::string> names;
  for (const auto& [name, value] : words) {
    names.push_back(name);
  }
  return names;
}

// The transform of CLI11 would put numbers in the place of words in its messages.
template <typename T>
void take_word(CLI::App& app, const std::string& option, std::string& value, const Words<T>& words,
               const std::string& help) {
  app.add_option(option, value, help)->check(CLI::IsMember(names_of(words)));
}

}  // namespace

void LookOptions::declare(CLI::App& app) {
  app.add_option("--spin-time", spin_time, "look for so many seconds; default: until nothing more is found")
      ->check(CLI::PositiveNumber);
  app.add_flag("--no-daemon", no_daemon, "has no effect: there is no daemon");
  app.add_flag("-s,--use-sim-time", use_sim_time, "has no effect: the time of the machine is used");
}

std::optional<Seconds> LookOptions::time() const {
  return spin_time ? std::optional<Seconds>(*spin_time) : std::nullopt;
}

void NodeListOptions::declare(CLI::App& app) {
  LookOptions::declare(app);
  app.add_flag("-a,--all", all, "also nodes whose name begins with '_'");
  app.add_flag("-c,--count-nodes", count, "print only how many there are");
}

void ValuesOption::declare(CLI::App& app, const std::string& name, const std::string& what) {
  CLI::Option* const values = app.add_option(name, text, fmt::format("the {} as YAML; default: {{}}", what));
  app.add_flag("--stdin", from_standard_input, fmt::format("read the {} from standard input", what))->excludes(values);
}

LocatedText ValuesOption::read(const std::string& name) {
  if (from_standard_input) {
    text.assign(std::istreambuf_iterator<char>(std::cin), {});
  }
  return word_of_command_line(from_standard_input ? "standard input" : name, text);
}

void QosOptions::declare(CLI::App& app, const std::string& verb, const std::string& default_profile) {
  profile = default_profile;
  app.add_option("--qos-profile", profile, fmt::format("quality of service to {} with", verb))
      ->check(CLI::IsMember(names_of(profiles())))
      ->capture_default_str();
  app.add_option("--qos-depth", depth, "messages that are kept")->check(CLI::NonNegativeNumber);
  take_word(app, "--qos-history", history, kHistory, "which messages are kept");
  const char* const fitting = verb == "subscribe" ? "; default: what fits the publishers" : "";
  take_word(app, "--qos-reliability", reliability, kReliability, fmt::format("reliability{}", fitting));
  take_word(app, "--qos-durability", durability, kDurability, fmt::format("durability{}", fitting));
  take_word(app, "--qos-liveliness", liveliness, kLiveliness, "liveliness");
  app.add_option("--qos-liveliness-lease-duration-seconds", lease, "after so many seconds a silent publisher is dead");
}

bool QosOptions::is_chosen() const {
  return depth || lease || !history.empty() || !reliability.empty() || !durability.empty() || !liveliness.empty();
}

rmw_qos_profile_t QosOptions::make() const {
  rmw_qos_profile_t qos = profiles().at(profile);
  if (!history.empty()) {
    qos.history = kHistory.at(history);
  }
  if (!reliability.empty()) {
    qos.reliability = kReliability.at(reliability);
  }
  if (!durability.empty()) {
    qos.durability = kDurability.at(durability);
  }
  if (!liveliness.empty()) {
    qos.liveliness = kLiveliness.at(liveliness);
  }
  if (lease) {
    const auto nanoseconds = std::chrono::duration_cast<std::chrono::nanoseconds>(Seconds(*lease)).count();
    qos.liveliness_lease_duration = {static_cast<std::uint64_t>(nanoseconds / 1'000'000'000),
                                     static_cast<std::uint64_t>(nanoseconds % 1'000'000'000)};
  }
  if (depth) {
    qos.depth = static_cast<std::size_t>(*depth);
  } else if (qos.durability == RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL && qos.depth == 0) {
    qos.depth = 1;
  }
  return qos;
}

rmw_qos_profile_t matching_qos(GraphSession& session, const std::string& topic, rmw_qos_profile_t profile) {
  std::size_t reliable = 0;
  std::size_t transient = 0;
  const auto publishers = session.node().get_publishers_info_by_topic(topic);
  for (const rclcpp::TopicEndpointInfo& publisher : publishers) {
    reliable += publisher.qos_profile().reliability() == rclcpp::ReliabilityPolicy::Reliable ? 1 : 0;
    transient += publisher.qos_profile().durability() == rclcpp::DurabilityPolicy::TransientLocal ? 1 : 0;
  }
  if (publishers.empty()) {
    return profile;
  }
  const auto choose = [&](std::size_t count, const char* strong, const char* weak) {
    if (count != 0 && count != publishers.size()) {
      fmt::print(stderr, "Some, but not all, publishers are {}. The subscription is {}, to hear all of them.\n", strong,
                 weak);
    }
    return count == publishers.size();
  };
  profile.reliability = choose(reliable, "reliable", "best effort") ? RMW_QOS_POLICY_RELIABILITY_RELIABLE
                                                                    : RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT;
  profile.durability = choose(transient, "transient local", "volatile") ? RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL
                                                                        : RMW_QOS_POLICY_DURABILITY_VOLATILE;
  return profile;
}

std::optional<std::string> type_of_topic(GraphSession& session, const std::string& topic) {
  const auto topics = session.node().get_topic_names_and_types();
  const auto found = topics.find(topic);
  if (found == topics.end() || found->second.empty()) {
    return std::nullopt;
  }
  if (found->second.size() > 1) {
    throw CommandError(fmt::format("topic '{}' has more than one type: {}", topic, fmt::join(found->second, ", ")),
                       "name the type behind the topic");
  }
  return found->second.front();
}

std::string wait_for_type(GraphSession& session, const std::string& topic) {
  session.wait_until([&] { return type_of_topic(session, topic).has_value(); }, Seconds(1));
  if (!type_of_topic(session, topic)) {
    fmt::print(stderr, "WARNING: topic [{}] does not appear to be published yet\n", topic);
    session.wait_until([&] { return type_of_topic(session, topic).has_value(); });
  }
  return type_of_topic(session, topic).value_or("");
}

std::vector<std::string> types_of_topic_or_all(const std::string& topic) {
  GraphSession session;
  session.discover(std::nullopt);
  const auto topics = session.node().get_topic_names_and_types();
  const auto found = topics.find(full_name(topic));
  return found == topics.end() ? installed_interfaces().names("msg") : found->second;
}

std::vector<std::string> topic_then_type(const std::vector<std::string>& words) {
  return words.empty()       ? all_names(kTopics)
         : words.size() == 1 ? types_of_topic_or_all(words.front())
                             : std::vector<std::string>();
}

}  // namespace launch
