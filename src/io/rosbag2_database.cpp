// Reader of the databases of rosbag2 (sqlite3). Source: rosbag2_storage_sqlite3, its tables.

#include <filesystem>
#include <map>
#include <memory>
#include <utility>

#include "core/text.h"
#include "io/decompressor.h"
#include "io/ros_bag.h"

#ifdef SCARF_HAS_SQLITE
#include <sqlite3.h>
#endif

namespace scarf {

#ifdef SCARF_HAS_SQLITE
namespace {

struct CloseDatabase {
  void operator()(sqlite3* database) const { sqlite3_close(database); }
};
struct FinishStatement {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Database = std::unique_ptr<sqlite3, CloseDatabase>;
using Statement = std::unique_ptr<sqlite3_stmt, FinishStatement>;

class Rosbag2Database final : public RosBag {
 public:
  struct Topic {
    std::string name;
    RosType type = RosType::event_packet;
  };

  Rosbag2Database(Database database, Statement messages, std::map<int64_t, Topic> topics, uint64_t total)
      : database_(std::move(database)),
        messages_(std::move(messages)),
        topics_(std::move(topics)),
        total_(total) {}

  Result<std::optional<RosMessage>> next() override {
    while (!ended_) {
      const int state = sqlite3_step(messages_.get());
      if (state == SQLITE_DONE) {
        ended_ = true;
        break;
      }
      RosMessage message;
      message.byte = bytes_read_;
      if (state != SQLITE_ROW) {
        ended_ = true;
        message.damage = text("the database cannot be read behind message ", last_id_, ": ",
                              sqlite3_errmsg(database_.get()));
        return std::optional(std::move(message));
      }
      last_id_ = sqlite3_column_int64(messages_.get(), 0);
      const auto topic = topics_.find(sqlite3_column_int64(messages_.get(), 1));
      const int size = sqlite3_column_bytes(messages_.get(), 2);
      bytes_read_ += static_cast<uint64_t>(size);
      if (topic == topics_.end()) continue;
      message.topic = topic->second.name;
      message.type = topic->second.type;
      message.serialization = RosSerialization::cdr;
      message.bytes = {static_cast<const uint8_t*>(sqlite3_column_blob(messages_.get(), 2)),
                       static_cast<size_t>(size)};
      return std::optional(std::move(message));
    }
    bytes_read_ = total_;
    return std::optional<RosMessage>();
  }

  uint64_t bytes_read() const override { return bytes_read_; }
  uint64_t bytes_total() const override { return total_; }

 private:
  Database database_;
  Statement messages_;  // destroyed before its database
  std::map<int64_t, Topic> topics_;
  uint64_t total_;
  uint64_t bytes_read_ = 0;  // of messages
  int64_t last_id_ = 0;
  bool ended_ = false;
};

Error refused(sqlite3* database, std::string_view what) {
  return {ErrorCode::bad_input, text("SQLite cannot ", what, ": ", sqlite3_errmsg(database))};
}

}  // namespace

Result<std::unique_ptr<RosBag>> open_rosbag2_database(const std::string& path) {
  sqlite3* handle = nullptr;
  const int opened = sqlite3_open_v2(path.c_str(), &handle, SQLITE_OPEN_READONLY, nullptr);
  Database database(handle);
  if (opened != SQLITE_OK) return refused(handle, "open the file");
  // A hostile schema computes nothing, and no message is larger than what is unpacked elsewhere.
  sqlite3_db_config(handle, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_limit(handle, SQLITE_LIMIT_LENGTH, static_cast<int>(Decompressor::kLimit));

  const auto prepare = [&](const char* query) {
    sqlite3_stmt* statement = nullptr;
    sqlite3_prepare_v2(handle, query, -1, &statement, nullptr);
    return Statement(statement);
  };
  const Statement list = prepare("SELECT id, name, type, serialization_format FROM topics");
  if (!list) {
    Error error = refused(handle, "find the topics of a ROS 2 bag");
    // A sound database without them is of another program.
    if (sqlite3_errcode(handle) == SQLITE_ERROR) error.code = ErrorCode::unrecognised;
    return error;
  }
  std::map<int64_t, Rosbag2Database::Topic> topics;
  int state = sqlite3_step(list.get());
  for (; state == SQLITE_ROW; state = sqlite3_step(list.get())) {
    const auto word = [&](int column) {
      const auto* const characters = reinterpret_cast<const char*>(sqlite3_column_text(list.get(), column));
      return std::string(characters != nullptr ? characters : "");
    };
    const auto type = ros_type(word(2));
    if (!type || topics.size() >= kMaxRosTopics) continue;
    if (word(3) != "cdr") {
      return Error{ErrorCode::bad_input,
                   text("the messages on ", word(1), " have the encoding '", word(3), "'; scarf reads cdr")};
    }
    topics.insert_or_assign(sqlite3_column_int64(list.get(), 0), Rosbag2Database::Topic{word(1), *type});
  }
  if (state != SQLITE_DONE) return refused(handle, "read the topics");
  // In the order of recording, which needs no sorting.
  Statement messages = prepare("SELECT id, topic_id, data FROM messages ORDER BY id");
  if (!messages) return refused(handle, "find the messages of a ROS 2 bag");
  std::error_code ignored;
  const auto size = std::filesystem::file_size(path, ignored);
  return std::unique_ptr<RosBag>(std::make_unique<Rosbag2Database>(std::move(database), std::move(messages),
                                                                   std::move(topics), ignored ? 0 : size));
}
#else
Result<std::unique_ptr<RosBag>> open_rosbag2_database(const std::string&) {
  return Error{ErrorCode::bad_input,
               "this build of scarf has no SQLite (Debian: libsqlite3-dev); install it and build again"};
}
#endif

}  // namespace scarf
