#include "studio/studio.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/version.h"
#include "studio/breeding_http.h"
#include "studio/export_model.h"
#include "studio/picture_type.h"
#include "studio/project_file.h"
#include "studio/scene_zip.h"
#include "studio/shipped.h"
#include "studio/web_guard.h"

namespace espalier::studio {
namespace {

constexpr int kMostBusy = 3;

/// Counts what takes long and much memory, while it lasts.
class Turn {
 public:
  explicit Turn(std::atomic<int>& busy) : busy_(busy) {
    if (++busy_ > kMostBusy) {
      --busy_;
      throw Error("the server is busy with other files: try again");
    }
  }
  ~Turn() { --busy_; }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  std::atomic<int>& busy_;
};

api::ProjectInfo info_of(const StoredProject& project) { return {project.id, project.name, project.changed}; }

/// Takes "12/" off a path; -1 where it does not begin so.
std::int64_t take_number(std::string& path) {
  std::int64_t number = -1;
  const auto [end, error] = std::from_chars(path.data(), path.data() + path.size(), number);
  if (error != std::errc() || end == path.data() + path.size() || *end != '/' || number < 0) return -1;
  path.erase(0, static_cast<std::size_t>(end - path.data()) + 1);
  return number;
}

HttpResponse not_found() { return {404, "text/plain", "there is no such thing\n"}; }

std::string_view image_type(const std::string& path) {
  if (path.ends_with(".png")) return "image/png";
  if (path.ends_with(".jpg") || path.ends_with(".jpeg")) return "image/jpeg";
  return "application/octet-stream";
}

}  // namespace

Studio::Studio(const std::string& data) : store_(data) {}

Studio::~Studio() {
  // Sessions end one after another, none of them under the lock that their threads may ask for.
  std::vector<SessionPtr> sessions;
  {
    const std::lock_guard lock(mutex_);
    sessions.swap(sessions_);
    where_.clear();
  }
}

void Studio::opened(const WebSocketPtr& socket) {
  {
    const std::lock_guard lock(mutex_);
    sockets_[socket->number] = socket;
  }
  send_projects(&socket);
}

void Studio::ending() { give_up_at_ = ticks(std::chrono::steady_clock::now()); }

void Studio::closed(const WebSocketPtr& socket) {
  SessionPtr session;
  {
    const std::lock_guard lock(mutex_);
    sockets_.erase(socket->number);
    const auto found = where_.find(socket->number);
    if (found == where_.end()) return;
    session = std::move(found->second);
    where_.erase(found);
  }
  session->leave(socket);
}

std::string Studio::projects_text(std::optional<std::int64_t> request) {
  api::Projects message;
  message.request = request;
  message.version = kVersion;
  for (const StoredProject& project : store_.projects()) message.projects.push_back(info_of(project));
  message.samples = samples();
  return to_text(message);
}

void Studio::send_projects(const WebSocketPtr* only) {
  const std::string text = projects_text({});
  if (only) return (*only)->out.push_text(text);
  const std::lock_guard lock(mutex_);
  for (const auto& [number, socket] : sockets_) socket->out.push_text(text);
}

/// The session of an open project, or the end. Under the lock.
std::vector<Studio::SessionPtr>::iterator Studio::find_open(std::int64_t project) {
  return std::find_if(sessions_.begin(), sessions_.end(),
                      [&](const SessionPtr& one) { return one->project() == project; });
}

Studio::SessionPtr Studio::session(std::int64_t project) {
  SessionPtr leaving;  // ends after the lock is given back
  const std::lock_guard lock(mutex_);
  const auto found = find_open(project);
  if (found != sessions_.end()) {
    std::rotate(found, found + 1, sessions_.end());
    return sessions_.back();
  }
  if (sessions_.size() >= kMostSessions) {
    const auto idle = std::find_if(sessions_.begin(), sessions_.end(), [](const SessionPtr& one) { return !one->watched(); });
    if (idle == sessions_.end()) throw Error(fmt::format("{} projects are open: close one of their pages", kMostSessions));
    leaving = std::move(*idle);
    sessions_.erase(idle);
  }
  sessions_.push_back(std::make_shared<ProjectSession>(store_, project));
  return sessions_.back();
}

Studio::SessionPtr Studio::session_of(const WebSocketPtr& socket) {
  const std::lock_guard lock(mutex_);
  const auto found = where_.find(socket->number);
  return found == where_.end() ? nullptr : found->second;
}

void Studio::put(const WebSocketPtr& socket, const SessionPtr& session, std::optional<std::int64_t> number) {
  SessionPtr before;
  {
    const std::lock_guard lock(mutex_);
    if (sockets_.count(socket->number) == 0) return;  // closed meanwhile
    before = std::exchange(where_[socket->number], session);
  }
  if (before && before != session) {
    before->leave(socket);
    socket->out.forget_models();
  }
  session->join(socket, number);
}

std::int64_t Studio::require_created(const api::CreateProject& create) {
  return add(create.name, create.sample ? make_sample(*create.sample) : make_empty_project());
}

/// Whether the request was one of the list's; then it is done.
bool Studio::handle(const WebSocketPtr& socket, const api::Request& request, std::optional<std::int64_t> number) {
  const auto done = [&] { socket->out.push_text(to_text(api::Done{number})); };
  if (std::holds_alternative<api::ListProjects>(request)) {
    socket->out.push_text(projects_text(number));
    return done(), true;
  }
  if (const auto* create = std::get_if<api::CreateProject>(&request)) {
    const std::int64_t project = require_created(*create);
    send_projects();
    put(socket, session(project), number);
    return true;
  }
  if (const auto* open = std::get_if<api::OpenProject>(&request)) {
    put(socket, session(open->project), number);
    return true;
  }
  if (const auto* rename = std::get_if<api::RenameProject>(&request)) {
    store_.rename(rename->project, rename->name);
    SessionPtr open;
    {
      const std::lock_guard lock(mutex_);
      if (const auto found = find_open(rename->project); found != sessions_.end()) open = *found;
    }
    if (open) open->renamed();
    send_projects();
    return done(), true;
  }
  if (const auto* duplicate = std::get_if<api::DuplicateProject>(&request)) {
    store_.duplicate(duplicate->project);
    send_projects();
    return done(), true;
  }
  if (const auto* remove = std::get_if<api::DeleteProject>(&request)) {
    store_.remove(remove->project);
    SessionPtr open;
    {
      const std::lock_guard lock(mutex_);
      if (const auto found = find_open(remove->project); found != sessions_.end()) {
        open = std::move(*found);
        sessions_.erase(found);
        std::erase_if(where_, [&](const auto& place) { return place.second == open; });
      }
    }
    send_projects();
    return done(), true;
  }
  return false;
}

void Studio::received(const WebSocketPtr& socket, std::string text) {
  std::optional<std::int64_t> number;
  try {
    api::Request request = api::read_request(text, number);
    if (handle(socket, request, number)) return;
    const SessionPtr session = session_of(socket);
    if (!session) throw Error("no project is open");
    session->post(socket, std::move(request), number);
  } catch (const Error& error) {
    socket->out.push_text(to_text(api::Failed{number, error.what()}));
  }
}

HttpResponse Studio::answer(const HttpRequest& request) {
  constexpr std::string_view kProjects = "/projects/", kSamples = "/samples/";
  if (request.path.starts_with(kSamples) && request.method == "GET") {
    const auto picture = sample_picture(request.path.substr(kSamples.size()));
    if (!picture) return not_found();
    return {200, std::string(picture_type(*picture)), std::string(*picture)};
  }
  if (!request.path.starts_with(kProjects)) return not_found();
  std::string rest = request.path.substr(kProjects.size());
  if (rest == "import") {
    if (request.method != "POST") return {405, "text/plain", "POST\n"};
    const Turn turn(busy_);
    const std::int64_t project = import(request.body);
    send_projects();
    return {200, "text/plain", fmt::format("{}\n", project)};
  }
  const std::int64_t project = take_number(rest);
  return project < 0 ? not_found() : answer_project(project, request, rest);
}

HttpResponse Studio::answer_project(std::int64_t project, const HttpRequest& request, const std::string& rest) {
  constexpr std::string_view kFiles = "files/", kBreeding = "breeding/", kExport = "export/", kFavourites = "favourites/",
                             kPreviews = "previews/", kMeshes = "meshes/";
  if (rest.starts_with(kExport) && request.method == "GET") {
    const Turn turn(busy_);
    return export_project(project, rest.substr(kExport.size()));
  }
  if (rest.starts_with(kPreviews) && request.method == "GET") return preview(project, rest.substr(kPreviews.size()));
  if (rest.starts_with(kMeshes) && request.method == "GET") return mesh_form(project, rest.substr(kMeshes.size()));
  if (rest.starts_with(kFavourites) && request.method == "GET") {
    std::string number = rest.substr(kFavourites.size()) + "/";
    std::string picture = store_.favourite_picture(project, take_number(number));
    if (picture.empty()) return not_found();
    return {200, std::string(picture_type(picture)), std::move(picture)};
  }
  if (rest.starts_with(kBreeding)) {
    const Turn turn(busy_);
    PatientExecutor executor(give_up_at_, Cores::all);
    const BreedingAnswer answer =
        answer_breeding(store_, project, request, rest.substr(kBreeding.size()), executor);
    if (answer.changed) session(project)->breedings_changed();
    return answer.response;
  }
  if (!rest.starts_with(kFiles)) return not_found();
  const std::string path = rest.substr(kFiles.size());
  if (!is_plain_path(path)) throw Error("a file's path has letters, digits and \" ._-()+\" alone, and leads nowhere else");
  if (request.method == "POST") {
    if (path == kGrammarName || path.starts_with("shapes/")) throw Error(fmt::format("{} is taken", path));
    const Turn turn(busy_);
    session(project)->add_file(describe_file(path, request.body), request.body);
    return {200, "text/plain", "added\n"};
  }
  for (const StoredFile& file : store_.open(project).state.files) {
    if (file.path == path) return {200, std::string(image_type(path)), store_.blob(project, file.hash)};
  }
  return not_found();
}

HttpResponse Studio::preview(std::int64_t project, const std::string& path) {
  for (const StoredFile& file : store_.open(project).state.files) {
    if (file.path != path) continue;
    std::string png = previews_.png(file, [&](const std::string& hash) { return store_.blob(project, hash); });
    if (!png.empty()) return {200, "image/png", std::move(png)};
  }
  return not_found();
}

HttpResponse Studio::mesh_form(std::int64_t project, const std::string& path) {
  for (const StoredFile& file : store_.open(project).state.files) {
    if (file.path != path || file.triangles == 0) continue;
    return {200, "application/octet-stream",
            forms_.message(file, [&](const std::string& hash) { return store_.blob(project, hash); })};
  }
  return not_found();
}

HttpResponse Studio::export_project(std::int64_t project, const std::string& format) {
  const StoredProjectState now = store_.open(project);
  if (format == "espalier") {
    WholeProject whole;
    store_.alone([&](Database&) {  // at one go: people work on meanwhile
      const StoredProjectState state = store_.open(project);
      whole = {state.project.name, {state.state, {}}, store_.shown(project), store_.favourites(project), {}};
      BreedingStore breedings(store_);
      for (const BreedingSummary& one : breedings.list(project)) whole.breedings.push_back(breedings.whole(project, one.id));
      for (const StoredFile& file : state.state.files) whole.content.blobs[file.hash] = store_.blob(project, file.hash);
    });
    return {200, "application/json", project_file(whole), fmt::format("project-{}.espalier", project)};
  }
  const ShownModelPtr shown = session(project)->shown();
  if (!shown) throw Error("no model is shown yet");
  return export_model(*shown, format, now.project.name);
}

std::string Studio::token(bool fresh) {
  constexpr const char* kName = "token";
  const std::optional<std::string> kept = store_.setting(kName);
  if (kept && is_token(*kept) && !fresh) return *kept;
  std::string made = make_token();
  store_.set_setting(kName, made);
  return made;
}

std::int64_t Studio::find_or_create(const std::string& name) {
  for (const StoredProject& project : store_.projects()) {
    if (project.name == name) return project.id;
  }
  return add(name, make_empty_project());
}

std::int64_t Studio::add(const std::string& name, const NewProject& content) {
  return store_.create(name, content.state, content.blobs);
}

std::int64_t Studio::import(std::string_view text) {
  const WholeProject project = is_zip(text) ? project_of_zip(text) : parse_project_file(text);
  std::int64_t id = 0;
  store_.alone([&](Database& database) {  // all of it or nothing
    Transaction transaction(database);
    id = store_.create(project.name, project.content.state, project.content.blobs);
    store_.set_shown(id, project.shown);
    for (const StoredFavourite& favourite : project.favourites) store_.add_favourite(id, favourite);
    // The one that was changed last comes last.
    for (auto it = project.breedings.rbegin(); it != project.breedings.rend(); ++it) BreedingStore(store_).insert(id, *it);
    transaction.commit();
  });
  return id;
}

}  // namespace espalier::studio
