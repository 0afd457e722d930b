#pragma once
// A small HTTP and WebSocket client over a real loopback socket.

#include <chrono>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <fmt/format.h>

namespace espalier::studio {

class Connection {
 public:
  explicit Connection(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof(address)) != 0) hang_up();
    const int one = 1;
    setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &one, sizeof(one));
  }
  ~Connection() { hang_up(); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void hang_up() {
    if (socket_ >= 0) close(socket_);
    socket_ = -1;
  }
  bool send(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (sent <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
    return true;
  }
  /// Exactly so many bytes; nothing where the other side ends, or says nothing for so long.
  std::optional<std::string> read(std::size_t bytes, int milliseconds = 20'000) {
    while (buffer_.size() < bytes) {
      if (!fill(milliseconds)) return std::nullopt;
    }
    std::string result = buffer_.substr(0, bytes);
    buffer_.erase(0, bytes);
    return result;
  }
  std::optional<std::string> read_until(const std::string& mark) {
    while (buffer_.find(mark) == std::string::npos) {
      if (!fill(20'000)) return std::nullopt;
    }
    return read(buffer_.find(mark) + mark.size());
  }
  /// Whether the other side ended within so long, whatever it said before.
  bool ends(int milliseconds = 20'000) {
    while (fill(milliseconds)) {}
    return ended_;
  }

 private:
  bool fill(int milliseconds) {
    pollfd waiting{socket_, POLLIN, 0};
    if (poll(&waiting, 1, milliseconds) <= 0) return false;
    char chunk[65536];
    const ssize_t got = recv(socket_, chunk, sizeof(chunk), 0);
    ended_ = got <= 0;
    if (got > 0) buffer_.append(chunk, static_cast<std::size_t>(got));
    return got > 0;
  }

  int socket_;
  bool ended_ = false;
  std::string buffer_;
};

struct Answer {
  int status = 0;
  std::string head, body;
};

/// One request. `head`: header lines beside Host, each with \r\n.
inline Answer ask(std::uint16_t port, const std::string& request, const std::string& head = "", const std::string& body = "",
                  const std::string& host = "") {
  Connection connection(port);
  connection.send(fmt::format("{} HTTP/1.1\r\nHost: {}\r\n{}{}\r\n", request,
                              host.empty() ? fmt::format("127.0.0.1:{}", port) : host, head,
                              body.empty() ? "" : fmt::format("Content-Length: {}\r\n", body.size())));
  connection.send(body);
  Answer answer;
  answer.head = connection.read_until("\r\n\r\n").value_or("");
  if (answer.head.size() > 12) answer.status = std::stoi(answer.head.substr(9, 3));
  const std::size_t length = answer.head.find("Content-Length: ");
  if (length != std::string::npos) answer.body = connection.read(std::stoul(answer.head.substr(length + 16))).value_or("");
  return answer;
}

/// A message of the server: text, or binary.
struct Message {
  bool binary = false;
  std::string bytes;
};

class WebSocketClient {
 public:
  WebSocketClient(std::uint16_t port, const std::string& token, const std::string& origin = "", const std::string& host = "")
      : connection_(port) {
    const std::string own = fmt::format("127.0.0.1:{}", port);
    connection_.send(fmt::format("GET /socket?token={} HTTP/1.1\r\nHost: {}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                                 "Origin: {}\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
                                 "Sec-WebSocket-Version: 13\r\n\r\n",
                                 token, host.empty() ? own : host, origin.empty() ? "http://" + own : origin));
    const std::string head = connection_.read_until("\r\n\r\n").value_or("");
    status_ = head.size() > 12 ? std::stoi(head.substr(9, 3)) : 0;
  }

  int status() const { return status_; }

  /// opcode: 1 text, 2 binary, 0 goes on; `last`: the message ends with it.
  bool send_frame(std::string_view bytes, int opcode = 1, bool last = true) {
    std::string frame(1, static_cast<char>((last ? 0x80 : 0) | opcode));
    if (bytes.size() < 126) {
      frame += static_cast<char>(0x80 | bytes.size());
    } else {
      const int wide = bytes.size() < 65536 ? 2 : 8;
      frame += static_cast<char>(0x80 | (wide == 2 ? 126 : 127));
      for (int i = wide - 1; i >= 0; --i) frame += static_cast<char>(bytes.size() >> (8 * i) & 0xff);
    }
    const char mask[] = {0x12, 0x34, 0x56, 0x78};
    frame.append(mask, 4);
    for (std::size_t i = 0; i < bytes.size(); ++i) frame += static_cast<char>(bytes[i] ^ mask[i % 4]);
    return connection_.send(frame);
  }

  /// The next message, control frames left out; nothing where the connection ends or stays silent.
  std::optional<Message> read(int milliseconds = 20'000) {
    for (;;) {
      const auto head = connection_.read(2, milliseconds);
      if (!head) return std::nullopt;
      const int opcode = (*head)[0] & 0xf;
      std::uint64_t size = static_cast<unsigned char>((*head)[1]) & 0x7f;
      const int wide = size == 126 ? 2 : size == 127 ? 8 : 0;
      if (wide > 0) {
        const auto bytes = connection_.read(static_cast<std::size_t>(wide));
        if (!bytes) return std::nullopt;
        size = 0;
        for (const char byte : *bytes) size = size << 8 | static_cast<unsigned char>(byte);
      }
      auto bytes = connection_.read(size);
      if (bytes && opcode == 8) send_frame("", 8), hang_up();  // as browsers do
      if (!bytes || opcode == 8) return std::nullopt;
      if (opcode == 1 || opcode == 2) return Message{opcode == 2, std::move(*bytes)};
    }
  }
  bool ends(int milliseconds = 20'000) { return connection_.ends(milliseconds); }
  void hang_up() { connection_.hang_up(); }

 private:
  Connection connection_;
  int status_ = 0;
};

}  // namespace espalier::studio
