// SPDX-License-Identifier: Apache-2.0
#include "programs/serve/serve_options.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

namespace {

using namespace launch::serve;
namespace fs = std::filesystem;

class TokenTest : public testing::Test {
 protected:
  TokenTest() {
    std::string name = (fs::temp_directory_path() / "token-XXXXXX").string();
    directory_ = ::mkdtemp(name.data());
    path_ = (directory_ / "token").string();
  }
  ~TokenTest() override { fs::remove_all(directory_); }
  TokenTest(const TokenTest&) = delete;
  TokenTest& operator=(const TokenTest&) = delete;

  void write(const std::string& text, mode_t mode = 0600) const {
    std::ofstream(path_) << text;
    ::chmod(path_.c_str(), mode);
  }
  // "what; help"
  std::string error() const {
    try {
      read_token(path_);
      return "";
    } catch (const ServeError& error) {
      return std::string(error.what()) + "; " + error.help();
    }
  }

  fs::path directory_;
  std::string path_;
};

TEST_F(TokenTest, IsTheTextOfTheFile) {
  write("  0123456789abcdef\r\n");
  EXPECT_EQ(read_token(path_), "0123456789abcdef");
}

TEST_F(TokenTest, AFileThatIsNotThereCanBeMade) {
  EXPECT_EQ(error(), "can't read the token file '" + path_ + "': No such file or directory; (umask 077; head -c 24 " +
                         "/dev/urandom | base64 > " + path_ + ")");
}

TEST_F(TokenTest, NobodyElseMayReadIt) {
  for (const mode_t mode : {0640, 0604, 0620, 0602}) {
    write("0123456789abcdef", mode);
    EXPECT_EQ(error(), "others than its user may read or change the token file '" + path_ + "'; chmod 600 " + path_ +
                           ", if nobody has read it so far");
  }
}

TEST_F(TokenTest, NobodyGuessesIt) {
  write("secret\n");
  EXPECT_EQ(error(), "the token in '" + path_ + "' has 6 characters, and 16 are the least; (umask 077; head -c 24 " +
                         "/dev/urandom | base64 > " + path_ + ")");
  write("0123456789 abcdef\n");
  EXPECT_EQ(error().substr(0, error().find(';')), "the token in '" + path_ + "' has blanks or several lines");
  path_ = directory_.string();
  EXPECT_EQ(error(), "the token file '" + path_ + "' is no file; ");
}

TEST(ListenAddressTest, IsANumberAndAPort) {
  EXPECT_TRUE(parse_listen_address("127.0.0.1:7411").is_loopback);
  EXPECT_TRUE(parse_listen_address("127.1.2.3:0").is_loopback);
  EXPECT_TRUE(parse_listen_address("localhost:7411").is_loopback);
  EXPECT_TRUE(parse_listen_address(":7411").is_loopback);
  EXPECT_TRUE(parse_listen_address("[::1]:7411").is_loopback);
  EXPECT_FALSE(parse_listen_address("0.0.0.0:7411").is_loopback);
  EXPECT_FALSE(parse_listen_address("[::]:7411").is_loopback);
  EXPECT_FALSE(parse_listen_address("192.168.1.5:65535").is_loopback);
  for (const char* const wrong : {"", "7411", "127.0.0.1", "127.0.0.1:", "127.0.0.1:x", "127.0.0.1:65536",
                                  "127.0.0.1:-1", "robot:7411", "::1:7411", "[::1]7411", "[]:1", "[127.0.0.1]:1"}) {
    EXPECT_THROW(parse_listen_address(wrong), ServeError) << wrong;
  }
}

TEST(ExposureTest, OtherMachinesNeedTls) {
  ServeOptions options;
  options.listen = "0.0.0.0:7411";
  const ListenAddress everywhere = parse_listen_address(options.listen);
  try {
    check_exposure(options, everywhere);
    FAIL();
  } catch (const ServeError& error) {
    EXPECT_STREQ(error.what(), "does not listen on 0.0.0.0:7411 without TLS: others could read the token");
    EXPECT_EQ(error.help(),
              "give --tls-cert and --tls-key, reach 127.0.0.1 through 'ssh -L', or say --insecure on a "
              "network of your own");
  }
  EXPECT_NO_THROW(check_exposure(options, parse_listen_address("127.0.0.1:7411")));
  options.insecure = true;
  EXPECT_NO_THROW(check_exposure(options, everywhere));
  options.insecure = false;
  options.tls_certificate = "robot.pem";
  EXPECT_NO_THROW(check_exposure(options, everywhere));
}

}  // namespace
