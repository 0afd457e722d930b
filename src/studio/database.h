#pragma once
// Database: SQLite with statements and transactions as values. Of one thread at a time.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace espalier::studio {

class Statement;

class Database {
 public:
  /// Opens or makes the file: WAL, every commit synced. Throws Error naming it.
  explicit Database(const std::string& path);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  /// One or several statements without values. Throws Error.
  void run(const char* statements);
  /// A statement that is kept and used again. Throws Error.
  Statement prepare(std::string_view text);
  std::int64_t last_row() const;
  bool in_transaction() const;

 private:
  friend class Statement;
  [[noreturn]] void fail() const;

  std::string path_;
  sqlite3* handle_ = nullptr;
};

/// Values are bound in the order of the question marks, columns are read by number. `step` is false after the last row.
class Statement {
 public:
  Statement(Database& database, sqlite3_stmt* handle) : database_(database), handle_(handle) {}
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  Statement& bind(std::int64_t value);
  Statement& bind(double value);
  Statement& bind(std::string_view text);
  Statement& bind_blob(std::string_view bytes);
  Statement& bind_maybe(const std::optional<std::string>& text);
  bool step();
  /// For statements that give no rows.
  void run() { step(); }

  bool null(int column) const;
  std::int64_t whole(int column) const;
  double number(int column) const;
  std::string text(int column) const;
  std::optional<std::string> maybe_text(int column) const;

 private:
  Database& database_;
  sqlite3_stmt* handle_;
  int bound_ = 0;
};

/// Undone at the end of the scope unless committed.
class Transaction {
 public:
  /// One within another is a part of it: what it did alone is taken back where it is not committed.
  explicit Transaction(Database& database);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  Database& database_;
  bool done_ = false, inner_ = false;
};

}  // namespace espalier::studio
