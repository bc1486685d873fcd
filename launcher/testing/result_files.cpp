// SPDX-License-Identifier: Apache-2.0
#include "launcher/testing/result_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/text/quoted_text.hpp"
#include "base/text/utf8.hpp"

namespace launch {

namespace {

using OrderedJson = nlohmann::ordered_json;

std::string whole_text(const TestResult& result) {
  std::string text;
  for (const TestFailure& failure : result.failures) {
    text += failure.text;
  }
  text += seed_text(result) + shrunk_text(result);
  if (!result.directory.empty()) {
    text += fmt::format("files: {}\n", result.directory);
  }
  return text;
}

std::string first_message(const TestResult& result) {
  return result.failures.empty() ? std::string() : result.failures.front().message;
}

// Characters that XML has no way to write are left out. The output of a program may be no UTF-8.
std::string xml(const std::string& text) {
  std::string characters;
  append_as_utf8(characters, text);
  std::string clean;
  std::copy_if(characters.begin(), characters.end(), std::back_inserter(clean),
               [](char c) { return static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t'; });
  return as_xml_text(clean);
}

// The seed and the faults of a test.
std::string properties(const TestResult& result) {
  if (!result.seed) {
    return {};
  }
  std::string text = fmt::format("      <properties>\n        <property name=\"seed\" value=\"{}\"/>\n", *result.seed);
  for (const FaultResult& fault : result.faults) {
    text += fmt::format("        <property name=\"fault {}\" value=\"{}\"/>\n", fault.number, xml(fault.text()));
  }
  return text + "      </properties>\n";
}

}  // namespace

std::string as_junit(const std::vector<TestResult>& results) {
  std::map<std::string, std::vector<const TestResult*>> suites;
  double seconds = 0;
  for (const TestResult& result : results) {
    suites[result.file].push_back(&result);
    seconds += result.seconds;
  }
  const auto failed = [](const auto& result) { return !result.passed(); };
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  text += fmt::format("<testsuites name=\"launch test\" tests=\"{}\" failures=\"{}\" errors=\"0\" time=\"{:.3f}\">\n",
                      results.size(), std::count_if(results.begin(), results.end(), failed), seconds);
  for (const auto& [file, tests] : suites) {
    double time = 0;
    std::size_t failures = 0;
    for (const TestResult* const test : tests) {
      time += test->seconds;
      failures += test->passed() ? 0 : 1;
    }
    text += fmt::format("  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"0\" time=\"{:.3f}\">\n",
                        xml(file), tests.size(), failures, time);
    for (const TestResult* const test : tests) {
      text += fmt::format("    <testcase name=\"{}\" classname=\"{}\" file=\"{}\" line=\"{}\" time=\"{:.3f}\"",
                          xml(test->full_name()), xml(file), xml(file), test->line, test->seconds);
      std::string inside = properties(*test);
      if (!test->passed()) {
        inside += fmt::format("      <failure message=\"{}\">{}</failure>\n", xml(first_message(*test)),
                              xml(whole_text(*test)));
      } else if (!test->earlier.empty()) {
        inside += fmt::format("      <flakyFailure message=\"{}\"/>\n", xml(test->earlier));
      }
      text += inside.empty() ? "/>\n" : fmt::format(">\n{}    </testcase>\n", inside);
    }
    text += "  </testsuite>\n";
  }
  return text + "</testsuites>\n";
}

std::string as_tap(const std::vector<TestResult>& results) {
  std::string text = fmt::format("TAP version 13\n1..{}\n", results.size());
  std::size_t number = 0;
  for (const TestResult& result : results) {
    std::string title = result.title();
    std::replace(title.begin(), title.end(), '#', '_');  // it begins a directive
    text += fmt::format("{} {} - {}\n", result.passed() ? "ok" : "not ok", ++number, title);
    if (result.passed() && !result.earlier.empty()) {
      text += fmt::format("# attempt {} has passed; the first: {}\n", result.attempts, result.earlier);
    }
    if (result.passed() && result.seed) {
      text += fmt::format("# seed {}\n", *result.seed);
      for (const FaultResult& fault : result.faults) {
        text += fmt::format("# fault {}: {}\n", fault.number, fault.text());
      }
    }
    if (!result.passed()) {
      text +=
          fmt::format("  ---\n  message: {}\n  duration_ms: {:.0f}\n  details: |\n",
                      OrderedJson(first_message(result)).dump(-1, ' ', false, OrderedJson::error_handler_t::replace),
                      result.seconds * 1000);
      std::istringstream lines(whole_text(result));
      for (std::string line; std::getline(lines, line);) {
        text += "    " + line + "\n";
      }
      text += "  ...\n";
    }
  }
  return text;
}

std::string as_github(const std::vector<TestResult>& results, const std::string& directory) {
  const auto escaped = [](const std::string& text, bool property) {
    std::string result;
    for (const char c : text) {
      const bool means_something = c == '%' || c == '\n' || c == '\r' || (property && (c == ':' || c == ','));
      result += means_something ? fmt::format("%{:02X}", static_cast<unsigned char>(c)) : std::string(1, c);
    }
    return result;
  };
  std::string text;
  for (const TestResult& result : results) {
    for (const TestFailure& failure : result.failures) {
      std::string file = failure.file.empty() ? result.file : failure.file;
      if (file.starts_with(directory + "/")) {
        file.erase(0, directory.size() + 1);
      }
      text += fmt::format("::error file={},line={},title={}::{}\n", escaped(file, true),
                          failure.file.empty() ? result.line : failure.line, escaped(result.full_name(), true),
                          escaped(failure.text + seed_text(result) + shrunk_text(result), false));
    }
    if (result.passed() && !result.earlier.empty()) {
      text += fmt::format(
          "::warning file={},line={},title={}::{}\n", escaped(result.file, true), result.line,
          escaped(result.full_name(), true),
          escaped(fmt::format("passed in attempt {}; the first: {}", result.attempts, result.earlier), false));
    }
  }
  return text;
}

std::string as_json(const std::vector<TestResult>& results) {
  OrderedJson tests = OrderedJson::array();
  std::size_t failed = 0;
  for (const TestResult& result : results) {
    tests.push_back(OrderedJson::parse(to_json(result)));
    failed += result.passed() ? 0 : 1;
  }
  const OrderedJson json = {{"passed", results.size() - failed}, {"failed", failed}, {"tests", tests}};
  return json.dump(2) + "\n";
}

}  // namespace launch
