// SPDX-License-Identifier: Apache-2.0
#include "log_file.hpp"

#include <cerrno>
#include <cstring>
#include <ostream>
#include <stdexcept>
#include <utility>

namespace performance_test {

namespace {

using Columns = std::vector<std::pair<const char*, double>>;

Columns columns(const Interval& interval) {
  const LatencySummary& latency = interval.latency;
  return {{"T_experiment", interval.end},
          {"T_interval", interval.length},
          {"sent", static_cast<double>(interval.sent)},
          {"received", static_cast<double>(interval.received)},
          {"lost", static_cast<double>(interval.lost)},
          {"data_received_bytes", static_cast<double>(interval.bytes_received)},
          {"latency_min_ms", latency.min},
          {"latency_mean_ms", latency.mean},
          {"latency_stddev_ms", latency.standard_deviation},
          {"latency_p50_ms", latency.median},
          {"latency_p90_ms", latency.p90},
          {"latency_p99_ms", latency.p99},
          {"latency_p999_ms", latency.p999},
          {"latency_max_ms", latency.max}};
}

void write_json(std::ostream& out, const Interval& interval) {
  const char* separator = "{";
  for (const auto& [name, value] : columns(interval)) {
    out << separator << '"' << name << "\": " << value;
    separator = ", ";
  }
  out << '}';
}

}  // namespace

LogFile::LogFile(const Settings& settings)
    : is_json_(settings.logfile.size() > 5 && settings.logfile.compare(settings.logfile.size() - 5, 5, ".json") == 0) {
  if (settings.logfile.empty()) {
    return;
  }
  file_.open(settings.logfile);
  if (!file_) {
    throw std::runtime_error("cannot write '" + settings.logfile + "': " + std::strerror(errno));
  }
  file_.precision(15);
  if (is_json_) {
    file_ << "{\"msg\": \"" << settings.msg << "\", \"rate\": " << settings.rate
          << ", \"publishers\": " << settings.publishers << ", \"subscribers\": " << settings.subscribers
          << ", \"intra_process\": " << (settings.intra_process ? "true" : "false")
          << ", \"zero_copy\": " << (settings.zero_copy ? "true" : "false") << ",\n \"analysis_results\": [";
  } else {
    const char* separator = "";
    for (const auto& [name, value] : columns(Interval())) {
      file_ << separator << name;
      separator = ",";
    }
    file_ << '\n';
  }
}

void LogFile::add(const Interval& interval) {
  if (!file_.is_open()) {
    return;
  }
  if (is_json_) {
    file_ << (is_first_ ? "\n  " : ",\n  ");
    write_json(file_, interval);
  } else {
    const char* separator = "";
    for (const auto& [name, value] : columns(interval)) {
      file_ << separator << value;
      separator = ",";
    }
    file_ << '\n';
  }
  file_.flush();
  is_first_ = false;
}

void LogFile::finish(const Interval& whole) {
  if (!file_.is_open() || !is_json_) {
    return;
  }
  file_ << "],\n \"summary\": ";
  write_json(file_, whole);
  file_ << "}\n";
  file_.flush();
}

}  // namespace performance_test
