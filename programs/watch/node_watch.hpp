// SPDX-License-Identifier: Apache-2.0
// What the nodes do while `launch top` or a page of `launch serve` shows it: runs launch-watch, which records them.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <string>
#include <vector>

#include "base/files/unique_fd.hpp"

namespace launch {

class NodeWatch {
 public:
  enum class Tells {
    kViews,    // texts for a terminal
    kMetrics,  // counters and histograms
  };
  // Starts it. Throws SpawnError.
  explicit NodeWatch(Tells tells = Tells::kViews);
  // Ends it and the recording.
  ~NodeWatch();
  NodeWatch(const NodeWatch&) = delete;
  NodeWatch& operator=(const NodeWatch&) = delete;

  // Takes what has come. Does not block. A program that crashes is started again, twice at most.
  void update();
  // False when the recording has ended by itself; lines() says why.
  bool goes_on() const { return static_cast<bool>(output_); }
  // The columns of the terminal.
  void set_width(std::size_t columns);

  // The newest view, or why there is none.
  const std::vector<std::string>& lines() const { return lines_; }
  // The newest families of OpenMetrics; "" before the first ones. The end of the exposition is not there.
  const std::string& metrics() const { return metrics_; }
  // The lines that hold `text`, and those that are no rows of a table.
  std::vector<std::string> lines_with(const std::string& text) const;

  // Ends the recording and returns the report of all of it; "" if there is none.
  std::string end();

 private:
  void start();
  void write_width();
  void begin_again_after_crash();
  void take(const std::string& text);
  // False at the end.
  bool read_some();

  Tells tells_;
  int restarts_ = 0;
  pid_t pid_ = -1;
  UniqueFd input_;
  UniqueFd output_;
  std::size_t width_ = 0;
  std::string received_;
  std::vector<std::string> lines_;
  std::string metrics_;
  std::string report_;
};

}  // namespace launch
