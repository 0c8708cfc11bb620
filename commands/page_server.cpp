// Boost.Asio moves the bytes, Boost.Beast reads the requests. Everything is done by the thread that calls serve(): a
// connection that says nothing waits for its deadline, and nobody waits for it.
#include "commands/page_server.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <list>
#include <optional>
#include <utility>

// Boost 1.74 uses what it does not include.
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ip/v6_only.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>

namespace gamut {
namespace {

namespace asio = boost::asio;
namespace http = boost::beast::http;
using boost::system::error_code;
using Tcp = asio::ip::tcp;
using Request = http::request<http::empty_body>;

constexpr std::size_t mostHeaders = 8192;       // bytes of a request
constexpr std::size_t mostConnections = 64;     // that are open
constexpr std::chrono::seconds timeToAsk{5};    // until a request is whole
constexpr std::chrono::seconds timeToTake{60};  // until its answer has been taken

struct Status {
  int code;
  std::string_view reason;
};
constexpr Status fine{200, "OK"}, malformed{400, "Bad Request"}, forbidden{403, "Forbidden"}, unknown{404, "Not Found"},
    notAllowed{405, "Method Not Allowed"}, tooLarge{431, "Request Header Fields Too Large"},
    broken{500, "Internal Server Error"};

/// "localhost:8080" and its like: the names by which a browser on this machine may call us.
bool isOwnName(std::string_view host, std::uint16_t port) {
  const std::string end = fmt::format(":{}", port);
  if (!host.ends_with(end)) return false;
  host.remove_suffix(end.size());
  std::string name(host);
  std::ranges::transform(name, name.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return name == "127.0.0.1" || name == "localhost" || name == "[::1]";
}

/// The value of a header that is there once; none where it is missing, or there twice.
std::optional<std::string_view> single(const Request& request, std::string_view name) {
  const auto [first, last] = request.equal_range({name.data(), name.size()});
  if (first == last || std::next(first) != last) return {};
  return std::string_view(first->value().data(), first->value().size());
}

bool has(const Request& request, std::string_view name) { return request.count({name.data(), name.size()}) > 0; }

/// Whether one of our own pages asks, or somebody who has typed the address.
bool isOwn(const Request& request, std::uint16_t port) {
  const auto host = single(request, "Host");
  if (!host || !isOwnName(*host, port)) return false;
  if (has(request, "Origin")) {
    const auto origin = single(request, "Origin");
    constexpr std::string_view scheme = "http://";
    if (!origin || !origin->starts_with(scheme) || !isOwnName(origin->substr(scheme.size()), port)) return false;
  }
  if (!has(request, "Sec-Fetch-Site")) return true;
  const auto site = single(request, "Sec-Fetch-Site");
  return site == "same-origin" || site == "none";
}

std::string headOf(const Status& status, const Reply& reply, std::size_t length) {
  return fmt::format(
      "HTTP/1.1 {} {}\r\nContent-Type: {}\r\nContent-Length: {}\r\nConnection: close\r\nCache-Control: no-store\r\n"
      "X-Content-Type-Options: nosniff\r\nCross-Origin-Resource-Policy: same-origin\r\n"
      "Cross-Origin-Opener-Policy: same-origin\r\nReferrer-Policy: no-referrer\r\n{}{}\r\n",
      status.code, status.reason, reply.type, length,
      reply.policy.empty() ? "" : fmt::format("Content-Security-Policy: {}\r\n", reply.policy),
      status.code == notAllowed.code ? "Allow: GET, HEAD\r\n" : "");
}

/// One request and its answer.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(Tcp::socket socket, std::uint16_t port, const PageServer::Answer& answer)
      : socket_(std::move(socket)), deadline_(socket_.get_executor()), port_(port), answer_(answer) {
    parser_.header_limit(mostHeaders);
    parser_.body_limit(0);
  }

  void begin() {
    endIn(timeToAsk);
    read();
  }
  bool isOpen() const { return socket_.is_open(); }
  bool isAsking() const { return !isAnswered_; }
  void end() {
    error_code ignored;
    deadline_.cancel(ignored);
    socket_.shutdown(Tcp::socket::shutdown_both, ignored);
    socket_.close(ignored);
  }

 private:
  void endIn(std::chrono::seconds span) {
    deadline_.expires_after(span);
    deadline_.async_wait([self = shared_from_this()](error_code error) {
      if (!error) self->end();
    });
  }

  void read() {
    socket_.async_read_some(asio::buffer(block_), [self = shared_from_this()](error_code error, std::size_t size) {
      error ? self->end() : self->take(size);
    });
  }

  void take(std::size_t size) {
    said_.append(block_.data(), size);
    if (said_.size() > mostHeaders) return refuse(tooLarge);
    if (said_.find("\r\n\r\n") == std::string::npos) return read();
    error_code error;
    parser_.put(asio::buffer(said_), error);
    if (error || !parser_.is_header_done()) return refuse(error == http::error::header_limit ? tooLarge : malformed);
    answer(parser_.get());
  }

  void answer(const Request& request) {
    const std::string_view target(request.target().data(), request.target().size());
    if (!isOwn(request, port_)) return refuse(forbidden);
    if (has(request, "Transfer-Encoding") ||
        (has(request, "Content-Length") && single(request, "Content-Length") != "0"))
      return refuse(malformed);
    if (request.method() != http::verb::get && request.method() != http::verb::head) return refuse(notAllowed);
    if (!target.starts_with('/')) return refuse(malformed);
    Reply reply;
    try {
      reply = answer_(target.substr(0, target.find('?')));
    } catch (const std::exception&) {
      return refuse(broken);
    }
    if (!reply.body) return refuse(unknown);
    const bool isHead = request.method() == http::verb::head;
    std::string head = headOf(fine, reply, reply.body->size());
    send(std::move(head), isHead ? nullptr : reply.body);
  }

  void refuse(const Status& status) {
    const auto words = std::make_shared<const std::string>(fmt::format("{} {}\n", status.code, status.reason));
    send(headOf(status, {words, "text/plain; charset=utf-8", "default-src 'none'"}, words->size()), words);
  }

  void send(std::string head, std::shared_ptr<const std::string> body) {
    isAnswered_ = true;
    head_ = std::move(head);
    body_ = std::move(body);
    endIn(timeToTake);
    const std::array buffers{asio::const_buffer(asio::buffer(head_)),
                             body_ ? asio::const_buffer(asio::buffer(*body_)) : asio::const_buffer()};
    asio::async_write(socket_, buffers, [self = shared_from_this()](error_code, std::size_t) { self->end(); });
  }

  Tcp::socket socket_;
  asio::steady_timer deadline_;
  const std::uint16_t port_;
  const PageServer::Answer& answer_;
  http::request_parser<http::empty_body> parser_;
  std::array<char, 4096> block_{};
  std::string said_, head_;
  std::shared_ptr<const std::string> body_;
  bool isAnswered_ = false;
};

}  // namespace

class PageServer::Listener {
 public:
  Listener(std::uint16_t port, Answer answer) : answer_(std::move(answer)) {
    listen(four_, {asio::ip::address_v4::loopback(), port});
    accept(four_);
    try {
      listen(six_, {asio::ip::address_v6::loopback(), this->port()});
      accept(six_);
    } catch (const boost::system::system_error&) {  // the other one is the address that is told
      error_code ignored;
      six_.close(ignored);
    }
  }
  ~Listener() {
    for (const auto& connection : connections_) connection->end();
    context_.restart();
    context_.poll();
  }

