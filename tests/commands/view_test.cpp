// The page of a study at a local address: it follows what is saved, and is for nobody but this machine.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "commands/watched_files.hpp"
#include "studies/results/results_file.hpp"
#include "tests/commands/program.hpp"
#include "tests/commands/started_program.hpp"
#include "tests/studies/sample_study.hpp"

namespace gamut::view_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using Json = nlohmann::json;

constexpr Seconds patience{60}, promptly{2};

/// A connection to the loopback interface, as a browser opens one.
class Connection {
 public:
  explicit Connection(int port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    isOpen_ = ::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
  }
  ~Connection() { ::close(socket_); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  bool isOpen() const { return isOpen_; }
  /// As much of it as is taken.
  void send(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (sent <= 0) return;
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
  }
  /// Says nothing more, but listens.
  void halfClose() const { ::shutdown(socket_, SHUT_WR); }
  /// All that comes until the other end closes it, or time is up.
  std::string receive(Seconds most) const {
    std::string text;
    const auto until = std::chrono::steady_clock::now() + most;
    for (;;) {
      const Seconds left = until - std::chrono::steady_clock::now();
      pollfd waited{socket_, POLLIN, 0};
      if (left.count() <= 0 || ::poll(&waited, 1, static_cast<int>(1000 * left.count()) + 1) <= 0) return text;
      char block[65536];
      const ssize_t count = ::recv(socket_, block, sizeof block, 0);
      if (count <= 0) return text;
      text.append(block, static_cast<std::size_t>(count));
    }
  }

 private:
  int socket_;
  bool isOpen_ = false;
};

class View : public FromOutside {
 protected:
  void start(const std::vector<std::string>& more = {}) {
    std::filesystem::remove(folder_.path("out"));  // of one before
    std::vector<std::string> words{"view", "s.toml"};
    words.insert(words.end(), more.begin(), more.end());
    view_ = std::make_unique<StartedProgram>(folder_, words, folder_.path("out"), folder_.path("err"));
    const std::string before = "http://127.0.0.1:";
    view_->await([&] { return folder_.read("out").find('\n') != std::string::npos; });
    ASSERT_THAT(folder_.read("out"), StartsWith(before)) << folder_.read("err");
    port_ = std::stoi(folder_.read("out").substr(before.size()));
  }

  std::string host() const { return "127.0.0.1:" + std::to_string(port_); }
  std::string said(const std::string& request, Seconds most = patience) const {
    const Connection connection(port_);
    connection.send(request);
    return connection.receive(most);
  }
  std::string got(const std::string& path, const std::string& headers = "", Seconds most = patience) const {
    return said("GET " + path + " HTTP/1.1\r\nHost: " + host() + "\r\n" + headers + "\r\n", most);
  }
  static std::string bodyOf(const std::string& answer) {
    const std::size_t end = answer.find("\r\n\r\n");
    return end == std::string::npos ? "" : answer.substr(end + 4);
  }
  std::string report() const { return bodyOf(got("/report")); }
  Json state() const { return Json::parse(bodyOf(got("/state")), nullptr, false); }
  /// The state as soon as it is so; null if it does not become so.
  template <class Is>
  Json stateThat(const Is& isSo) const {
    const auto until = std::chrono::steady_clock::now() + patience;
    while (std::chrono::steady_clock::now() < until) {
      if (const Json now = state(); now.is_object() && isSo(now)) return now;
      std::this_thread::sleep_for(Seconds(0.02));
    }
    return {};
  }
  Json wholePage(int number) const {
    return stateThat([&](const Json& s) { return s["whole"] == true && s["running"] == false && s["page"] >= number; });
  }
  Json fault() const {
    return stateThat([](const Json& s) { return s["fault"] != ""; });
  }
  bool isServed() const { return got("/", "", promptly).starts_with("HTTP/1.1 200 OK\r\n"); }

