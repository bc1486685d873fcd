// SPDX-License-Identifier: Apache-2.0
// What a monitoring system is told: launches and their processes, and what nodes do. OpenMetrics 1.0, or the text
// format 0.0.4 of Prometheus for a client that does not ask for OpenMetrics.
#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/environment/environment.hpp"
#include "programs/watch/node_watch.hpp"

namespace launch::serve {

// Answers of `ps`, one for each launch that runs and answers: an object with `launch` and `processes`, with the usage
// of the processes.
std::vector<nlohmann::ordered_json> ask_all_launches(const Environment& environment);

// Families of metrics of these launches.
std::string launch_metrics(const std::vector<nlohmann::ordered_json>& launches);

// The whole exposition, in one of the two formats.
enum class MetricsFormat { kOpenMetrics, kPrometheusText };
MetricsFormat metrics_format_for(const std::string& accept_header);
const char* metrics_content_type(MetricsFormat format);
std::string metrics_text(const std::string& families, MetricsFormat format);

// A recording of the nodes that lasts as long as somebody asks. May be used by several threads.
class NodeMetrics {
 public:
  static constexpr std::chrono::seconds kPatience{120};  // twice the usual longest time between two questions

  // The newest families; "" until there are any, and when the recording has ended by itself. Begins one if there is
  // none. Throws SpawnError.
  std::string families();
  // Ends the recording if nobody has asked for so long.
  void rest();

 private:
  std::mutex mutex_;
  std::unique_ptr<NodeWatch> watch_;
  std::chrono::steady_clock::time_point asked_;
};

}  // namespace launch::serve
