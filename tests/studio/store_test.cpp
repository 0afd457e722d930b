#include "studio/store.h"
#include "studio/breeding_store.h"

#include <csignal>
#include <fstream>

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gmock/gmock.h>

#include "base/error.h"
#include "base/hash.h"
#include "base/random.h"
#include "run/temporary_folder.h"

namespace espalier::studio {
namespace {

using testing::HasSubstr;

class StoreTest : public testing::Test {
 protected:
  StoreTest() { open(); }
  void open() {
    store_.reset();
    store_ = std::make_unique<Store>(path());
  }
  std::string path() const { return folder_.file("studio.sqlite"); }
  StoredProjectState edit(std::int64_t project, const std::string& grammar, const std::string& gesture = "") {
    StoredState state = store_->open(project).state;
    state.grammar = grammar;
    return store_->edit(project, state, {.label = "to " + grammar, .gesture = gesture});
  }

  TemporaryFolder folder_;
  std::unique_ptr<Store> store_;
};

TEST_F(StoreTest, ProjectsAreMadeNamedCopiedAndDeleted) {
  const std::int64_t one = store_->create("Tree", {.grammar = "grammar a 1"}, {});
  const std::int64_t two = store_->create("Tree", {}, {});
  EXPECT_EQ(store_->open(two).project.name, "Tree 2");
  store_->rename(two, "Bush");
  edit(one, "b");
  const std::string picture = "\xff\xd8\xff bytes";
  store_->add_favourite(one, {.score = 1.5, .genes = 3, .words = "w", .derivation = "{}", .picture = picture});
  const std::int64_t three = store_->duplicate(one);
  EXPECT_EQ(store_->open(three).project.name, "Tree copy");
  EXPECT_EQ(store_->open(three).state, store_->open(one).state);
  ASSERT_EQ(store_->favourites(three).size(), 1u);
  EXPECT_EQ(store_->favourite_picture(three, store_->favourites(three)[0].id), picture);
  EXPECT_EQ(store_->favourite_picture(one, store_->favourites(three)[0].id), "");  // of another project
  edit(three, "c");
  EXPECT_EQ(store_->open(one).state.grammar, "b");
  store_->remove(one);
  EXPECT_THROW(store_->open(one), Error);
  EXPECT_THROW(store_->remove(one), Error);
  EXPECT_THROW(store_->rename(one, "x"), Error);
  EXPECT_THROW(store_->create("  ", {}, {}), Error);
  open();
  EXPECT_EQ(store_->projects().size(), 2u);
  EXPECT_EQ(store_->undo(three)->now.state.grammar, "b");
}

TEST_F(StoreTest, UndoAndRedoGoThroughAllStepsAlsoAfterARestart) {
  const std::int64_t project = store_->create("a", {.grammar = "0"}, {});
  EXPECT_FALSE(store_->undo(project));
  for (const char* text : {"1", "2", "3"}) edit(project, text);
  EXPECT_EQ(store_->open(project).undo, "to 3");
  EXPECT_FALSE(store_->open(project).redo);
  EXPECT_EQ(store_->undo(project)->now.state.grammar, "2");
  open();
  const auto back = store_->undo(project);
  EXPECT_EQ(back->now.state.grammar, "1");
  EXPECT_EQ(back->now.undo, "to 1");
  EXPECT_EQ(back->now.redo, "to 2");
  EXPECT_EQ(store_->undo(project)->now.state.grammar, "0");
  EXPECT_FALSE(store_->undo(project));
  EXPECT_EQ(store_->redo(project)->now.state.grammar, "1");
  edit(project, "4");
  EXPECT_FALSE(store_->redo(project));
  EXPECT_EQ(store_->undo(project)->now.state.grammar, "1");
}

TEST_F(StoreTest, AGestureIsOneStep) {
  const std::int64_t project = store_->create("a", {.grammar = "0"}, {});
  for (const char* text : {"1", "2", "3"}) edit(project, text, "drag 7");
  edit(project, "4", "drag 8");
  EXPECT_EQ(store_->undo(project)->now.state.grammar, "3");
  EXPECT_EQ(store_->undo(project)->now.state.grammar, "0");
  EXPECT_EQ(store_->redo(project)->now.state.grammar, "3");
  // What undo went past is closed.
  edit(project, "5", "drag 7");
  EXPECT_EQ(store_->undo(project)->now.state.grammar, "3");
}

TEST_F(StoreTest, StepsByHandBringTheirModelsBack) {
  const std::int64_t project = store_->create("a", {.grammar = "0"}, {});
  const StoredState state = store_->open(project).state;
  store_->edit(project, state, {.label = "set", .gesture = "g", .model_before = "A", .model_after = "B"});
  store_->edit(project, state, {.label = "set", .gesture = "g", .model_before = "B", .model_after = "C"});
  EXPECT_EQ(store_->undo(project)->model, "A");
  EXPECT_EQ(store_->redo(project)->model, "C");
}

TEST_F(StoreTest, HistoryIsBoundedAndNothingIsKeptThatNoStateNames) {
  const std::int64_t project = store_->create("a", {.grammar = "start"}, {});
  const std::string bytes(1000, 'x');
  StoredState state = store_->open(project).state;
  state.files = {{.path = "a.obj", .hash = content_hash(bytes), .bytes = bytes.size()}};
  store_->edit(project, state, {.label = "file"}, {{content_hash(bytes), bytes}});
  EXPECT_EQ(store_->blob(project, content_hash(bytes)), bytes);
  state.files.clear();
  store_->edit(project, state, {.label = "no file"});
  for (int i = 0; i < Store::kMostSteps + 40; ++i) edit(project, std::to_string(i));
  int steps = 0;
  while (store_->undo(project)) ++steps;
  EXPECT_GE(steps, Store::kMostSteps);
  EXPECT_LE(steps, Store::kMostSteps + 16);
  EXPECT_THROW(store_->blob(project, content_hash(bytes)), Error);
  store_.reset();
  Database database(path());
  Statement count = database.prepare("select count(*) from text");
  count.step();
  EXPECT_LE(count.whole(0), Store::kMostSteps + 20);
}

TEST_F(StoreTest, AnEditThatCannotBeKeptChangesNothing) {
  const std::int64_t project = store_->create("a", {.grammar = "0"}, {});
  StoredState state = store_->open(project).state;
  state.grammar = "1";
  state.files = {{.path = "a.obj", .hash = "nothing"}};
  EXPECT_THROW(store_->edit(project, state, {.label = "bad"}), Error);
  EXPECT_EQ(store_->open(project).state.grammar, "0");
  EXPECT_FALSE(store_->undo(project));
}

TEST_F(StoreTest, NewerAndDamagedFilesAndThoseInUseAreRefused) {
  EXPECT_THAT([&] { Store other(path()); }, testing::ThrowsMessage<Error>(HasSubstr("another studio")));
  store_.reset();
  {
    Database database(path());
    database.run("pragma user_version = 99");
  }
  EXPECT_THAT([&] { open(); }, testing::ThrowsMessage<Error>(HasSubstr("version 99")));
  const std::string damaged = folder_.file("damaged.sqlite");
  std::ofstream(damaged) << "This is no database at all, but a text that is long enough to look like a header.";
  EXPECT_THROW(Store{damaged}, Error);
  EXPECT_THROW(Store{folder_.file("no/such/folder.sqlite")}, Error);
}

TEST_F(StoreTest, SettingsAreKeptAndOnlyTheOwnerMayRead) {
  EXPECT_FALSE(store_->setting("a"));
  store_->set_setting("a", "1");
  store_->set_setting("a", "2");
  store_->set_setting("b", "3");
  const auto mode = [](const std::string& file) {
    struct stat about {};
    return stat(file.c_str(), &about) == 0 ? about.st_mode & 0777 : 0;
  };
  EXPECT_EQ(mode(path()), 0600u);
  EXPECT_EQ(mode(path() + "-wal"), 0600u);
  store_.reset();
  chmod(path().c_str(), 0644);
  open();
  EXPECT_EQ(mode(path()), 0600u);
  EXPECT_EQ(store_->setting("a"), "2");
  EXPECT_EQ(store_->setting("b"), "3");
}

TEST_F(StoreTest, FilesOfEarlierVersionsAreBroughtUpToDate) {
  const std::int64_t project = store_->create("a", {.grammar = "0"}, {});
  store_->add_favourite(project, {.score = 1, .genes = 3, .words = "w", .derivation = "{}"});
  const std::string no_breeding =
      "drop table breeding_change; drop table breeding_step; drop table breeding_comparison; drop table breeding_rating; "
      "drop table breeding_lineage; drop table breeding_individual; drop table breeding_generation; drop table breeding_text; "
      "drop table breeding_session; ";
  const std::string older[] = {
      no_breeding + "drop table setting; alter table favourite drop column picture; pragma user_version = 1",
      no_breeding + "alter table favourite drop column picture; pragma user_version = 2",
      no_breeding + "pragma user_version = 3"};
  for (const std::string& version : older) {
    store_.reset();
    Database(path()).run(version.c_str());
    open();
    EXPECT_EQ(store_->open(project).state.grammar, "0");
    ASSERT_EQ(store_->favourites(project).size(), 1u);
    EXPECT_EQ(store_->favourites(project)[0].picture, "");
    EXPECT_EQ(BreedingStore(*store_).list(project).size(), 0u);
    store_->add_favourite(project, {.score = 2, .genes = 1, .words = "", .derivation = "{}", .picture = "\xff\xd8\xff"});
    store_->remove_favourite(project, store_->favourites(project)[1].id);
    store_->set_setting("a", version);
    open();
    EXPECT_EQ(store_->setting("a"), version);
  }
}

/// Edits as fast as it can and says each number once its edit is done, until it is killed.
[[noreturn]] void edit_until_killed(const std::string& path, std::int64_t project, int from, int pipe) {
  Store store(path);
  for (int i = from;; ++i) {
    StoredState state = store.open(project).state;
    state.grammar = std::string(static_cast<std::size_t>(i % 5000), 'g') + std::to_string(i);
    store.edit(project, state, {.label = std::to_string(i), .gesture = i % 3 == 0 ? "g" : ""});
    if (write(pipe, &i, sizeof(i)) != sizeof(i)) _exit(1);
  }
}

TEST_F(StoreTest, KilledAtAnyMomentNothingAcknowledgedIsLost) {
  const std::int64_t project = store_->create("a", {.grammar = "0"}, {});
  RandomStream random({1, Purpose::test});
  int from = 1, acknowledged = 0;
  for (int round = 0; round < 12; ++round) {
    store_.reset();
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      close(ends[0]);
      edit_until_killed(path(), project, from, ends[1]);
    }
    close(ends[1]);
    int number = 0;
    ASSERT_EQ(read(ends[0], &number, sizeof(number)), static_cast<ssize_t>(sizeof(number)));  // it works
    acknowledged = number;
    usleep(random.below(30'000));
    kill(child, SIGKILL);
    while (read(ends[0], &number, sizeof(number)) == static_cast<ssize_t>(sizeof(number))) acknowledged = number;
    close(ends[0]);
    waitpid(child, nullptr, 0);
    open();
    const std::string grammar = store_->open(project).state.grammar;
    const std::size_t digits = grammar.find_first_not_of('g');
    const int kept = std::stoi(grammar.substr(digits));
    EXPECT_GE(kept, acknowledged);
    EXPECT_LE(kept, acknowledged + 1);
    EXPECT_EQ(digits, static_cast<std::size_t>(kept % 5000));
    from = kept + 1;
  }
  EXPECT_GT(acknowledged, 20);
}

}  // namespace
}  // namespace espalier::studio
