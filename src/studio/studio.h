#pragma once
// Studio: what the server serves: the list of projects, those that are open, and files in and out.

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "studio/mesh_forms.h"
#include "studio/mesh_previews.h"
#include "studio/project_session.h"
#include "studio/shipped.h"
#include "studio/store.h"
#include "studio/web_server.h"

namespace espalier::studio {

class Studio final : public WebApp {
 public:
  static constexpr std::size_t kMostSessions = 12;  // projects with a search of their own; those that nobody sees go first

  /// Opens the file of projects. Throws Error.
  explicit Studio(const std::string& data);
  ~Studio() override;

  void opened(const WebSocketPtr& socket) override;
  void received(const WebSocketPtr& socket, std::string text) override;
  void closed(const WebSocketPtr& socket) override;
  HttpResponse answer(const HttpRequest& request) override;
  void ending() override;

  /// What pages must know to be served. The same for the same file of projects, so that pages find their way back after
  /// the server was started again, unless a `fresh` one is asked for. Throws Error.
  std::string token(bool fresh = false);
  /// The project of that name; a new one where there is none. Throws Error.
  std::int64_t find_or_create(const std::string& name);
  /// A new project; returns its number. Throws Error.
  std::int64_t add(const std::string& name, const NewProject& content);
  /// Takes in a project file, or a scene folder in a zip file; returns its number. Throws Error.
  std::int64_t import(std::string_view text);

 private:
  using SessionPtr = std::shared_ptr<ProjectSession>;

  void send_projects(const WebSocketPtr* only = nullptr);
  std::string projects_text(std::optional<std::int64_t> request);
  std::vector<SessionPtr>::iterator find_open(std::int64_t project);
  SessionPtr session(std::int64_t project);
  SessionPtr session_of(const WebSocketPtr& socket);
  void put(const WebSocketPtr& socket, const SessionPtr& session, std::optional<std::int64_t> number);
  std::int64_t require_created(const api::CreateProject& create);
  bool handle(const WebSocketPtr& socket, const api::Request& request, std::optional<std::int64_t> number);
  HttpResponse answer_project(std::int64_t project, const HttpRequest& request, const std::string& rest);
  HttpResponse export_project(std::int64_t project, const std::string& format);

  HttpResponse preview(std::int64_t project, const std::string& path);
  HttpResponse mesh_form(std::int64_t project, const std::string& path);

  Store store_;
  MeshPreviews previews_;
  MeshForms forms_;
  std::atomic<int> busy_{0};  // exports and imports that run
  std::atomic<std::int64_t> give_up_at_{0};  // see PatientExecutor
  std::mutex mutex_;          // guards what follows
  std::map<std::uint64_t, WebSocketPtr> sockets_;
  std::map<std::uint64_t, SessionPtr> where_;  // session by socket
  std::vector<SessionPtr> sessions_;           // used last last
};

}  // namespace espalier::studio
