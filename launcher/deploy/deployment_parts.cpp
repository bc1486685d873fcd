// SPDX-License-Identifier: Apache-2.0
// A deployment in a folder for each machine, and the head that says what it lacks.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "base/text/utf8.hpp"
#include "launcher/deploy/deployment.hpp"

namespace launch {
namespace {

// One line of a comment.
std::string one_line(const std::string& text) {
  std::string line;
  append_as_utf8(line, text);
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; }, '?');
  return line;
}

}  // namespace

std::string to_string(const LeftOut& left_out) {
  const std::string place = left_out.where ? fmt::format(" ({})", to_string(left_out.where)) : "";
  return one_line(fmt::format("not exported: {}{}", left_out.what, place));
}

std::vector<MachinePart> parts_of(DeploymentPlan& plan) {
  std::map<std::string, MachinePart> parts;  // the empty name comes first
  std::vector<std::size_t> places;           // of each service, in its part
  for (const Service& service : plan.services) {
    MachinePart& part = parts[service.spec->machine];
    part.machine = service.spec->machine;
    places.push_back(part.services.size());
    part.services.push_back(service);
    std::vector<ServiceBefore>& before = part.services.back().before;
    std::erase_if(before, [&](const ServiceBefore& other) {
      const bool is_elsewhere = plan.services[other.service].spec->machine != part.machine;
      if (is_elsewhere) {
        plan.left_out.push_back({other.waits + ", on another machine", other.where});
      }
      return is_elsewhere;
    });
  }
  if (parts.size() > 1) {
    for (const Service& service : plan.services) {
      if (service.spec->required || service.spec->shutdown_on_exit) {
        plan.left_out.push_back(
            {fmt::format("the end of all on other machines with the end of '{}'", service.name), service.spec->origin});
      }
    }
  }
  std::vector<MachinePart> result;
  for (auto& [machine, part] : parts) {
    for (Service& service : part.services) {
      for (ServiceBefore& before : service.before) {
        before.service = places[before.service];
      }
    }
    result.push_back(std::move(part));
  }
  if (result.empty()) {
    result.emplace_back();
  }
  return result;
}

Deployment deploy_parts(const LaunchPlan& plan, const DeploymentOptions& options, const WritePart& write) {
  DeploymentPlan all = deployment_of(plan);
  Deployment result;
  const std::vector<MachinePart> parts = parts_of(all);
  result.left_out = all.left_out;
  for (const MachinePart& part : parts) {
    const std::string folder = part.machine.empty() ? "" : part.machine + "/";
    DeploymentOptions there = options;
    there.machine = part.machine;
    if (there.install_directory.empty()) {
      there.install_directory = options.directory + (folder.empty() ? "" : "/" + part.machine);
    }
    Deployment written = write(part.services, there);
    result.left_out.insert(result.left_out.end(), written.left_out.begin(), written.left_out.end());
    written.left_out.insert(written.left_out.begin(), all.left_out.begin(), all.left_out.end());
    add_head(written);
    for (DeployedFile& file : written.files) {
      result.files.push_back({folder + file.path, std::move(file.content)});
    }
  }
  return result;
}

void add_head(Deployment& deployment) {
  if (deployment.files.empty()) {
    return;
  }
  std::string head;
  for (const LeftOut& left : deployment.left_out) {
    head += fmt::format("# {}\n", to_string(left));
  }
  std::string& content = deployment.files.front().content;
  content.insert(content.find('\n') + 1, head);
}

}  // namespace launch
