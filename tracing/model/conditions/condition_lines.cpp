// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/conditions/condition_lines.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "base/overloaded.hpp"

namespace tracing {
namespace {

using ConditionJson = nlohmann::ordered_json;

std::string line_of(const ConditionJson& json) {
  return json.dump(-1, ' ', false, ConditionJson::error_handler_t::replace) + "\n";
}

double seconds_of(std::chrono::nanoseconds time) {
  return std::chrono::duration<double>(time).count();
}

std::chrono::nanoseconds time_of(const ConditionJson& seconds) {
  return std::chrono::nanoseconds(std::llround(seconds.get<double>() * 1e9));
}

ConditionJson parse(std::string_view text) {
  ConditionJson json = ConditionJson::parse(text, nullptr, false);
  if (!json.is_object()) {
    throw std::runtime_error("a message about conditions is a JSON object");
  }
  return json;
}

const char* name_of(LiveCondition::Kind kind) {
  switch (kind) {
    case LiveCondition::Kind::kSilence:
      return "silence";
    case LiveCondition::Kind::kRate:
      return "rate";
    case LiveCondition::Kind::kLate:
      return "late";
    case LiveCondition::Kind::kLoss:
      return "loss";
    case LiveCondition::Kind::kMemory:
    case LiveCondition::Kind::kGrowth:
    case LiveCondition::Kind::kProcessor:
      break;  // launch-watch is not asked for them
  }
  return "";
}

LiveCondition::Kind kind_named(std::string_view name) {
  for (const auto kind : {LiveCondition::Kind::kSilence, LiveCondition::Kind::kRate, LiveCondition::Kind::kLate,
                          LiveCondition::Kind::kLoss}) {
    if (name == name_of(kind)) {
      return kind;
    }
  }
  throw std::runtime_error("a condition of an unknown kind");
}

LiveCondition::Subject subject_of(const ConditionJson& json) {
  for (const LiveCondition::Subject subject : kRecordedSubjects) {
    if (json.contains(tracing::name_of(subject))) {
      return subject;
    }
  }
  throw std::runtime_error("a condition on nothing");
}

// Turns the errors of the library into those of this file.
template <typename Read>
auto reading(std::string_view text, Read read) {
  try {
    return read(parse(text));
  } catch (const ConditionJson::exception& error) {
    throw std::runtime_error(std::string("a message about conditions can't be read: ") + error.what());
  }
}

}  // namespace

std::string to_line(const ConditionOrder& order) {
  return line_of(std::visit(launch::Overloaded{
                                [](const WatchCondition& watch) {
                                  const LiveCondition& condition = watch.condition;
                                  ConditionJson json{
                                      {"watch", watch.id},
                                      {"kind", name_of(condition.kind)},
                                      {tracing::name_of(condition.subject), condition.name},
                                      {"window", seconds_of(condition.window)},
                                      {"grace", seconds_of(condition.grace)},
                                  };
                                  if (condition.below) {
                                    json["below"] = *condition.below;
                                  }
                                  if (condition.above) {
                                    json["above"] = *condition.above;
                                  }
                                  if (condition.kind == LiveCondition::Kind::kLate) {
                                    json["max"] = seconds_of(condition.max);
                                  }
                                  if (condition.share < 1) {
                                    json["share"] = condition.share;
                                  }
                                  return json;
                                },
                                [](const ForgetCondition& forget) {
                                  return ConditionJson{{"forget", forget.id}};
                                },
                            },
                            order));
}

std::string to_line(const ConditionReport& report) {
  return line_of(std::visit(launch::Overloaded{
                                [](const NodesAreRecorded&) {
                                  return ConditionJson{{"recording", true}};
                                },
                                [](const ConditionChanged& changed) {
                                  ConditionJson json{{"condition", changed.id},
                                                     {"holds", changed.change.holds},
                                                     {"figure", changed.change.figure},
                                                     {"processes", changed.change.processes}};
                                  if (changed.change.late > 0) {
                                    json["late"] = changed.change.late;
                                  }
                                  return json;
                                },
                                [](const NameNotSeen& unseen) {
                                  return ConditionJson{{"unseen", unseen.id}, {"known", unseen.known}};
                                },
                                [](const RecordingIsBehind& behind) {
                                  return ConditionJson{{"behind", behind.seconds}};
                                },
                                [](const WatchFailed& failed) {
                                  return ConditionJson{{"error", failed.error}, {"help", failed.help}};
                                },
                            },
                            report));
}

ConditionOrder parse_condition_order(std::string_view text) {
  return reading(text, [](const ConditionJson& json) -> ConditionOrder {
    if (json.contains("forget")) {
      return ForgetCondition{json.at("forget").get<ConditionId>()};
    }
    WatchCondition watch{json.at("watch").get<ConditionId>(), {}};
    LiveCondition& condition = watch.condition;
    condition.kind = kind_named(json.at("kind").get<std::string>());
    condition.subject = subject_of(json);
    condition.name = json.at(tracing::name_of(condition.subject)).get<std::string>();
    condition.window = time_of(json.at("window"));
    condition.grace = time_of(json.at("grace"));
    if (json.contains("below")) {
      condition.below = json.at("below").get<double>();
    }
    if (json.contains("above")) {
      condition.above = json.at("above").get<double>();
    }
    if (condition.kind == LiveCondition::Kind::kLate) {
      condition.max = time_of(json.at("max"));
    }
    condition.share = json.value("share", 1.0);
    return watch;
  });
}

ConditionReport parse_condition_report(std::string_view text) {
  return reading(text, [](const ConditionJson& json) -> ConditionReport {
    if (json.contains("condition")) {
      return ConditionChanged{json.at("condition").get<ConditionId>(),
                              {.holds = json.at("holds").get<bool>(),
                               .figure = json.at("figure").get<double>(),
                               .processes = json.at("processes").get<std::vector<std::string>>(),
                               .late = json.value("late", 0.0)}};
    }
    if (json.contains("unseen")) {
      return NameNotSeen{json.at("unseen").get<ConditionId>(), json.at("known").get<std::vector<std::string>>()};
    }
    if (json.contains("behind")) {
      return RecordingIsBehind{json.at("behind").get<double>()};
    }
    if (json.contains("error")) {
      return WatchFailed{json.at("error").get<std::string>(), json.at("help").get<std::string>(), false};
    }
    if (json.contains("recording")) {
      return NodesAreRecorded{};
    }
    throw std::runtime_error("a message about conditions of an unknown kind");
  });
}

}  // namespace tracing
