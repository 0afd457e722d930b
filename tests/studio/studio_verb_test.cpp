// The program itself: started, killed, started again.
#include <csignal>
#include <cstdio>
#include <string>

#include <sys/wait.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "base/random.h"
#include "run/temporary_folder.h"
#include "studio/web_client.h"

namespace espalier::studio {
namespace {

using nlohmann::json;

/// A server in a process of its own; its link is read from what it prints.
class Program {
 public:
  explicit Program(const std::string& data, std::uint16_t at = 0, const char* more = nullptr, const char* project = "p") {
    int ends[2];
    if (pipe(ends) != 0) return;
    child_ = fork();
    if (child_ == 0) {
      dup2(ends[1], STDOUT_FILENO);
      close(ends[0]);
      execl(ESPALIER_PROGRAM, "espalier", "studio", project, "--port", std::to_string(at).c_str(), "--no-open", "--data", data.c_str(),
            more, nullptr);
      _exit(127);
    }
    close(ends[1]);
    std::string line;
    for (char c = 0; read(ends[0], &c, 1) == 1 && c != '\n';) line += c;
    close(ends[0]);
    const std::size_t colon = line.rfind(':', line.find("/?")), key = line.find("token="), place = line.find("&project=");
    if (key == std::string::npos || place == std::string::npos) return;
    port = static_cast<std::uint16_t>(std::stoi(line.substr(colon + 1)));
    token = line.substr(key + 6, place - key - 6);
    number = std::stoi(line.substr(place + 9));
  }
  ~Program() { end(SIGKILL); }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  int end(int signal) {
    if (child_ <= 0) return -1;
    kill(child_, signal);
    int status = 0;
    waitpid(child_, &status, 0);
    child_ = -1;
    return status;
  }

  std::uint16_t port = 0;
  std::string token;
  int number = 0;

