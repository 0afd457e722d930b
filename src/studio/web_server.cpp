#include "studio/web_server.h"

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <future>
#include <map>
#include <mutex>
#include <thread>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <civetweb.h>
#include <fmt/format.h>

#include "base/error.h"
#include "studio/page_folder.h"
#include "studio/web_guard.h"

namespace espalier::studio {
namespace {

constexpr const char* kSocketPath = "/socket";
constexpr int kSpareThreads = 8;  // beside those that sockets hold
constexpr std::size_t kMostQuery = 2000;

std::string_view header(const mg_connection* connection, const char* name) {
  const char* const value = mg_get_header(connection, name);
  return value ? value : "";
}

std::string reason_of(int status) {
  switch (status) {
    case 200: return "OK";
    case 400: return "Bad Request";
    case 403: return "Forbidden";
    case 404: return "Not Found";
    case 405: return "Method Not Allowed";
    case 411: return "Length Required";
    case 413: return "Content Too Large";
    case 503: return "Service Unavailable";
    default: return "Error";
  }
}

/// Connects to a port of this machine, and says nothing.
void knock(std::uint16_t port) {
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (socket < 0) return;
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  (void)!connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof(address));
  close(socket);
}

/// Of the query, "" where there is none.
std::string query_value(const mg_request_info& request, const char* name) {
  if (!request.query_string) return "";
  const std::size_t length = std::char_traits<char>::length(request.query_string);
  if (length > kMostQuery) return "";
  std::array<char, kMostQuery + 1> value{};
  return mg_get_var(request.query_string, length, name, value.data(), value.size()) > 0 ? value.data() : "";
}

}  // namespace

class WebServer::Implementation {
 public:
  Implementation(WebServerSettings settings, WebApp& app) : settings_(std::move(settings)), app_(app) {
    mg_init_library(0);
    const std::string port = fmt::format("127.0.0.1:{}", settings_.port);
    const std::string threads = fmt::format("{}", settings_.most_sockets + kSpareThreads);
    const char* options[] = {"listening_ports", port.c_str(), "num_threads", threads.c_str(), "tcp_nodelay", "1",
                             "enable_keep_alive", "no", "request_timeout_ms", "10000", "websocket_timeout_ms", "10000",
                             "enable_websocket_ping_pong", "yes", "max_request_size", "16384", "enable_directory_listing",
                             "no", nullptr};
    mg_callbacks callbacks{};
    callbacks.begin_request = [](mg_connection* connection) { return of(connection).begin(connection); };
    callbacks.log_message = [](const mg_connection*, const char*) { return 1; };  // ours alone speak to people
    context_ = mg_start(&callbacks, this, options);
    if (!context_) {
      mg_exit_library();
      throw Error(fmt::format("port {} of 127.0.0.1 cannot be listened to: another program may hold it (--port)",
                              settings_.port));
    }
    mg_server_port served[4] = {};
    port_ = mg_get_server_ports(context_, 4, served) > 0 ? static_cast<std::uint16_t>(served[0].port) : 0;
    mg_set_websocket_handler(
        context_, kSocketPath, [](const mg_connection*, void*) { return 0; },
        [](mg_connection* connection, void* self) { static_cast<Implementation*>(self)->ready(connection); },
        [](mg_connection* connection, int bits, char* data, std::size_t size, void* self) {
          return static_cast<Implementation*>(self)->data(connection, bits, {data, size}) ? 1 : 0;
        },
        [](const mg_connection* connection, void* self) { static_cast<Implementation*>(self)->close(connection); },
        this);
    open_ = true;
  }

  ~Implementation() {
    app_.ending();
    say_goodbye();
    // The library looks only every two seconds whether it shall end, unless somebody knocks.
    std::atomic<bool> stopped{false};
    std::thread knocking([&] {
      while (!stopped) knock(port_), std::this_thread::sleep_for(std::chrono::milliseconds(20));
    });
    mg_stop(context_);
    stopped = true;
    knocking.join();
    mg_exit_library();
  }

  std::uint16_t port() const { return port_; }

 private:
  /// One connection: its socket, the thread that writes, and the message whose frames are being received.
  struct Link {
    WebSocketPtr socket;
    std::thread writer;
    std::string partial;
    bool in_text = false;
  };

  static Implementation& of(const mg_connection* connection) {
    return *static_cast<Implementation*>(mg_get_user_data(mg_get_context(connection)));
  }

