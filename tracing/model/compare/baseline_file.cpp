// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/compare/baseline_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tracing/model/compare/kept_samples.hpp"

namespace tracing::compare {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "launch report baseline";

Json json_of(const Measurement& one) {
  Json json{{"kind", kind_name(one.kind)},
            {"subject", one.subject},
            {"quantity", one.quantity},
            {"count", one.count},
            {"doubtful", one.doubtful}};
  if (one.estimated) {
    json["estimated"] = true;
  }
  if (one.sends) {
    json["sends"] = *one.sends;
  }
  if (one.waits) {
    json["waits"] = true;
  }
  if (!one.steps.empty()) {
    json["steps"] = one.steps;
  }
  json["samples_ns"] = one.samples;
  return json;
}

std::optional<Kind> kind_of(const std::string& name) {
  const auto found = std::find(std::begin(kKindNames), std::end(kKindNames), name);
  return found == std::end(kKindNames) ? std::nullopt : std::optional(static_cast<Kind>(found - kKindNames));
}

Measurement measurement_of(const Json& json) {
  Measurement one;
  const std::string kind = json.at("kind");
  const std::optional<Kind> known = kind_of(kind);
  if (!known) {
    throw BaselineError(fmt::format("'{}' is no kind of subject", kind));
  }
  one.kind = *known;
  json.at("subject").get_to(one.subject);
  json.at("quantity").get_to(one.quantity);
  json.at("count").get_to(one.count);
  json.at("doubtful").get_to(one.doubtful);
  one.estimated = json.value("estimated", false);
  if (json.contains("sends")) {
    one.sends = json.at("sends").get<bool>();
  }
  one.waits = json.value("waits", false);
  if (json.contains("steps")) {
    json.at("steps").get_to(one.steps);
  }
  json.at("samples_ns").get_to(one.samples);
  if (one.samples.empty()) {
    throw BaselineError(fmt::format("'{}' has no samples", one.subject));
  }
  return one;
}

RunSummary run_of(const Json& json) {
  RunSummary run;
  json.at("directory").get_to(run.directory);
  json.at("begin_ns").get_to(run.begin_ns);
  json.at("duration_ns").get_to(run.duration_ns);
  json.at("events").get_to(run.events);
  json.at("remark").get_to(run.remark);
  for (const Json& one : json.at("measurements")) {
    run.measurements.push_back(measurement_of(one));
  }
  return run;
}

std::string content_of(const std::filesystem::path& file) {
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (stream && stream.peek() != std::ifstream::traits_type::eof()) {
    text << stream.rdbuf();
  }
  if (!stream && errno != 0) {
    throw BaselineError(fmt::format("cannot read the baseline {}: {}", file.native(), std::strerror(errno)));
  }
  return text.str();
}

}  // namespace

std::string baseline_text(const std::vector<RunSummary>& runs) {
  Json list = Json::array();
  for (const RunSummary& run : runs) {
    Json measurements = Json::array();
    for (const Measurement& one : run.measurements) {
      measurements.push_back(json_of(one));
    }
    list.push_back({{"directory", run.directory},
                    {"begin_ns", run.begin_ns},
                    {"duration_ns", run.duration_ns},
                    {"events", run.events},
                    {"remark", run.remark},
                    {"measurements", measurements}});
  }
  const Json baseline{{"format", kFormat}, {"version", kBaselineVersion}, {"runs", list}};
  return baseline.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Runs read_baseline(const std::filesystem::path& file) {
  const std::string text = content_of(file);
  Runs baseline{file.native(), {}};
  try {
    const Json json = Json::parse(text);
    if (!json.is_object() || !json.contains("format") || json["format"] != kFormat) {
      throw BaselineError(fmt::format("{} is no baseline of launch report", file.native()));
    }
    const int version = json.at("version");
    if (version != kBaselineVersion) {
      throw BaselineError(fmt::format("{} has version {} of the format of baselines, this program reads version {}",
                                      file.native(), version, kBaselineVersion));
    }
    try {
      for (const Json& run : json.at("runs")) {
        baseline.runs.push_back(run_of(run));
      }
    } catch (const BaselineError& error) {
      throw BaselineError(fmt::format("{} is damaged: {}", file.native(), error.what()));
    }
  } catch (const Json::parse_error&) {
    throw BaselineError(fmt::format("{} is no baseline of launch report", file.native()));
  } catch (const Json::exception& error) {
    // "[json.exception.out_of_range.403] key 'runs' not found"
    const std::string reason = error.what();
    throw BaselineError(fmt::format("{} is damaged: {}", file.native(), reason.substr(reason.find("] ") + 2)));
  }
  if (baseline.runs.empty()) {
    throw BaselineError(fmt::format("{} has no run", file.native()));
  }
  return baseline;
}

}  // namespace tracing::compare
