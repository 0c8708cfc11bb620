#include "tests/reports/chromium.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>

namespace gamut {
namespace {

using nlohmann::json;

/// Both ends are closed in programs that are started, but for the copies that they are given.
std::array<int, 2> pipeEnds() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  return ends;
}

std::string fromBase64(const std::string& text) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned held = 0;
  int bits = 0;
  for (const char c : text) {
    const auto digit = digits.find(c);
    if (digit == digits.npos) break;  // at the end
    held = (held << 6U | static_cast<unsigned>(digit)) & 0xffffU;
    if ((bits += 6) < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(held >> static_cast<unsigned>(bits) & 0xffU);
  }
  return bytes;
}

}  // namespace

bool Chromium::isInstalled() { return std::system("command -v chromium > /dev/null") == 0; }

Chromium::Chromium() {
  const std::array<int, 2> commands = pipeEnds(), answers = pipeEnds();
  const std::string profile = "--user-data-dir=" + folder_.path("profile"), log = folder_.path("log");
  process_ = ::fork();
  if (process_ == 0) {
    // It reads from 3 and writes to 4, which may be ends of the pipes themselves.
    const int reading = ::fcntl(commands[0], F_DUPFD, 10), writing = ::fcntl(answers[1], F_DUPFD, 10);
    ::dup2(reading, 3);
    ::dup2(writing, 4);
    ::close(reading);
    ::close(writing);
    if (::freopen(log.c_str(), "w", stderr) == nullptr || ::freopen("/dev/null", "w", stdout) == nullptr) ::_exit(99);
    ::execlp("chromium", "chromium", "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
             "--disable-background-networking", "--disable-component-update", "--disable-sync",
             "--remote-debugging-pipe", profile.c_str(), nullptr);
    ::_exit(98);
  }
  ::close(commands[0]);
  ::close(answers[1]);
  to_ = commands[1];
  from_ = answers[0];
  ::signal(SIGPIPE, SIG_IGN);  // a browser that has died is told of by its missing answer
}

Chromium::~Chromium() {
  try {
    asked("Browser.close", "{}");
  } catch (const std::exception&) {
    ::kill(process_, SIGKILL);
  }
  ::close(to_);
  ::close(from_);
  ::waitpid(process_, nullptr, 0);
}

std::string Chromium::found(const std::string& page, const std::string& script, const Screen& screen) {
  const Tab tab = opened(page, screen);
  std::string text = ranIn(tab, script);
  close(tab);
  return text;
}

double Chromium::cpuToOpen(const std::string& page, const Screen& screen) {
  const Tab tab = opened(page, screen);
  ranIn(tab,
        "await new Promise(then => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(then, 0))));"
        "return '';");
  const json told = json::parse(asked("Performance.getMetrics", "{}", tab.session));
  close(tab);
  for (const json& metric : told["result"]["metrics"])
    if (metric["name"] == "TaskDuration") return metric["value"];
  throw std::runtime_error("the browser does not say what a page takes: " + told.dump());
}

std::string Chromium::picture(const std::string& page, const std::string& script, const Screen& screen) {
  const Tab tab = opened(page, screen, true);
  ranIn(tab, script + "; return '';");
  const json seen = json::parse(asked("Page.captureScreenshot", json{{"format", "png"}}.dump(), tab.session));
  close(tab);
  return fromBase64(seen["result"]["data"].get<std::string>());
}

/// The page comes last, so that it is laid out on this screen from the beginning.
Chromium::Tab Chromium::opened(const std::string& page, const Screen& screen, bool isPicture) {
  const json target = json::parse(asked("Target.createTarget", R"({"url": "about:blank"})"));
  const std::string id = target["result"]["targetId"];
  const json attached = json::parse(asked("Target.attachToTarget", json{{"targetId", id}, {"flatten", true}}.dump()));
  const std::string session = attached["result"]["sessionId"];
  asked("Emulation.setDeviceMetricsOverride",
        json{{"width", screen.width}, {"height", screen.height}, {"deviceScaleFactor", 1}, {"mobile", false}}.dump(),
        session);
  const json scheme{{"name", "prefers-color-scheme"}, {"value", screen.isDark ? "dark" : "light"}};
  asked("Emulation.setEmulatedMedia",
        json{{"media", screen.isPaper ? "print" : "screen"}, {"features", json::array({scheme})}}.dump(), session);
  asked("Emulation.setEmulatedVisionDeficiency", json{{"type", screen.isDeuteranopic ? "deuteranopia" : "none"}}.dump(),
        session);
  if (isPicture) asked("Emulation.setScrollbarsHidden", R"({"hidden": true})", session);  // they tell how long it is
  asked("Performance.enable", R"({"timeDomain": "threadTicks"})", session);
  asked("Page.navigate", json{{"url", "file://" + page}}.dump(), session);
  return {id, session};
}

std::string Chromium::ranIn(const Tab& tab, const std::string& script) {
  // The target is empty until the page is there; what runs in it until then is lost with it.
  const std::string whole =
      "location.protocol !== 'file:' ? null : (async () => { if (document.readyState !== 'complete') "
      "await new Promise(then => addEventListener('load', then)); " +
      script + " })()";
  const std::string evaluated = json{{"expression", whole}, {"awaitPromise", true}, {"returnByValue", true}}.dump();
  for (;;) {
    const json said = json::parse(asked("Runtime.evaluate", evaluated, tab.session));
    if (!said.contains("result")) continue;
    const json& result = said["result"];
    if (result.contains("exceptionDetails")) throw std::runtime_error(result["exceptionDetails"].dump());
    if (const json& found = result["result"]; found.contains("value") && found["value"].is_string())
      return found["value"];
  }
}

void Chromium::close(const Tab& tab) { asked("Target.closeTarget", json{{"targetId", tab.target}}.dump()); }

std::string Chromium::asked(const std::string& method, const std::string& parameters, const std::string& session) {
  json message{{"id", ++asked_}, {"method", method}, {"params", json::parse(parameters)}};
  if (!session.empty()) message["sessionId"] = session;
  send(message.dump());
  for (;;) {  // events come between
    std::string text = received();
    if (json::parse(text).value("id", 0) == asked_) return text;
  }
}

/// Messages end with a zero.
void Chromium::send(std::string message) const {
  message += '\0';
  for (std::size_t done = 0; done < message.size();) {
    const ssize_t n = ::write(to_, message.data() + done, message.size() - done);
    if (n <= 0) throw std::runtime_error("the browser does not listen; its log: " + folder_.read("log"));
    done += static_cast<std::size_t>(n);
  }
}

std::string Chromium::received() {
  std::array<char, 65536> part{};
  for (std::size_t searched = 0;;) {
    if (const auto end = unread_.find('\0', searched); end != std::string::npos) {
      std::string message = unread_.substr(0, end);
      unread_.erase(0, end + 1);
      return message;
    }
    searched = unread_.size();
    const ssize_t n = ::read(from_, part.data(), part.size());
    if (n <= 0) throw std::runtime_error("the browser has gone; its log: " + folder_.read("log"));
    unread_.append(part.data(), static_cast<std::size_t>(n));
  }
}

}  // namespace gamut
