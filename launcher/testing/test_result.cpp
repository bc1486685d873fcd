// SPDX-License-Identifier: Apache-2.0
#include "launcher/testing/test_result.hpp"

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

}  // namespace

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