 private:
  pid_t child_ = -1;
};

/// The next text of that kind.
json read_kind(WebSocketClient& client, const std::string& kind) {
  while (const auto message = client.read()) {
    if (message->binary) continue;
    json text = json::parse(message->bytes);
    if (text["kind"] == kind) return text;
  }
  return {{"kind", "nothing"}, {"grammar", ""}};
}

json opened(WebSocketClient& client, int project) {
  client.send_frame(json{{"kind", "open_project"}, {"project", project}}.dump());
  return read_kind(client, "document");
}

TEST(StudioVerb, WhatWasAnsweredSurvivesBeingKilled) {
  const TemporaryFolder folder;
  const std::string data = folder.file("data/studio.sqlite");
  RandomStream random({2, Purpose::test});
  int acknowledged = 0, sent = 0;
  for (int round = 0; round < 5; ++round) {
    Program program(data);
    ASSERT_NE(program.port, 0);
    WebSocketClient client(program.port, program.token);
    const json document = opened(client, program.number);
    if (round > 0) {
      const std::string grammar = document["grammar"];
      const int kept = std::stoi(grammar.substr(grammar.rfind('#') + 1));
      EXPECT_GE(kept, acknowledged);
      EXPECT_LE(kept, sent);
    }
    const int last = sent + 2 + static_cast<int>(random.below(20));
    while (acknowledged < last) {
      ++sent;
      const std::string grammar = "grammar a 1\nstart A\nrule A { emit box }\n#" + std::to_string(sent);
      client.send_frame(json{{"kind", "edit"}, {"request", sent}, {"label", "x"}, {"grammar", grammar}}.dump());
      json done;
      do {
        done = read_kind(client, "done");
        ASSERT_EQ(done["kind"], "done");
      } while (done.value("request", 0) != sent);
      acknowledged = sent;
    }
    // One more is on its way when it dies.
    ++sent;
    const std::string grammar = "grammar a 1\nstart A\nrule A { emit box }\n#" + std::to_string(sent);
    client.send_frame(json{{"kind", "edit"}, {"label", "x"}, {"grammar", grammar}}.dump());
    usleep(random.below(15'000));
    program.end(SIGKILL);
  }
}

TEST(StudioVerb, NoRatingThatWasAnsweredIsLostWhereItIsKilledWhileItBreeds) {
  const TemporaryFolder folder;
  const std::string data = folder.file("data/studio.sqlite");
  RandomStream random({3, Purpose::test});
  const auto done = [](WebSocketClient& client, int request) {
    json answer;
    do {
      answer = read_kind(client, "done");
      if (answer["kind"] != "done") return false;
    } while (answer.value("request", 0) != request);
    return true;
  };
  int rating = 0, sent = 0, number = 0;
  std::int64_t rated = 0;
  for (int round = 0; round < 4; ++round) {
    Program program(data);
    ASSERT_NE(program.port, 0);
    WebSocketClient client(program.port, program.token);
    opened(client, program.number);
    json breeding;
    if (round == 0) {
      client.send_frame(json{{"kind", "start_breeding"}, {"settings", {{"population", 9}}}, {"from", "nothing"}}.dump());
      breeding = read_kind(client, "breeding");
    } else {
      client.send_frame(json{{"kind", "open_breeding"}, {"session", 1}}.dump());
      breeding = read_kind(client, "breeding");
      // Breeding that was under way is done or not; what was rated before it, in the generation that was rated, stays rated.
      client.send_frame(json{{"kind", "go_to_generation"}, {"request", ++number}, {"generation", 1}}.dump());
      while (breeding["generation"] != 1) breeding = read_kind(client, "breeding");
      double kept = 0;
      for (const json& one : breeding["individuals"]) {
        if (one["id"] == rated) kept = one.value("rating", 0.0);
      }
      EXPECT_GE(kept, rating);
      EXPECT_LE(kept, sent);
    }
    rated = breeding["individuals"][0]["id"];
    const int last = sent + 2 + static_cast<int>(random.below(12));
    while (rating < last) {
      ++sent;
      client.send_frame(json{{"kind", "rate"}, {"request", ++number}, {"ratings", {{{"individual", rated}, {"rating", sent}}}}}.dump());
      ASSERT_TRUE(done(client, number));
      rating = sent;
    }
    // One more is on its way, and a generation, when it dies.
    ++sent;
    client.send_frame(json{{"kind", "rate"}, {"ratings", {{{"individual", rated}, {"rating", sent}}}}}.dump());
    client.send_frame(json{{"kind", "breed"}}.dump());
    usleep(random.below(40'000));
    program.end(SIGKILL);
  }
}

TEST(StudioVerb, TheOldLinkWorksAfterItWasKilledAndStartedAgain) {
  const TemporaryFolder folder;
  const std::string data = folder.file("studio.sqlite");
  Program program(data);
  ASSERT_NE(program.port, 0);
  const std::uint16_t port = program.port;
  const std::string token = program.token;
  EXPECT_EQ(WebSocketClient(port, token).status(), 101);
  program.end(SIGKILL);
  Program again(data, port);
  ASSERT_EQ(again.port, port);
  EXPECT_EQ(again.token, token);
  WebSocketClient client(port, token);
  EXPECT_EQ(opened(client, program.number)["project"]["name"], "p");
  again.end(SIGKILL);
  Program other(data, 0, "--new-token");
  ASSERT_NE(other.port, 0);
  EXPECT_NE(other.token, token);
  EXPECT_EQ(WebSocketClient(other.port, token).status(), 403);
  EXPECT_EQ(WebSocketClient(other.port, other.token).status(), 101);
  Program elsewhere(folder.file("other.sqlite"));
  EXPECT_NE(elsewhere.token, other.token);
}

TEST(StudioVerb, ASceneBecomesAProject) {
  const TemporaryFolder folder;
  const std::string scene = std::string(ESPALIER_SOURCE_DIR) + "/scenes/spaceship.toml";
  for (const char* name : {"spaceship", "spaceship 2"}) {
    Program program(folder.file("studio.sqlite"), 0, nullptr, scene.c_str());
    ASSERT_NE(program.port, 0);
    WebSocketClient client(program.port, program.token);
    const json document = opened(client, program.number);
    EXPECT_EQ(document["project"]["name"], name);
    EXPECT_EQ(document["files"].size(), 1u);
    EXPECT_TRUE(document["scene"].contains("volume"));
    EXPECT_EQ(program.end(SIGTERM), 0);
  }
  Program none(folder.file("studio.sqlite"), 0, nullptr, "no-such.esp");
  EXPECT_EQ(none.port, 0);
  const int status = none.end(0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) != 0);
}

TEST(StudioVerb, EndsInOrderWhenAsked) {
  const TemporaryFolder folder;
  Program program(folder.file("studio.sqlite"));
  ASSERT_NE(program.port, 0);
  WebSocketClient client(program.port, program.token);
  EXPECT_EQ(opened(client, program.number)["project"]["name"], "p");
  const int status = program.end(SIGTERM);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace
}  // namespace espalier::studio
