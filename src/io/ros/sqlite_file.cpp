#include "io/ros/sqlite_file.h"

#include <unistd.h>

#include <array>
#include <cctype>
#include <cerrno>
#include <filesystem>
#include <iterator>
#include <system_error>
#include <utility>

#include "core/regular_file.h"
#include "core/text.h"
#include "io/base/decompressor.h"

namespace scarf {
namespace {

namespace fs = std::filesystem;

// Of the virtual machine, between two looks at how many there were; and how many a file may take: a row takes
// fewer than there are bytes in the smallest one times this.
constexpr int kStepsAtOnce = 1000;
constexpr uint64_t kStepsOfSmallFile = 1'000'000;
constexpr uint64_t kStepsPerByte = 32;

// Size of a file that may be absent. Errors: io, for what is no regular file.
Result<uint64_t> size_beside(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) return uint64_t{0};
  if (const auto r = require_regular(path); !r)
    return Error{r.error().code, text(path, ": ", r.error().message)};
  const uint64_t size = fs::file_size(path, error);
  return error ? Error{ErrorCode::io, text(path, ": ", error.message())} : Result<uint64_t>(size);
}

// Whether the database was left in the mode in which SQLite writes ahead, into a -wal beside it.
Result<bool> writes_ahead(const std::string& path) {
  constexpr size_t kReadVersion = 19;  // where the file says so, and what it says
  constexpr char kAhead = 2;
  const auto file = open_regular(path);
  if (!file) return file.error();
  std::array<char, kReadVersion + 1> head{};
  const ssize_t count = pread(file->get(), head.data(), head.size(), 0);
  if (count < 0) {
    return Error{ErrorCode::io, text("cannot read: ", std::generic_category().message(errno))};
  }
  return count == std::ssize(head) && head[kReadVersion] == kAhead;
}

std::string uri_of(const std::string& path, std::string_view parameters) {
  constexpr std::string_view kHex = "0123456789ABCDEF";
  std::string uri = "file:";
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0 || c == '/' || c == '.' || c == '-' || c == '_') {
      uri += c;
    } else {
      uri += {'%', kHex[byte >> 4], kHex[byte & 15]};
    }
  }
  return text(uri, "?mode=ro", parameters);
}

}  // namespace

