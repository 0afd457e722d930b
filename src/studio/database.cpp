#include "studio/database.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include "base/error.h"

namespace espalier::studio {

Database::Database(const std::string& path) : path_(path) {
  const int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX;
  if (sqlite3_open_v2(path.c_str(), &handle_, flags, nullptr) != SQLITE_OK) {
    const std::string why = handle_ ? sqlite3_errmsg(handle_) : "out of memory";
    sqlite3_close(handle_);
    throw Error(fmt::format("{}: cannot be opened: {}", path, why));
  }
  try {
    sqlite3_extended_result_codes(handle_, 1);
    sqlite3_busy_timeout(handle_, 2000);
    run("pragma journal_mode = wal; pragma synchronous = full; pragma foreign_keys = on; pragma trusted_schema = off");
  } catch (...) {
    sqlite3_close(handle_);
    throw;
  }
}

Database::~Database() { sqlite3_close(handle_); }

void Database::fail() const { throw Error(fmt::format("{}: {}", path_, sqlite3_errmsg(handle_))); }

void Database::run(const char* statements) {
  if (sqlite3_exec(handle_, statements, nullptr, nullptr, nullptr) != SQLITE_OK) fail();
}

Statement Database::prepare(std::string_view text) {
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(handle_, text.data(), static_cast<int>(text.size()), &statement, nullptr) != SQLITE_OK) fail();
  return {*this, statement};
}

bool Database::in_transaction() const { return sqlite3_get_autocommit(handle_) == 0; }
std::int64_t Database::last_row() const { return sqlite3_last_insert_rowid(handle_); }

Statement::~Statement() { sqlite3_finalize(handle_); }

Statement& Statement::bind(std::int64_t value) {
  if (sqlite3_bind_int64(handle_, ++bound_, value) != SQLITE_OK) database_.fail();
  return *this;
}

Statement& Statement::bind(double value) {
  if (sqlite3_bind_double(handle_, ++bound_, value) != SQLITE_OK) database_.fail();
  return *this;
}

Statement& Statement::bind(std::string_view text) {
  const char* const data = text.data() ? text.data() : "";
  if (sqlite3_bind_text64(handle_, ++bound_, data, text.size(), SQLITE_TRANSIENT, SQLITE_UTF8) != SQLITE_OK) {
    database_.fail();
  }
  return *this;
}

Statement& Statement::bind_blob(std::string_view bytes) {
  const char* const data = bytes.data() ? bytes.data() : "";
  if (sqlite3_bind_blob64(handle_, ++bound_, data, bytes.size(), SQLITE_TRANSIENT) != SQLITE_OK) database_.fail();
  return *this;
}

Statement& Statement::bind_maybe(const std::optional<std::string>& text) {
  if (text) return bind(std::string_view(*text));
  if (sqlite3_bind_null(handle_, ++bound_) != SQLITE_OK) database_.fail();
  return *this;
}

bool Statement::step() {
  const int result = sqlite3_step(handle_);
  if (result == SQLITE_ROW) return true;
  if (result != SQLITE_DONE) database_.fail();
  return false;
}

bool Statement::null(int column) const { return sqlite3_column_type(handle_, column) == SQLITE_NULL; }
std::int64_t Statement::whole(int column) const { return sqlite3_column_int64(handle_, column); }
double Statement::number(int column) const { return sqlite3_column_double(handle_, column); }

std::string Statement::text(int column) const {
  const void* const bytes = sqlite3_column_blob(handle_, column);
  const int size = sqlite3_column_bytes(handle_, column);
  return bytes ? std::string(static_cast<const char*>(bytes), static_cast<std::size_t>(size)) : "";
}

std::optional<std::string> Statement::maybe_text(int column) const {
  if (null(column)) return std::nullopt;
  return text(column);
}

Transaction::Transaction(Database& database) : database_(database), inner_(database.in_transaction()) {
  database_.run(inner_ ? "savepoint part" : "begin immediate");
}

void Transaction::commit() {
  database_.run(inner_ ? "release part" : "commit");
  done_ = true;
}

Transaction::~Transaction() {
  if (done_) return;
  try {
    if (inner_) database_.run("rollback to part"), database_.run("release part");
    else database_.run("rollback");
  } catch (const Error&) {  // a full disk has rolled it back already
  }
}

}  // namespace espalier::studio
