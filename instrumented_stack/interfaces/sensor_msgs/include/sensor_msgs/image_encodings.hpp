// SPDX-License-Identifier: Apache-2.0
// The names that sensor_msgs/msg/Image has for the layout of its pixels, and what they mean.
#pragma once

#include <array>
#include <cctype>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>

namespace sensor_msgs {
namespace image_encodings {

// NOLINTBEGIN: the names of ROS 2
inline const char RGB8[] = "rgb8";
inline const char RGBA8[] = "rgba8";
inline const char RGB16[] = "rgb16";
inline const char RGBA16[] = "rgba16";
inline const char BGR8[] = "bgr8";
inline const char BGRA8[] = "bgra8";
inline const char BGR16[] = "bgr16";
inline const char BGRA16[] = "bgra16";
inline const char MONO8[] = "mono8";
inline const char MONO16[] = "mono16";

// Bits, kind (unsigned, signed, float) and number of channels, as in OpenCV.
inline const char TYPE_8UC1[] = "8UC1";
inline const char TYPE_8UC2[] = "8UC2";
inline const char TYPE_8UC3[] = "8UC3";
inline const char TYPE_8UC4[] = "8UC4";
inline const char TYPE_8SC1[] = "8SC1";
inline const char TYPE_8SC2[] = "8SC2";
inline const char TYPE_8SC3[] = "8SC3";
inline const char TYPE_8SC4[] = "8SC4";
inline const char TYPE_16UC1[] = "16UC1";
inline const char TYPE_16UC2[] = "16UC2";
inline const char TYPE_16UC3[] = "16UC3";
inline const char TYPE_16UC4[] = "16UC4";
inline const char TYPE_16SC1[] = "16SC1";
inline const char TYPE_16SC2[] = "16SC2";
inline const char TYPE_16SC3[] = "16SC3";
inline const char TYPE_16SC4[] = "16SC4";
inline const char TYPE_32SC1[] = "32SC1";
inline const char TYPE_32SC2[] = "32SC2";
inline const char TYPE_32SC3[] = "32SC3";
inline const char TYPE_32SC4[] = "32SC4";
inline const char TYPE_32FC1[] = "32FC1";
inline const char TYPE_32FC2[] = "32FC2";
inline const char TYPE_32FC3[] = "32FC3";
inline const char TYPE_32FC4[] = "32FC4";
inline const char TYPE_64FC1[] = "64FC1";
inline const char TYPE_64FC2[] = "64FC2";
inline const char TYPE_64FC3[] = "64FC3";
inline const char TYPE_64FC4[] = "64FC4";

inline const char BAYER_RGGB8[] = "bayer_rggb8";
inline const char BAYER_BGGR8[] = "bayer_bggr8";
inline const char BAYER_GBRG8[] = "bayer_gbrg8";
inline const char BAYER_GRBG8[] = "bayer_grbg8";
inline const char BAYER_RGGB16[] = "bayer_rggb16";
inline const char BAYER_BGGR16[] = "bayer_bggr16";
inline const char BAYER_GBRG16[] = "bayer_gbrg16";
inline const char BAYER_GRBG16[] = "bayer_grbg16";

inline const char UYVY[] = "uyvy";
inline const char YUV422[] = "yuv422";  // another name of uyvy
inline const char YUYV[] = "yuyv";
inline const char YUV422_YUY2[] = "yuv422_yuy2";  // another name of yuyv
inline const char NV21[] = "nv21";
inline const char NV24[] = "nv24";
// NOLINTEND

namespace detail {

struct Layout {
  int channels = 0;  // 0: no such encoding
  int bits = 0;
};

// The layout of "<bits><U|S|F>C[<channels>]".
inline Layout opencv_layout(std::string_view encoding) {
  Layout layout;
  for (const std::string_view bits : {"8", "16", "32", "64"}) {
    if (encoding.substr(0, bits.size()) == bits) {
      encoding.remove_prefix(bits.size());
      layout.bits = std::stoi(std::string(bits));
      break;
    }
  }
  if (layout.bits == 0 || encoding.size() < 2 || std::string_view("USF").find(encoding[0]) == std::string_view::npos ||
      encoding[1] != 'C' || encoding.size() > 2 + 9) {
    return {};
  }
  encoding.remove_prefix(2);
  for (const char digit : encoding) {
    if (std::isdigit(static_cast<unsigned char>(digit)) == 0) {
      return {};
    }
  }
  layout.channels = encoding.empty() ? 1 : std::stoi(std::string(encoding));
  return layout;
}

// Throws std::runtime_error when there is no such encoding.
inline Layout layout(const std::string& encoding) {
  struct Named {
    std::string_view name;
    Layout layout;
  };
  static constexpr std::array<Named, 24> kNamed = {{
      {MONO8, {1, 8}},         {MONO16, {1, 16}},       {RGB8, {3, 8}},          {BGR8, {3, 8}},
      {RGB16, {3, 16}},        {BGR16, {3, 16}},        {RGBA8, {4, 8}},         {BGRA8, {4, 8}},
      {RGBA16, {4, 16}},       {BGRA16, {4, 16}},       {BAYER_RGGB8, {1, 8}},   {BAYER_BGGR8, {1, 8}},
      {BAYER_GBRG8, {1, 8}},   {BAYER_GRBG8, {1, 8}},   {BAYER_RGGB16, {1, 16}}, {BAYER_BGGR16, {1, 16}},
      {BAYER_GBRG16, {1, 16}}, {BAYER_GRBG16, {1, 16}}, {UYVY, {2, 8}},          {YUV422, {2, 8}},
      {YUYV, {2, 8}},          {YUV422_YUY2, {2, 8}},   {NV21, {2, 8}},          {NV24, {2, 8}},
  }};
  for (const Named& named : kNamed) {
    if (named.name == encoding) {
      return named.layout;
    }
  }
  const Layout of_opencv = opencv_layout(encoding);
  if (of_opencv.bits == 0) {
    throw std::runtime_error("Unknown encoding " + encoding);
  }
  return of_opencv;
}

inline bool is_one_of(const std::string& encoding, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) {
    if (encoding == name) {
      return true;
    }
  }
  return false;
}

}  // namespace detail

inline bool isColor(const std::string& encoding) {
  return detail::is_one_of(encoding, {RGB8, BGR8, RGBA8, BGRA8, RGB16, BGR16, RGBA16, BGRA16, NV21, NV24});
}

inline bool isMono(const std::string& encoding) {
  return detail::is_one_of(encoding, {MONO8, MONO16});
}

inline bool isBayer(const std::string& encoding) {
  return encoding.rfind("bayer_", 0) == 0 && detail::layout(encoding).channels == 1;
}

inline bool hasAlpha(const std::string& encoding) {
  return detail::is_one_of(encoding, {RGBA8, BGRA8, RGBA16, BGRA16});
}

// The number of values for each pixel. Throws std::runtime_error when there is no such encoding.
inline int numChannels(const std::string& encoding) {
  return detail::layout(encoding).channels;
}

// The bits of each value. Throws std::runtime_error when there is no such encoding.
inline int bitDepth(const std::string& encoding) {
  return detail::layout(encoding).bits;
}

}  // namespace image_encodings
}  // namespace sensor_msgs
