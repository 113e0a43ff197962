// SQLite databases of unknown origin, for reading: what they hold is read, and nothing else happens. They
// compute nothing, take no more steps than their size explains, and no file appears beside them. Needs
// SQLite.
#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "scarf/core/result.h"

namespace scarf {

class SqliteFile {
 public:
  struct FinishStatement {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  };
  /// Finished before its SqliteFile.
  using Statement = std::unique_ptr<sqlite3_stmt, FinishStatement>;

  /// Errors: io, for what is no regular file, or has something beside it with the name of a journal that is
  /// none; bad_input.
  static Result<SqliteFile> open(const std::string& path);

  /// The rows of a table, with these columns, in the order of the first one if `ordered`. `what`: what this
  /// is, for the message. Errors: unrecognised: there is no such table, or column; bad_input, also for
  /// columns that are computed.
  Result<Statement> rows(const std::string& table, const std::vector<std::string>& columns, bool ordered,
                         std::string_view what) const;

  /// The next row; false at the end. Errors: bad_input, saying why; also if the rows are more than the file
  /// can hold.
  Result<bool> next(sqlite3_stmt* rows);

  /// Of the database and what was written but not yet moved into it.
  uint64_t bytes() const { return bytes_; }

 private:
  struct Close {
    void operator()(sqlite3* database) const { sqlite3_close(database); }
  };
  struct Steps {
    uint64_t left = 0;
  };

  Error refused(std::string_view what) const;
  Statement prepare(const std::string& query) const;

  std::unique_ptr<Steps> steps_;  // destroyed behind the database, which counts them
  std::unique_ptr<sqlite3, Close> database_;
  uint64_t bytes_ = 0;
  uint64_t given_ = 0;  // rows and their bytes
};

}  // namespace scarf
