// SPDX-License-Identifier: Apache-2.0
#include "programs/serve/access.hpp"

#include <gtest/gtest.h>

#include <set>

namespace {

using namespace launch::serve;
using Verdict = Access::Verdict;
using Time = std::chrono::steady_clock::time_point;

const std::string kToken = "a-token-that-nobody-guesses";

class AccessTest : public testing::Test {
 protected:
  Access access_{{.token = kToken, .hosts = {"robot", "robot.example"}, .tls = false, .allow_control = false},
                 [this] { return now_; }};
  Time now_{};

  static HttpRequest get(const std::map<std::string, std::string>& header = {}) {
    HttpRequest request;
    request.method = "GET";
    request.path = "/api/launches";
    request.header = {{"host", "127.0.0.1:7411"}};
    for (const auto& [name, value] : header) {
      request.header[name] = value;
    }
    return request;
  }
  static HttpRequest bearing(const std::string& token) { return get({{"authorization", "Bearer " + token}}); }
  static HttpRequest with_session(const std::string& session, const std::string& method = "GET",
                                  const std::string& origin = "") {
    HttpRequest request = get();
    request.method = method;
    request.cookies["launch-7411"] = session;
    if (!origin.empty()) {
      request.header["origin"] = origin;
    }
    return request;
  }
};

TEST(ConstantTimeTest, ComparesWhole) {
  EXPECT_TRUE(equal_in_constant_time("secret", "secret"));
  for (const char* const other : {"", "secre", "secrets", "Secret", "secreu", "secretsecret"}) {
    EXPECT_FALSE(equal_in_constant_time(other, "secret")) << other;
  }
  EXPECT_FALSE(equal_in_constant_time("", "")) << "no secret is no permission";
}

TEST(RandomTextTest, IsNeverTheSame) {
  std::set<std::string> texts;
  for (int i = 0; i < 100; ++i) {
    texts.insert(random_text(32));
  }
  EXPECT_EQ(texts.size(), 100U);
  EXPECT_EQ(texts.begin()->size(), 64U);
}

TEST(HostTest, HasAPortOrNone) {
  EXPECT_EQ(host_without_port("robot"), "robot");
  EXPECT_EQ(host_without_port("robot:7411"), "robot");
  EXPECT_EQ(host_without_port("[::1]:7411"), "::1");
  EXPECT_EQ(host_without_port("[::1]"), "::1");
  for (const char* const wrong : {"", ":80", "robot:", "robot:x", "robot:80:90", "[::1", "[::1]x", "::1", "[]"}) {
    EXPECT_EQ(host_without_port(wrong), "") << wrong;
  }
  EXPECT_TRUE(is_ip_address("192.168.1.5"));
  EXPECT_TRUE(is_ip_address("fe80::1"));
  EXPECT_FALSE(is_ip_address("1.2.3.4.example"));
  EXPECT_FALSE(is_ip_address("0x7f000001"));
}

TEST_F(AccessTest, TheTokenIsNeeded) {
  EXPECT_EQ(access_.judge(get()), Verdict::kUnknown);
  EXPECT_EQ(access_.judge(bearing(kToken)), Verdict::kAllowed);
  EXPECT_EQ(access_.judge(bearing(kToken + "x")), Verdict::kUnknown);
  EXPECT_EQ(access_.judge(bearing("")), Verdict::kUnknown);
  EXPECT_EQ(access_.judge(get({{"authorization", "Basic " + kToken}})), Verdict::kUnknown);
  HttpRequest in_address = get();
  in_address.query["token"] = kToken;
  EXPECT_EQ(access_.judge(in_address), Verdict::kUnknown) << "addresses are logged";
}

TEST_F(AccessTest, ForeignHostsAreRefusedWhateverTheyKnow) {
  for (const char* const own : {"127.0.0.1:7411", "localhost:7411", "LOCALHOST", "[::1]:7411", "192.168.1.5:7411",
                                "robot", "Robot.example:7411"}) {
    HttpRequest request = bearing(kToken);
    request.header["host"] = own;
    EXPECT_EQ(access_.judge(request), Verdict::kAllowed) << own;
  }
  for (const char* const foreign : {"", "evil.example", "evil.example:7411", "localhost.evil.example", "robot.evil"}) {
    HttpRequest request = bearing(kToken);
    request.header["host"] = foreign;
    EXPECT_EQ(access_.judge(request), Verdict::kForeignHost) << foreign;
    EXPECT_EQ(access_.judge_login(request), Verdict::kForeignHost) << foreign;
  }
  HttpRequest twice = bearing(kToken);
  twice.ambiguous_head = true;
  EXPECT_EQ(access_.judge(twice), Verdict::kAmbiguous);
}

TEST_F(AccessTest, ForeignPagesAreRefused) {
  for (const char* const foreign : {"http://evil.example", "https://127.0.0.1:7411", "http://127.0.0.1:80",
                                    "http://127.0.0.1", "null", "http://localhost:7411"}) {
    HttpRequest request = bearing(kToken);
    request.header["origin"] = foreign;
    EXPECT_EQ(access_.judge(request), Verdict::kForeignOrigin) << foreign;
    EXPECT_EQ(access_.judge_login(request), Verdict::kForeignOrigin) << foreign;
  }
  HttpRequest own = bearing(kToken);
  own.header["origin"] = "http://127.0.0.1:7411";
  EXPECT_EQ(access_.judge(own), Verdict::kAllowed);
}

TEST_F(AccessTest, ACookieChangesSomethingForItsOwnPageOnly) {
  const std::string session = access_.log_in(kToken);
  ASSERT_EQ(session.size(), 64U);
  EXPECT_EQ(access_.judge(with_session(session)), Verdict::kAllowed);
  EXPECT_EQ(access_.judge(with_session(session, "POST")), Verdict::kForeignOrigin) << "a browser would say the origin";
  EXPECT_EQ(access_.judge(with_session(session, "POST", "http://127.0.0.1:7411")), Verdict::kAllowed);
  HttpRequest from_elsewhere = with_session(session, "POST", "http://127.0.0.1:7411");
  from_elsewhere.header["sec-fetch-site"] = "cross-site";
  EXPECT_EQ(access_.judge(from_elsewhere), Verdict::kForeignOrigin);
  from_elsewhere.header["sec-fetch-site"] = "same-site";
  EXPECT_EQ(access_.judge(from_elsewhere), Verdict::kForeignOrigin) << "another port of this machine is another page";
}

TEST_F(AccessTest, ASessionIsNotTheTokenAndEnds) {
  EXPECT_EQ(access_.log_in("wrong"), "");
  EXPECT_EQ(access_.log_in(""), "");
  EXPECT_EQ(access_.judge(with_session(kToken)), Verdict::kUnknown);
  EXPECT_EQ(access_.judge(with_session("")), Verdict::kUnknown);

  const std::string session = access_.log_in(kToken);
  EXPECT_EQ(access_.judge(bearing(session)), Verdict::kUnknown);
  EXPECT_TRUE(access_.is_known(with_session(session)));
  access_.log_out(with_session(session));
  EXPECT_FALSE(access_.is_known(with_session(session)));
  EXPECT_EQ(access_.judge(with_session(session)), Verdict::kUnknown);

  const std::string late = access_.log_in(kToken);
  now_ += Access::kSession - std::chrono::seconds(1);
  EXPECT_TRUE(access_.is_known(with_session(late)));
  now_ += std::chrono::seconds(1);
  EXPECT_FALSE(access_.is_known(with_session(late)));
}

TEST_F(AccessTest, TheOldestSessionEndsWhenThereAreTooMany) {
  const std::string first = access_.log_in(kToken);
  const std::string second = access_.log_in(kToken);
  for (std::size_t i = 2; i < Access::kMostSessions; ++i) {
    access_.log_in(kToken);
  }
  EXPECT_TRUE(access_.is_known(with_session(first)));
  access_.log_in(kToken);
  EXPECT_FALSE(access_.is_known(with_session(first)));
  EXPECT_TRUE(access_.is_known(with_session(second)));
}

TEST_F(AccessTest, CookiesAreForThisServiceAlone) {
  HttpRequest request = get();
  EXPECT_EQ(access_.cookie_text(request, "abc"), "launch-7411=abc; Path=/; HttpOnly; SameSite=Strict");
  EXPECT_EQ(access_.cookie_text(request, ""), "launch-7411=; Path=/; HttpOnly; SameSite=Strict; Max-Age=0");
  request.header["host"] = "[::1]";
  EXPECT_EQ(access_.cookie_name(request), "launch-80");
  Access with_tls({.token = kToken, .hosts = {}, .tls = true, .allow_control = true});
  EXPECT_EQ(with_tls.cookie_text(request, "abc"), "launch-443=abc; Path=/; HttpOnly; SameSite=Strict; Secure");
  HttpRequest plain_origin = bearing(kToken);
  plain_origin.header["origin"] = "http://127.0.0.1:7411";
  EXPECT_EQ(with_tls.judge(plain_origin), Verdict::kForeignOrigin);
}

}  // namespace