  std::uint16_t port() const { return four_.local_endpoint().port(); }
  void serve(std::chrono::milliseconds span) {
    context_.restart();
    context_.run_for(span);
  }

 private:
  static void listen(Tcp::acceptor& acceptor, const Tcp::endpoint& at) {
    acceptor.open(at.protocol());
    if (at.protocol() == Tcp::v6()) acceptor.set_option(asio::ip::v6_only(true));
    acceptor.set_option(Tcp::acceptor::reuse_address(true));
    acceptor.bind(at);
    acceptor.listen();
  }

  void accept(Tcp::acceptor& acceptor) {
    acceptor.async_accept([this, &acceptor](error_code error, Tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (error) return acceptLater(acceptor);
      std::erase_if(connections_, [](const auto& connection) { return !connection->isOpen(); });
      if (connections_.size() >= mostConnections) endOne();
      connections_.push_back(std::make_shared<Connection>(std::move(socket), port(), answer_));
      connections_.back()->begin();
      accept(acceptor);
    });
  }

  /// The process may open no more files, say.
  void acceptLater(Tcp::acceptor& acceptor) {
    auto timer = std::make_shared<asio::steady_timer>(context_, std::chrono::milliseconds(200));
    timer->async_wait([this, &acceptor, timer](error_code error) {
      if (!error) accept(acceptor);
    });
  }

  /// The oldest that has not said what it wants, or the oldest.
  void endOne() {
    auto oldest = std::ranges::find_if(connections_, [](const auto& connection) { return connection->isAsking(); });
    if (oldest == connections_.end()) oldest = connections_.begin();
    (*oldest)->end();
    connections_.erase(oldest);
  }

  const Answer answer_;
  asio::io_context context_{1};
  Tcp::acceptor four_{context_}, six_{context_};
  std::list<std::shared_ptr<Connection>> connections_;
};

PageServer::PageServer(std::uint16_t port, Answer answer) {
  try {
    listener_ = std::make_unique<Listener>(port, std::move(answer));
  } catch (const boost::system::system_error& error) {
    throw NoAddress(error.code() == asio::error::address_in_use
                        ? fmt::format("port {} is in use", port)
                        : fmt::format("port {} cannot be listened at ({})", port, error.code().message()));
  }
}

PageServer::~PageServer() = default;

std::uint16_t PageServer::port() const { return listener_->port(); }

void PageServer::serve(std::chrono::milliseconds span) { listener_->serve(span); }

}  // namespace gamut