  /// 0: the library goes on with the handshake; else the status of what was answered.
  int begin(mg_connection* connection) {
    const mg_request_info& request = *mg_get_request_info(connection);
    const std::string path = request.local_uri ? request.local_uri : "";
    const HttpResponse refusal = refuse(connection, request, path);
    if (refusal.status != 200) return send(connection, refusal);
    if (path == kSocketPath) return 0;
    HttpRequest asked{request.request_method, path, ""};
    if (asked.method == "GET") {
      if (const std::optional<HttpResponse> page = page_file(settings_.page_folder, path)) return send(connection, *page);
    }
    if (!token_fits(connection, request)) return send(connection, {403, "text/plain", "no token, or not this server's\n"});
    if (asked.method == "POST") {
      const HttpResponse fault = read_body(connection, request, asked.body);
      if (fault.status != 200) return send(connection, fault);
    }
    try {
      // civetweb's threads have too little stack for grammars, and for what meshes are read with.
      return send(connection, std::async(std::launch::async, [&] { return app_.answer(asked); }).get());
    } catch (const Error& error) {
      return send(connection, {400, "text/plain; charset=utf-8", std::string(error.what()) + "\n"});
    } catch (const std::exception&) {
      return send(connection, {503, "text/plain", "out of memory, or of room\n"});
    }
  }

  HttpResponse refuse(const mg_connection* connection, const mg_request_info& request, const std::string& path) const {
    const auto forbidden = [](const char* why) { return HttpResponse{403, "text/plain", why}; };
    if (!open_) return {503, "text/plain", "not yet\n"};
    if (!host_allowed(header(connection, "Host"), port_)) return forbidden("this host name is not served\n");
    const std::string_view origin = header(connection, "Origin");
    if (!origin.empty() && !origin_allowed(origin, port_)) return forbidden("other sites are not served\n");
    const std::string_view method = request.request_method;
    if (method != "GET" && method != "POST") return {405, "text/plain", "GET or POST\n"};
    if (path != kSocketPath) return {};
    if (origin.empty()) return forbidden("a WebSocket must say where its page comes from\n");
    if (!token_fits(connection, request)) return forbidden("no token, or not this server's\n");
    const std::lock_guard lock(mutex_);
    if (links_.size() >= static_cast<std::size_t>(settings_.most_sockets)) {
      return {503, "text/plain", "too many pages are open\n"};
    }
    return {};
  }

  bool token_fits(const mg_connection* connection, const mg_request_info& request) const {
    const std::string_view given = header(connection, "X-Espalier-Token");
    return same_token(given.empty() ? query_value(request, "token") : given, settings_.token);
  }

  HttpResponse read_body(mg_connection* connection, const mg_request_info& request, std::string& body) const {
    if (request.content_length < 0) return {411, "text/plain", "the length must be said\n"};
    const auto length = static_cast<std::size_t>(request.content_length);
    if (length > settings_.most_body_bytes) {
      return {413, "text/plain", fmt::format("at most {} bytes\n", settings_.most_body_bytes)};
    }
    // Memory is taken as bytes come, not as they are announced.
    std::array<char, 16384> chunk;  // the stack is small
    while (body.size() < length) {
      const int got = mg_read(connection, chunk.data(), std::min(chunk.size(), length - body.size()));
      if (got <= 0) return {400, "text/plain", "the body was cut short\n"};
      body.append(chunk.data(), static_cast<std::size_t>(got));
    }
    return {};
  }

  int send(mg_connection* connection, const HttpResponse& response) const {
    std::string head = fmt::format("HTTP/1.1 {} {}\r\n{}Content-Type: {}\r\nContent-Length: {}\r\nCache-Control: no-store\r\n"
                                   "Connection: close\r\n",
                                   response.status, reason_of(response.status), guard_headers(port_), response.type,
                                   response.body.size());
    if (!response.file_name.empty()) {
      head += fmt::format("Content-Disposition: attachment; filename=\"{}\"\r\n", response.file_name);
    }
    head += "\r\n";
    if (mg_write(connection, head.data(), head.size()) > 0 && !response.body.empty()) {
      mg_write(connection, response.body.data(), response.body.size());
    }
    return response.status;
  }

