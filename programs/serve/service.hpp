// SPDX-License-Identifier: Apache-2.0
// What the service answers (docs/remote.md). Called by the threads of all connections at once.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>

#include "base/environment/environment.hpp"
#include "programs/serve/access.hpp"
#include "programs/serve/http_message.hpp"
#include "programs/serve/metrics.hpp"
#include "programs/serve/node_feed.hpp"

namespace launch::serve {

class Service {
 public:
  static constexpr int kMostFeeds = 16;

  // `log` is told of each request that changes something, and of each wrong token. `stop` becomes readable when answers
  // that do not end by themselves are to end. `access` must outlive the service and its answers. `shows_nodes`: a page
  // may ask what nodes do, which records them.
  Service(Access& access, Environment environment, int stop, std::function<void(const std::string&)> log,
          bool shows_nodes = false);

  HttpAnswer answer(const HttpRequest& request);
  // To be called now and then: ends what nobody has asked for of late.
  void rest() { node_metrics_.rest(); }

 private:
  HttpAnswer page(bool is_known);
  HttpAnswer log_in(const HttpRequest& request);
  HttpAnswer log_out(const HttpRequest& request);
  HttpAnswer launches();
  HttpAnswer of_launch(const HttpRequest& request, const std::string& rest);
  HttpAnswer control(const HttpRequest& request, const std::string& number);
  HttpAnswer feed(const HttpRequest& request, const std::string& number);
  HttpAnswer nodes(const HttpRequest& request);
  HttpAnswer metrics(const HttpRequest& request);
  // Counts a feed until the last copy is gone; null if there are too many.
  std::shared_ptr<void> count_feed();

  Access& access_;
  Environment environment_;
  int stop_;
  std::function<void(const std::string&)> log_;
  bool shows_nodes_;
  NodeRecordings recordings_;
  NodeMetrics node_metrics_;
  std::shared_ptr<std::atomic<int>> feeds_ = std::make_shared<std::atomic<int>>(0);
};

// The value of a field of a form (application/x-www-form-urlencoded), decoded; "" if there is none.
std::string form_field(std::string_view form, std::string_view name);

}  // namespace launch::serve