Result<SqliteFile> SqliteFile::open(const std::string& path) {
  std::error_code error;
  const std::string target = fs::canonical(path, error).string();  // beside which SQLite looks for journals
  if (error) return Error{ErrorCode::io, text("cannot open: ", error.message())};
  if (const auto r = require_regular(target); !r) return r.error();
  const auto database = size_beside(target);
  if (!database) return database.error();
  const auto ahead = size_beside(target + "-wal");
  if (!ahead) return ahead.error();
  const auto shared = size_beside(target + "-shm");
  if (!shared) return shared.error();
  if (const auto journal = size_beside(target + "-journal"); !journal) return journal.error();
  const auto mode = writes_ahead(target);
  if (!mode) return mode.error();

  // SQLite makes files beside a database whose mode is to write ahead, and leaves them there. If there is no
  // -wal, all is in the database. If there is one without -shm, nobody has it open, and its index can be in
  // our memory, where SQLite keeps it when nothing is locked. A database that is open elsewhere has both.
  std::string parameters;
  const bool alone = *ahead > 0 && *shared == 0 && sqlite3_vfs_find("unix-none") != nullptr;
  if (alone) {
    parameters = "&vfs=unix-none";
  } else if (*ahead == 0 && (*mode || fs::exists(target + "-wal", error))) {
    parameters = "&immutable=1";
  }
  SqliteFile made;
  made.bytes_ = *database + *ahead;
  made.steps_ = std::make_unique<Steps>();
  made.steps_->left = kStepsOfSmallFile + kStepsPerByte * made.bytes_;
  sqlite3* handle = nullptr;
  const int opened = sqlite3_open_v2(uri_of(target, parameters).c_str(), &handle,
                                     SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
  made.database_.reset(handle);
  if (opened != SQLITE_OK) return made.refused("open the file");
  const auto count_steps = [](void* counted) {
    uint64_t& left = static_cast<Steps*>(counted)->left;
    if (left < kStepsAtOnce) return 1;
    left -= kStepsAtOnce;
    return 0;
  };
  sqlite3_progress_handler(handle, kStepsAtOnce, count_steps, made.steps_.get());
  sqlite3_drop_modules(handle, nullptr);  // no virtual tables
  sqlite3_db_config(handle, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
  sqlite3_limit(handle, SQLITE_LIMIT_LENGTH, static_cast<int>(Decompressor::kLimit));
  sqlite3_exec(handle, "PRAGMA cell_size_check=ON", nullptr, nullptr, nullptr);
  if (alone) sqlite3_exec(handle, "PRAGMA locking_mode=EXCLUSIVE", nullptr, nullptr, nullptr);
  return made;
}

Result<SqliteFile::Statement> SqliteFile::rows(const std::string& table,
                                               const std::vector<std::string>& columns, bool ordered,
                                               std::string_view what) const {
  const Statement described = prepare(text("PRAGMA table_xinfo(", table, ")"));
  int state = described ? SQLITE_ROW : SQLITE_ERROR;
  while (described && (state = sqlite3_step(described.get())) == SQLITE_ROW) {
    constexpr int kName = 1;
    constexpr int kHidden = 6;
    const auto* const name = reinterpret_cast<const char*>(sqlite3_column_text(described.get(), kName));
    if (name == nullptr || sqlite3_column_int(described.get(), kHidden) == 0) continue;
    for (const std::string& column : columns) {
      if (sqlite3_stricmp(name, column.c_str()) != 0) continue;
      return Error{ErrorCode::bad_input,
                   text("the database computes ", table, ".", column,
                        " instead of storing it, which no recorder does; it is not read")};
    }
  }
  if (state != SQLITE_DONE) return refused(text("find ", what));
  std::string query = "SELECT ";
  for (const std::string& column : columns) query += text(&column == columns.data() ? "" : ", ", column);
  query += text(" FROM ", table, ordered ? " ORDER BY " : "", ordered ? columns.front() : "");
  Statement rows = prepare(query);
  if (rows) return rows;
  Error error = refused(text("find ", what));
  // A sound database without them is of another program.
  if (sqlite3_errcode(database_.get()) == SQLITE_ERROR) error.code = ErrorCode::unrecognised;
  return error;
}

Result<bool> SqliteFile::next(sqlite3_stmt* rows) {
  const int state = sqlite3_step(rows);
  if (state == SQLITE_DONE) return false;
  if (state == SQLITE_INTERRUPT) {
    return Error{ErrorCode::bad_input, "it takes more steps to read than a database of its size should"};
  }
  if (state != SQLITE_ROW) return refused("read the rows");
  ++given_;
  for (int i = 0; i < sqlite3_column_count(rows); ++i) {
    const int type = sqlite3_column_type(rows, i);
    if (type != SQLITE_TEXT && type != SQLITE_BLOB) continue;
    given_ += static_cast<uint64_t>(sqlite3_column_bytes(rows, i));
  }
  // Damaged or made so, pages can belong to several rows.
  if (given_ > bytes_) return Error{ErrorCode::bad_input, "its rows have more bytes than the whole database"};
  return true;
}

Error SqliteFile::refused(std::string_view what) const {
  const int why = sqlite3_errcode(database_.get()) & 0xFF;  // of extended codes
  const bool unreadable = why == SQLITE_IOERR || why == SQLITE_CANTOPEN;
  return {unreadable ? ErrorCode::io : ErrorCode::bad_input,
          text("SQLite cannot ", what, ": ", sqlite3_errmsg(database_.get()))};
}

SqliteFile::Statement SqliteFile::prepare(const std::string& query) const {
  sqlite3_stmt* statement = nullptr;
  sqlite3_prepare_v2(database_.get(), query.c_str(), -1, &statement, nullptr);
  return Statement(statement);
}

}  // namespace scarf
