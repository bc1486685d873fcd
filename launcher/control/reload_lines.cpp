// SPDX-License-Identifier: Apache-2.0
#include "launcher/control/reload_lines.hpp"

#include <chrono>
#include <nlohmann/json.hpp>
#include <vector>

#include "launcher/control/control_protocol.hpp"

namespace launch {
namespace {

using Json = nlohmann::ordered_json;

// Texts may hold any bytes.
std::string text_of_line(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json event(const char* name, ReloadNumber number) {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return {{"time", std::chrono::duration<double>(now).count()}, {"event", name}, {"reload", number}};
}

Json list_of(const std::vector<ReloadReport::Line>& lines) {
  Json list = Json::array();
  for (const ReloadReport::Line& line : lines) {
    Json entry{{"process", line.process}};
    if (!line.changes.empty()) {
      entry["changes"] = line.changes;
    }
    if (line.where) {
      const SourceFile::Position position = line.where.file->position(line.where.begin);
      entry["place"] = {{"file", line.where.file->path()}, {"line", position.line}, {"column", position.column}};
    }
    list.push_back(std::move(entry));
  }
  return list;
}

}  // namespace

std::string reload_answer_line(ReloadNumber number) {
  return text_of_line({{"version", kControlVersion}, {"ok", true}, {"reload", number}});
}

std::string reload_line(const ReloadReport& report) {
  Json json = event("reload", report.number);
  json["dry_run"] = report.only_shown;
  if (!report.refused.empty()) {
    json["refused"] = report.refused;
  } else if (!report.errors.empty()) {
    json["errors"] = render(report.errors, false, "launch");
  } else {
    json["starts"] = list_of(report.starts);
    json["ends"] = list_of(report.ends);
    json["restarts"] = list_of(report.restarts);
    json["sets"] = list_of(report.sets);
    json["takes_over"] = list_of(report.takes_over);
    json["stays"] = report.stays;
    json["notes"] = report.notes;
    json["took"] = std::chrono::duration<double>(report.took).count();
  }
  return text_of_line(json);
}

std::string reloaded_line(const ReloadEnd& end) {
  Json json = event("reloaded", end.number);
  json["failures"] = end.failures;
  return text_of_line(json);
}

}  // namespace launch
