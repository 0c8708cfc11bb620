// Pages at an address of this machine that nobody else can ask for: it listens on the loopback interface alone, and
// answers GET and HEAD of browsers that name it by a loopback name and show its own pages. Another site whose name
// leads to 127.0.0.1 is told by the Host header, one that asks in the back of its reader by Origin and Sec-Fetch-Site.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

namespace gamut {

/// No address to listen at; what() says why.
class NoAddress : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What is sent of one path.
struct Reply {
  std::shared_ptr<const std::string> body;  ///< null: there is no such path
  std::string type = "text/html; charset=utf-8";
  std::string policy;  ///< Content-Security-Policy
};

/// One thread serves all: a request has some seconds and 8 kB in all, a body is refused, and where many connections are
/// open the oldest goes.
class PageServer {
 public:
  /// Of a path without its query, by the thread that serves.
  using Answer = std::function<Reply(std::string_view path)>;

  /// Listens at 127.0.0.1, and at ::1 if it can; `port` 0: one that is free. Throws NoAddress.
  PageServer(std::uint16_t port, Answer answer);
  ~PageServer();
  PageServer(const PageServer&) = delete;
  PageServer& operator=(const PageServer&) = delete;

  std::uint16_t port() const;
  /// Answers whoever asks in so long a time.
  void serve(std::chrono::milliseconds span);

 private:
  class Listener;
  std::unique_ptr<Listener> listener_;
};

}  // namespace gamut
