// SPDX-License-Identifier: Apache-2.0
#include "launcher/testing/test_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace launch {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const TestFailure& failure) {
  return {{"message", failure.message},
          {"file", failure.file},
          {"line", failure.line},
          {"column", failure.column},
          {"text", failure.text}};
}

Json json_of(const FaultResult& fault) {
  Json json = {{"number", fault.number}, {"what", fault.what},     {"file", fault.file},
               {"line", fault.line},     {"column", fault.column}, {"place", fault.place}};
  json["left_out"] = fault.left_out;
  if (fault.applied()) {
    json["seconds"] = fault.seconds;
    if (fault.messages > 0) {
      json["messages"] = fault.messages;
      json["latest_seconds"] = fault.latest;
    }
    if (fault.packets) {
      json["packets"] = *fault.packets;
    }
  } else {
    json["reason"] = fault.reason;
  }
  return json;
}

FaultResult fault_of(const Json& json) {
  const std::optional<std::uint64_t> packets =
      json.contains("packets") ? std::optional(json.at("packets").get<std::uint64_t>()) : std::nullopt;
  return {.number = json.at("number").get<std::size_t>(),
          .file = json.at("file").get<std::string>(),
          .line = json.at("line").get<unsigned>(),
          .column = json.at("column").get<unsigned>(),
          .place = json.at("place").get<std::string>(),
          .what = json.at("what").get<std::string>(),
          .reason = json.value("reason", ""),
          .left_out = json.at("left_out").get<bool>(),
          .seconds = json.value("seconds", 0.0),
          .messages = json.value("messages", std::uint64_t{0}),
          .latest = json.value("latest_seconds", 0.0),
          .packets = packets};
}

}  // namespace

std::string TestResult::full_name() const {
  std::string text = name;
  if (seed_in_name && seed) {
    text += fmt::format(" [seed {}]", *seed);
  }
  return round == 0 ? text : fmt::format("{} #{}", text, round);
}

std::string fault_count_text(const TestResult& result) {
  const std::vector<FaultResult>& faults = result.faults;
  const auto applied = std::count_if(faults.begin(), faults.end(), [](const auto& fault) { return fault.applied(); });
  return faults.empty() ? "" : fmt::format("{} of {} fault{}", applied, faults.size(), faults.size() == 1 ? "" : "s");
}

std::string seed_text(const TestResult& result) {
  if (!result.seed) {
    return {};
  }
  const std::string count = fault_count_text(result);
  std::string text =
      fmt::format("      = seed {}{}\n", *result.seed, count.empty() ? "" : fmt::format(": {} applied", count));
  for (const FaultResult& fault : result.faults) {
    text += fmt::format("          {}  {}\n", fault.number, fault.text());
  }
  return result.again.empty() ? text : text + fmt::format("      = again: {}\n", result.again);
}

std::string shrunk_text(const TestResult& result) {
  if (!result.shrunk) {
    return {};
  }
  const Shrunk& shrunk = *result.shrunk;
  const std::string runs = fmt::format("{} run{}", shrunk.runs, shrunk.runs == 1 ? "" : "s");
  std::string text = shrunk.faults.empty()
                         ? fmt::format("      = shrunk in {}: it fails without any fault, too\n", runs)
                         : fmt::format("      = shrunk to {} of {} fault{} in {}:\n", shrunk.faults.size(), shrunk.of,
                                       shrunk.of == 1 ? "" : "s", runs);
  for (const FaultResult& fault : shrunk.faults) {
    text += fmt::format("          {}  {}\n", fault.number, fault.text());
  }
  return text + fmt::format("      = again: {}\n", shrunk.again);
}

std::string to_json(const TestResult& result) {
  Json json = {{"file", result.file},
               {"name", result.name},
               {"line", result.line},
               {"outcome", result.passed() ? "passed" : "failed"},
               {"seconds", result.seconds},
               {"met", result.met},
               {"not_judged", result.not_judged},
               {"failures", Json::array()},
               {"directory", result.directory},
               {"round", result.round},
               {"attempts", result.attempts},
               {"earlier", result.earlier}};
  if (result.seed) {
    json["seed"] = *result.seed;
    json["faults"] = Json::array();
    for (const FaultResult& fault : result.faults) {
      json["faults"].push_back(json_of(fault));
    }
    json["again"] = result.again;
  }
  if (result.shrunk) {
    json["shrunk"] = {{"of", result.shrunk->of},
                      {"runs", result.shrunk->runs},
                      {"faults", Json::array()},
                      {"again", result.shrunk->again}};
    for (const FaultResult& fault : result.shrunk->faults) {
      json["shrunk"]["faults"].push_back(json_of(fault));
    }
  }
  for (const TestFailure& failure : result.failures) {
    json["failures"].push_back(json_of(failure));
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::optional<TestResult> from_json(const std::string& text) {
  try {
    const Json json = Json::parse(text);
    TestResult result;
    result.file = json.at("file").get<std::string>();
    result.name = json.at("name").get<std::string>();
    result.line = json.at("line").get<unsigned>();
    result.seconds = json.at("seconds").get<double>();
    result.met = json.at("met").get<std::size_t>();
    result.not_judged = json.at("not_judged").get<std::size_t>();
    result.directory = json.at("directory").get<std::string>();
    result.round = json.at("round").get<std::size_t>();
    result.attempts = json.at("attempts").get<std::size_t>();
    result.earlier = json.at("earlier").get<std::string>();
    if (json.contains("seed")) {
      result.seed = json.at("seed").get<std::uint64_t>();
      result.again = json.at("again").get<std::string>();
      for (const Json& fault : json.at("faults")) {
        result.faults.push_back(fault_of(fault));
      }
    }
    for (const Json& failure : json.at("failures")) {
      result.failures.push_back({.message = failure.at("message").get<std::string>(),
                                 .file = failure.at("file").get<std::string>(),
                                 .line = failure.at("line").get<unsigned>(),
                                 .column = failure.at("column").get<unsigned>(),
                                 .text = failure.at("text").get<std::string>()});
    }
    return result;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

}  // namespace launch