  std::unique_ptr<StartedProgram> view_;
  int port_ = 0;
};

std::string unending() { return sampleStudyWith("samples = 16", "samples = 10000000"); }

TEST_F(View, ShowsTheReportThatARunWouldWrite) {
  folder_.write("s.toml", sampleStudy);
  start();
  EXPECT_THAT(got("/"), AllOf(StartsWith("HTTP/1.1 200 OK\r\n"), HasSubstr("frame-ancestors 'none'"),
                              HasSubstr("X-Content-Type-Options: nosniff"), HasSubstr("fetch(\"/state\"")));
  const Json whole = wholePage(1);
  ASSERT_TRUE(whole.is_object()) << state() << folder_.read("err");
  EXPECT_EQ(whole["fault"], "");
  EXPECT_THAT(report(), AllOf(HasSubstr("data-run=\"whole\""), HasSubstr("<h1>Pendulum</h1>"),
                              HasSubstr("stays between"), ::testing::EndsWith("</html>\n")));
  EXPECT_EQ(bodyOf(said("HEAD /report HTTP/1.1\r\nHost: " + host() + "\r\n\r\n")), "");
  EXPECT_EQ(got("/report?7").substr(0, 15), "HTTP/1.1 200 OK");
  EXPECT_EQ(folder_.count(), 3U) << "study, out and err: no file is written";
}

/// Of a hundred and more none is answered by more than a refusal, and it goes on answering others.
TEST_F(View, ServesNoHostileRequest) {
  folder_.write("s.toml", sampleStudy);
  start();
  ASSERT_TRUE(wholePage(1).is_object());
  const std::string port = std::to_string(port_), get = "GET / HTTP/1.1\r\n", own = "Host: " + host() + "\r\n";
  std::vector<std::string> requests;
  for (const std::string& name : std::vector<std::string>{"evil.example",
                                                          "evil.example:" + port,
                                                          "127.0.0.1",
                                                          "localhost",
                                                          "127.0.0.1:1",
                                                          "127.0.0.2:" + port,
                                                          "0.0.0.0:" + port,
                                                          "[::]:" + port,
                                                          "::1:" + port,
                                                          "localhost.evil.example:" + port,
                                                          "127.0.0.1." + port,
                                                          "evil@127.0.0.1:" + port,
                                                          "127.0.0.1:" + port + "@evil",
                                                          "127.0.0.1:" + port + "0",
                                                          "127.0.0.1:0" + port,
                                                          "127.1:" + port,
                                                          "2130706433:" + port,
                                                          "0x7f.1:" + port,
                                                          "localhost.:" + port,
                                                          "xlocalhost:" + port,
                                                          std::string(),
                                                          std::string(":") + port,
                                                          "127.0.0.1:" + port + ", evil",
                                                          "http://127.0.0.1:" + port})
    requests.push_back(get + "Host: " + name + "\r\n\r\n");
  requests.push_back(get + "\r\n");
  requests.push_back(get + own + own + "\r\n");
  requests.push_back(get + own + "Host: evil.example\r\n\r\n");
  for (const std::string& origin : std::vector<std::string>{
           "http://evil.example", "http://evil.example:" + port, std::string("null"), "https://127.0.0.1:" + port,
           std::string("http://127.0.0.1"), "http://127.0.0.1:" + port + ".evil", "file://",
           "http://127.0.0.1:" + port + "/", "http://localhost:" + port + " http://evil.example",
           "chrome-extension://abc", "http://0.0.0.0:" + port, std::string(), "127.0.0.1:" + port,
           "http://[::ffff:127.0.0.1]:" + port})
    requests.push_back(get + own + "Origin: " + origin + "\r\n\r\n");
  requests.push_back(get + own + "Origin: http://" + host() + "\r\nOrigin: http://evil.example\r\n\r\n");
  for (const char* site : {"cross-site", "same-site", "", "NONE", "none, cross-site"})
    requests.push_back(get + own + "Sec-Fetch-Site: " + site + "\r\n\r\n");
  for (const char* path : {"/../s.toml",
                           "/s.toml",
                           "/%2e%2e/s.toml",
                           "/%2e%2e%2fs.toml",
                           "/..%2fs.toml",
                           "/..\\s.toml",
                           "/%5c..%5cs.toml",
                           "//etc/passwd",
                           "/etc/passwd",
                           "/report/",
                           "/report/../state",
                           "/./",
                           "/%2f",
                           "/report%00",
                           "/REPORT",
                           "/state.json",
                           "/favicon.ico",
                           "/.git/config",
                           "/%",
                           "/%zz",
                           "/%c0%ae%c0%ae/s.toml",
                           "/report;a=b",
                           "/~root",
                           "/;/",
                           "/report#state",
                           "/\x7f",
                           "/\xff\xfe"})
    requests.push_back(std::string("GET ") + path + " HTTP/1.1\r\n" + own + "\r\n");
  for (const std::string& target : {std::string("*"), "http://" + host() + "/", std::string("evil.example:80"),
                                    std::string("report"), std::string("?"), std::string("http://evil.example/")})
    requests.push_back("GET " + target + " HTTP/1.1\r\n" + own + "\r\n");
  for (const char* method : {"POST", "PUT", "DELETE", "PATCH", "OPTIONS", "TRACE", "CONNECT", "PROPFIND", "get", "G\tT",
                             "VERYLONGMETHODTHATNOBODYKNOWS"})
    requests.push_back(std::string(method) + " / HTTP/1.1\r\n" + own + "\r\n");
  for (const std::string& rest :
       {std::string("Content-Length: 5\r\n\r\nhello"), std::string("Content-Length: -1\r\n\r\n"),
        std::string("Content-Length: 99999999999999999999\r\n\r\n"),
        std::string("Transfer-Encoding: chunked\r\n\r\n5\r\nhello\r\n0\r\n\r\n"),
        std::string("Content-Length: 0\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n"),
        "Content-Length: 1000000\r\n\r\n" + std::string(1000000, 'x'), "X: " + std::string(100000, 'x') + "\r\n\r\n",
        [] {
          std::string many;
          for (int i = 0; i < 20000; ++i) many += "X" + std::to_string(i) + ": y\r\n";
          return many + "\r\n";
        }(),
        std::string(" folded\r\n\r\n"), std::string("No colon\r\n\r\n"), std::string(": no name\r\n\r\n"),
        std::string("X: \0\r\n\r\n", 9), std::string("X y: z\r\n\r\n")})
    requests.push_back(get + own + rest);
  for (const std::string& text : {std::string("\r\n\r\n"), std::string("GET\r\n\r\n"), std::string("GET /\r\n\r\n"),
                                  "GET / HTTP/9.9\r\n" + own + "\r\n", "GET / HTTP/1.1 x\r\n" + own + "\r\n",
                                  "GET  / HTTP/1.1\r\n" + own + "\r\n", std::string(3000000, 'A'),
                                  "GET /" + std::string(100000, 'a') + " HTTP/1.1\r\n" + own + "\r\n",
                                  std::string("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03\r\n\r\n", 15),
                                  std::string("PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n"), std::string(100, '\0') + "\r\n\r\n",
                                  std::string("SSH-2.0-x\r\n\r\n")})
    requests.push_back(text);
  EXPECT_GE(requests.size(), 100U);
  for (const std::string& request : requests) {
    const std::string answer = said(request);
    EXPECT_TRUE(answer.empty() || answer.starts_with("HTTP/1.1 4")) << request.substr(0, 200) << "\n--\n" << answer;
    EXPECT_LT(answer.size(), 1000U) << request.substr(0, 200);
  }
  EXPECT_TRUE(isServed());
  EXPECT_EQ(folder_.read("err"), "");
}

TEST_F(View, RefusesForeignNamesAndSitesAsForbidden) {
  folder_.write("s.toml", sampleStudy);
  start();
  const std::string port = std::to_string(port_), get = "GET /state HTTP/1.1\r\n";
  const auto codeOf = [&](const std::string& headers) { return said(get + headers + "\r\n").substr(0, 12); };
  for (const std::string& name : {"127.0.0.1:" + port, "localhost:" + port, "LocalHost:" + port, "[::1]:" + port}) {
    EXPECT_EQ(codeOf("Host: " + name + "\r\n"), "HTTP/1.1 200") << name;
    EXPECT_EQ(codeOf("Host: " + host() + "\r\nOrigin: http://" + name + "\r\n"), "HTTP/1.1 200") << name;
  }
  EXPECT_EQ(codeOf("Host: " + host() + "\r\nSec-Fetch-Site: same-origin\r\n"), "HTTP/1.1 200");
  EXPECT_EQ(codeOf("Host: evil.example:" + port + "\r\n"), "HTTP/1.1 403");
  EXPECT_EQ(codeOf("Host: " + host() + "\r\nOrigin: http://evil.example\r\n"), "HTTP/1.1 403");
  EXPECT_EQ(codeOf("Host: " + host() + "\r\nSec-Fetch-Site: cross-site\r\n"), "HTTP/1.1 403");
}

TEST_F(View, ListensOnTheLoopbackInterfaceAlone) {
  folder_.write("s.toml", sampleStudy);
  start();
  std::ifstream table("/proc/net/tcp");
  char wanted[32];
  std::snprintf(wanted, sizeof wanted, ":%04X", static_cast<unsigned>(port_));
  int listeners = 0;
  for (std::string line; std::getline(table, line);)
    if (line.find(std::string(wanted) + " 00000000:0000 0A") != std::string::npos) {
      ++listeners;
      EXPECT_THAT(line, HasSubstr(std::string(" 0100007F") + wanted));
    }
  EXPECT_EQ(listeners, 1);
}

/// Some that say half a request, some that never read, some that only listen: more than there may be connections.
TEST_F(View, ASlowOneBlocksNobody) {
  folder_.write("s.toml", sampleStudy);
  start();
  ASSERT_TRUE(wholePage(1).is_object());
  std::vector<std::unique_ptr<Connection>> slow;
  for (int i = 0; i < 150; ++i) {
    slow.push_back(std::make_unique<Connection>(port_));
    const Connection& one = *slow.back();
    if (i % 5 == 1) one.send("GET / HTTP/1.1\r\nHost: ");
    if (i % 5 == 2) one.send("G"), one.halfClose();
    if (i % 5 == 3) one.send("GET /report HTTP/1.1\r\nHost: " + host() + "\r\n\r\n");  // and does not read
    if (i % 5 == 4) one.send("GET /state HTTP/1.1\r\nHost: " + host() + "\r\n\r\n"), one.halfClose();
    if (i % 10 == 9) {
      EXPECT_TRUE(isServed()) << i;
    }
  }
  EXPECT_TRUE(isServed());
  const Connection halfClosed(port_);
  halfClosed.send("GET /state HTTP/1.1\r\nHost: " + host() + "\r\n\r\n");
  halfClosed.halfClose();
  EXPECT_THAT(halfClosed.receive(promptly), StartsWith("HTTP/1.1 200"));
  const Connection silent(port_);
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(silent.receive(Seconds(30)), "");  // until it is closed
  EXPECT_LT(Seconds(std::chrono::steady_clock::now() - begin).count(), 20);
}

TEST_F(View, RunsAgainWhenTheFileIsSavedAndKeepsThePageWhileItIsWrong) {
  folder_.write("s.toml", sampleStudy);
  start();
  const Json first = wholePage(1);
  ASSERT_TRUE(first.is_object());
  folder_.write("s.toml", sampleStudyWith("\"Pendulum\"", "\"Another\""));
  const Json second = wholePage(static_cast<int>(first["page"]) + 1);
  ASSERT_TRUE(second.is_object());
  EXPECT_THAT(report(), HasSubstr("<h1>Another</h1>"));
  folder_.write("s.toml", sampleStudy + "oops\n");
  const Json wrong = fault();
  ASSERT_TRUE(wrong.is_object());
  EXPECT_THAT(std::string(wrong["fault"]), StartsWith("s.toml:"));
  EXPECT_EQ(wrong["page"], second["page"]);
  EXPECT_EQ(wrong["begun"], first["begun"]);
  EXPECT_GT(first["begun"], 0);
  EXPECT_THAT(report(), HasSubstr("<h1>Another</h1>"));
  view_->await([&] { return !folder_.read("err").empty(); });
  EXPECT_EQ(folder_.read("err"), std::string(wrong["fault"]) + "\n");
}

TEST_F(View, FollowsEditorsThatRenameAndFilesThatComeBack) {
  folder_.write("s.toml", sampleStudy);
  start();
  const Json first = wholePage(1);
  ASSERT_TRUE(first.is_object());
  folder_.write("s.toml.new", sampleStudyWith("\"Pendulum\"", "\"Renamed\""));
  std::filesystem::rename(folder_.path("s.toml.new"), folder_.path("s.toml"));
  const Json second = wholePage(static_cast<int>(first["page"]) + 1);
  ASSERT_TRUE(second.is_object());
  EXPECT_THAT(report(), HasSubstr("<h1>Renamed</h1>"));
  std::filesystem::remove(folder_.path("s.toml"));
  const Json gone = fault();
  ASSERT_TRUE(gone.is_object());
  EXPECT_EQ(gone["fault"], "s.toml: does not exist; expected a study file (TOML)");
  EXPECT_THAT(report(), HasSubstr("<h1>Renamed</h1>"));
  folder_.write("s.toml", sampleStudy);
  EXPECT_TRUE(wholePage(static_cast<int>(second["page"]) + 1).is_object());
  EXPECT_THAT(report(), HasSubstr("<h1>Pendulum</h1>"));
}

/// A robot, what it includes, and the meshes of both.
TEST(WatchedFilesOfAStudy, AreThoseThatItsRobotsNameToo) {
  const TemporaryFolder folder;
  folder.write("s.toml", "[mechanism]\nrobot = \"arm.xml\"\n");
  folder.write("arm.xml", "<mujoco><include file=\"hand.xml\"/><mesh file='arm.stl'/></mujoco>");
  folder.write("hand.xml", "<mesh filename=\"package://robots/hand.obj\"/><mesh file=\"far.step\"/>");
  for (const char* name : {"arm.stl", "hand.obj", "far.step"}) folder.write(name, "as it was");
  WatchedFiles files(folder.path("s.toml"));
  const auto isSeen = [&] { return files.haveChanged() || files.haveChanged(); };
  EXPECT_FALSE(isSeen());
  for (const char* name : {"arm.stl", "hand.obj", "hand.xml", "arm.xml", "s.toml"}) {
    folder.write(name, "<another/> of another length" + std::string(name));
    EXPECT_TRUE(isSeen()) << name;
  }
  folder.write("far.step", "which nothing reads");
  EXPECT_FALSE(isSeen());
}

TEST_F(View, FollowsTheTablesThatAStudyNames) {
  folder_.write("s.toml",
                sampleStudyWith("distribution = { type = \"uniform\" }",
                                "distribution = { type = \"empirical\", file = \"angles.csv\", column = \"a\" }"));
  start();
  const Json missing = fault();
  ASSERT_TRUE(missing.is_object());
  EXPECT_THAT(std::string(missing["fault"]), HasSubstr("angles.csv"));
  folder_.write("angles.csv", "a [rad]\n0.52\n0.523\n0.525\n");
  const Json now = stateThat([&](const Json& s) { return s["fault"] != missing["fault"] && s["running"] == false; });
  EXPECT_TRUE(now.is_object());
  EXPECT_EQ(now["fault"], "");
}

TEST_F(View, EndsARunWhoseStudyIsSavedAgain) {
  folder_.write("s.toml", unending());
  start();
  const Json atWork = stateThat([](const Json& s) { return s["task"] == "samples" && s["fraction"] > 0; });
  ASSERT_TRUE(atWork.is_object());
  folder_.write("s.toml", sampleStudyWith("\"Pendulum\"", "\"Short\""));
  EXPECT_TRUE(wholePage(1).is_object());
  EXPECT_THAT(report(), HasSubstr("<h1>Short</h1>"));
}

/// A file that a run had begun to write when it was killed, as atomic_file.cpp calls it.
TEST_F(View, LeavesNothingOfARunThatItEnds) {
  const std::string left = ".kept.h5.gamut-part";
  folder_.write("s.toml", unending());
  start({"-o", "kept.h5"});
  const auto isAtWork = [](const Json& s) { return s["task"] == "samples" && s["fraction"] > 0; };
  ASSERT_TRUE(stateThat(isAtWork).is_object());
  folder_.write(left, "half of the results");
  folder_.write("s.toml", unending() + "\n");
  ASSERT_TRUE(stateThat([&](const Json& s) { return !isAtWork(s); }).is_object());
  ASSERT_TRUE(stateThat(isAtWork).is_object());
  EXPECT_FALSE(folder_.has(left)) << "the next run has written nothing yet";
  folder_.write(left, "half of the results");
  view_->signalAfter(0, SIGTERM);
  EXPECT_EQ(view_->wait(), 0);
  EXPECT_FALSE(folder_.has(left));
}

TEST_F(View, ShowsWhatIsKnownBeforeTheEnd) {
  folder_.write("s.toml", unending());
  start();
  const Json soFar = stateThat([](const Json& s) { return s["page"] > 0; });
  ASSERT_TRUE(soFar.is_object());
  EXPECT_EQ(soFar["whole"], false);
  EXPECT_EQ(soFar["running"], true);
  EXPECT_THAT(report(), HasSubstr("data-run=\"partial\""));
}

TEST_F(View, EndsWithItsTerminalAndSoDoesTheRun) {
  for (const int kind : {SIGINT, SIGTERM, SIGHUP}) {
    folder_.write("s.toml", unending());
    start();
    ASSERT_TRUE(stateThat([](const Json& s) { return s["task"] == "samples"; }).is_object());
    const std::string children =
        "/proc/" + std::to_string(view_->process()) + "/task/" + std::to_string(view_->process()) + "/children";
    std::ifstream list(children);
    pid_t run = 0;
    ASSERT_TRUE(list >> run);
    view_->signalAfter(0, kind);
    EXPECT_EQ(view_->wait(), 0);
    EXPECT_NE(::kill(run, 0), 0) << "the run goes on";
    EXPECT_FALSE(Connection(port_).isOpen());
    EXPECT_EQ(folder_.count(), 3U);
  }
}

TEST_F(View, WritesResultsWhereItIsTold) {
  folder_.write("s.toml", sampleStudy);
  start({"-o", "kept.h5"});
  ASSERT_TRUE(wholePage(1).is_object());
  EXPECT_EQ(readResults(folder_.path("kept.h5")).title, "Pendulum");
  EXPECT_EQ(folder_.read("kept.html"), report());
  folder_.write("s.toml", sampleStudyWith("\"Pendulum\"", "\"Another\""));
  ASSERT_TRUE(wholePage(2).is_object());
  EXPECT_EQ(readResults(folder_.path("kept.h5")).title, "Another");
  const Outcome again = gamut("view s.toml -o kept.h5");
  EXPECT_EQ(again.exitCode, 2);
  EXPECT_THAT(again.error, HasSubstr("kept.h5"));
}

TEST_F(View, RefusesInOneLineWhatItCannotShow) {
  folder_.write("s.toml", sampleStudy);
  start();
  const std::string port = std::to_string(port_);
  const Outcome taken = gamut("view s.toml --port " + port);
  EXPECT_EQ(taken.exitCode, 2);
  EXPECT_EQ(taken.error, "gamut: port " + port + " is in use; expected another --port, or none for one that is free\n");
  EXPECT_EQ(gamut("view none.toml").error, "none.toml: does not exist; expected a study file (TOML)\n");
  EXPECT_EQ(gamut("view - < s.toml").error, "gamut: standard input cannot be watched; expected a study file\n");
  EXPECT_EQ(gamut("view s.toml --port 0").exitCode, 2);
  EXPECT_EQ(gamut("view s.toml --port 65536").exitCode, 2);
  EXPECT_EQ(gamut("view s.toml -o s.toml --force").error, "gamut: s.toml: cannot be written; it is the input\n");
  EXPECT_TRUE(isServed());
}

}  // namespace
}  // namespace gamut::view_test
