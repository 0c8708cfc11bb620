// A real browser that a test asks what became of a page. It answers when the page is done, however long that takes: it
// is spoken to by the DevTools protocol over a pipe (https://chromedevtools.github.io/devtools-protocol/), and what is
// waited for is a condition in the page, never a time.
#pragma once

#include <sys/types.h>

#include <string>

#include "tests/studies/temporary_folder.hpp"

namespace gamut {

class Chromium {
 public:
  static bool isInstalled();

  /// So many pixels of a page are seen, on a screen or as on paper, by a reader who prefers the dark or does not, and
  /// who tells red from green or, as one man in a hundred, does not.
  struct Screen {
    int width = 800, height = 600;
    bool isDark = false, isPaper = false, isDeuteranopic = false;
  };
  Chromium();
  ~Chromium();
  Chromium(const Chromium&) = delete;
  Chromium& operator=(const Chromium&) = delete;

  /// The text that an asynchronous function finds in this page; its body is `script`, which may wait. The page is
  /// opened when it begins, and closed when it ends; whether its own scripts are done is for it to await.
  std::string found(const std::string& page, const std::string& script, const Screen& screen);
  /// CPU time, s, that the page's own thread has taken until it is loaded, laid out and painted.
  double cpuToOpen(const std::string& page, const Screen& screen);
  /// What is seen once such a script has ended: a PNG.
  std::string picture(const std::string& page, const std::string& script, const Screen& screen);

 private:
  /// A page that is open.
  struct Tab {
    std::string target, session;
  };
  Tab opened(const std::string& page, const Screen& screen, bool isPicture = false);
  std::string ranIn(const Tab& tab, const std::string& script);
  void close(const Tab& tab);
  /// The answer to a command; all as JSON.
  std::string asked(const std::string& method, const std::string& parameters, const std::string& session = "");
  void send(std::string message) const;
  std::string received();

  TemporaryFolder folder_;
  pid_t process_ = 0;
  int to_ = -1, from_ = -1;
  int asked_ = 0;
  std::string unread_;
};

}  // namespace gamut
