// SPDX-License-Identifier: Apache-2.0
// The kinds of what is wrong in a launch file. `launch check` shows each with an id, LF and the number in four digits.
#pragma once

#include <cstdint>

namespace launch {

// A number keeps its meaning for ever, because users disable findings by their ids. A new kind needs a row in
// programs/launch/check/finding_table.cpp.
enum class Finding : std::uint16_t {
  kNone = 0,  // the code that catches the error knows the kind: LaunchError::classify()

  // The text of a file.
  kUnreadableFile = 1,
  kMalformedXml = 2,
  kMalformedYaml = 3,
  kMalformedSubstitution = 4,
  kPython = 5,

  // What a file says.
  kUnknownName = 101,
  kWrongPlace = 102,
  kMissingAttribute = 103,
  kExclusive = 104,
  kWrongType = 105,
  kWrongValue = 106,
  kExtension = 107,
  kStrayText = 108,
  kUselessIgnore = 109,

  // What it comes to.
  kUndefined = 201,
  kArgument = 202,
  kExpression = 203,
  kStartOrder = 204,
  kUnknownProcess = 205,
  kEndless = 206,
  kRemark = 207,
  kOneWord = 208,
  kLeak = 209,
  kLostBackslash = 210,
  kUselessSeparator = 211,

  // What it needs.
  kMissingPackage = 301,
  kMissingProgram = 302,
  kMissingFile = 303,
  kMissingParameterFile = 304,
  kWrongParameterFile = 305,
  kMissingPlugin = 306,
  kMissingDirectory = 307,
  kMissingCpu = 308,
  kUnmatchedParameterFile = 309,
  kRepeatedParameter = 310,
  kOtherInRos2 = 311,

  // Nodes and names.
  kInvalidName = 401,
  kInvalidRemap = 402,
  kUselessRemap = 403,
  kSameNode = 404,
  kMissingContainer = 405,
  kUnknownParameter = 406,

  // Launch arguments.
  kUnreadArgument = 501,
  kUnknownArgument = 502,
  kNotGiven = 503,
  kIgnoredDefault = 504,

  // Traces.
  kUnknownContextField = 601,
  kUnknownEvent = 602,
  kSameSession = 603,
  kUnknownChainNode = 604,
};

}  // namespace launch