  void ready(mg_connection* connection) {
    auto link = std::make_unique<Link>();
    link->socket = std::make_shared<WebSocket>();
    Link* const known = link.get();
    {
      const std::lock_guard lock(mutex_);
      link->socket->number = ++numbers_;
      links_[connection] = std::move(link);
    }
    mg_set_user_connection_data(connection, known);
    try {
      known->writer = std::thread([connection, socket = known->socket] { write_all(connection, *socket); });
      app_.opened(known->socket);
    } catch (const std::exception&) {  // no thread, no memory, no disk: the page connects again
      known->socket->out.close();
    }
  }

  static void write_all(mg_connection* connection, WebSocket& socket) {
    Bytes tables[2];  // that the page has, of the project's model and of the breeding room: projects count them each for itself
    const auto write = [&](const Bytes& bytes, int opcode) {
      return !bytes || mg_websocket_write(connection, opcode, bytes->data(), bytes->size()) > 0;
    };
    while (const std::optional<OutMessage> message = socket.out.take()) {
      bool written = true;
      const bool individual = message->kind == OutMessage::Kind::individual;
      if (message->kind == OutMessage::Kind::model || individual) {
        const ModelPacket& model = message->model;
        Bytes& meshes = tables[individual ? 1 : 0];
        if (model.meshes != meshes) written = write(model.meshes, MG_WEBSOCKET_OPCODE_BINARY);
        meshes = model.meshes;
        written = written && write(model.model, MG_WEBSOCKET_OPCODE_BINARY) && write(model.shown, MG_WEBSOCKET_OPCODE_TEXT);
      } else {
        const bool text = message->kind == OutMessage::Kind::text;
        written = write(message->bytes, text ? MG_WEBSOCKET_OPCODE_TEXT : MG_WEBSOCKET_OPCODE_BINARY);
      }
      if (!written) break;
    }
    socket.out.close();
    mg_websocket_write(connection, MG_WEBSOCKET_OPCODE_CONNECTION_CLOSE, nullptr, 0);
  }

  /// Tells all pages that this is the end, and waits a moment for them to go: once it is stopped, the library writes no
  /// more, and then those that stayed are found out only within two seconds.
  void say_goodbye() {
    std::unique_lock lock(mutex_);
    for (auto& [connection, link] : links_) link->socket->out.close();
    left_.wait_for(lock, std::chrono::milliseconds(200), [&] { return links_.empty(); });
  }

  /// False: the connection is to be closed.
  bool data(mg_connection* connection, int bits, std::string_view bytes) {
    auto& link = *static_cast<Link*>(mg_get_user_connection_data(connection));
    const int opcode = bits & 0xf;
    const bool last = (bits & 0x80) != 0;
    if (opcode == MG_WEBSOCKET_OPCODE_CONNECTION_CLOSE || link.socket->out.closed()) return false;
    if (opcode == MG_WEBSOCKET_OPCODE_PING || opcode == MG_WEBSOCKET_OPCODE_PONG) return true;
    if (opcode == MG_WEBSOCKET_OPCODE_BINARY) return false;
    if ((opcode == MG_WEBSOCKET_OPCODE_TEXT) == link.in_text) return false;  // a text within a text, or a rest of nothing
    if (link.partial.size() + bytes.size() > settings_.most_frame_bytes) return false;
    link.partial.append(bytes);
    link.in_text = !last;
    if (!last) return true;
    std::string text;
    text.swap(link.partial);
    try {
      app_.received(link.socket, std::move(text));
    } catch (const std::exception&) {
      return false;  // no memory: the page connects again
    }
    return true;
  }

  void close(const mg_connection* connection) {
    std::unique_ptr<Link> link;
    {
      const std::lock_guard lock(mutex_);
      const auto found = links_.find(connection);
      if (found == links_.end()) return;
      link = std::move(found->second);
      links_.erase(found);
      left_.notify_all();
    }
    link->socket->out.close();
    if (link->writer.joinable()) link->writer.join();
    app_.closed(link->socket);
  }

  WebServerSettings settings_;
  WebApp& app_;
  mg_context* context_ = nullptr;
  std::atomic<std::uint16_t> port_{0};
  std::atomic<bool> open_{false};
  mutable std::mutex mutex_;
  std::condition_variable left_;
  std::map<const mg_connection*, std::unique_ptr<Link>> links_;
  std::uint64_t numbers_ = 0;
};

WebServer::WebServer(WebServerSettings settings, WebApp& app)
    : implementation_(std::make_unique<Implementation>(std::move(settings), app)) {}
WebServer::~WebServer() = default;

std::uint16_t WebServer::port() const { return implementation_->port(); }

}  // namespace espalier::studio
