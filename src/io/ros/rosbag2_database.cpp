// Reader of the databases of rosbag2 (sqlite3). Source: rosbag2_storage_sqlite3, its tables.

#include <map>
#include <memory>
#include <utility>

#include "core/text.h"
#include "io/ros/ros_bag.h"

#ifdef SCARF_HAS_SQLITE
#include "io/ros/sqlite_file.h"
#endif

namespace scarf {

#ifdef SCARF_HAS_SQLITE
namespace {

class Rosbag2Database final : public RosBag {
 public:
  struct Topic {
    std::string name;
    RosType type = RosType::event_packet;
  };

  Rosbag2Database(SqliteFile database, SqliteFile::Statement messages, std::map<int64_t, Topic> topics)
      : database_(std::move(database)), messages_(std::move(messages)), topics_(std::move(topics)) {}

  Result<std::optional<RosMessage>> next() override {
    while (!ended_) {
      const auto row = database_.next(messages_.get());
      ended_ = !row || !*row;
      if (row && !*row) break;
      if (!row && row.error().code == ErrorCode::io) return row.error();
      RosMessage message;
      message.byte = bytes_read_;
      if (!row) {
        message.damage =
            text("the database cannot be read behind message ", last_id_, ": ", row.error().message);
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
    bytes_read_ = database_.bytes();
    return std::optional<RosMessage>();
  }

  uint64_t bytes_read() const override { return bytes_read_; }
  uint64_t bytes_total() const override { return database_.bytes(); }

 private:
  SqliteFile database_;
  SqliteFile::Statement messages_;  // destroyed before its database
  std::map<int64_t, Topic> topics_;
  uint64_t bytes_read_ = 0;  // of messages
  int64_t last_id_ = 0;
  bool ended_ = false;
};

}  // namespace

Result<std::unique_ptr<RosBag>> open_rosbag2_database(const std::string& path) {
  auto database = SqliteFile::open(path);
  if (!database) return database.error();
  const auto list = database->rows("topics", {"id", "name", "type", "serialization_format"}, false,
                                   "the topics of a ROS 2 bag");
  if (!list) return list.error();
  std::map<int64_t, Rosbag2Database::Topic> topics;
  sqlite3_stmt* const row = list->get();
  for (;;) {
    const auto found = database->next(row);
    if (!found) return Error{found.error().code, text("the topics cannot be read: ", found.error().message)};
    if (!*found) break;
    const auto word = [&](int column) {
      const auto* const characters = reinterpret_cast<const char*>(sqlite3_column_text(row, column));
      return std::string(characters != nullptr ? characters : "");
    };
    const auto type = ros_type(word(2));
    if (!type || topics.size() >= kMaxRosTopics) continue;
    if (word(3) != "cdr") {
      return Error{ErrorCode::bad_input,
                   text("the messages on ", word(1), " have the encoding '", word(3), "'; scarf reads cdr")};
    }
    topics.insert_or_assign(sqlite3_column_int64(row, 0), Rosbag2Database::Topic{word(1), *type});
  }
  // In the order of recording, which needs no sorting.
  auto messages = database->rows("messages", {"id", "topic_id", "data"}, true, "the messages of a ROS 2 bag");
  if (!messages) {
    const bool unreadable = messages.error().code == ErrorCode::io;
    return Error{unreadable ? ErrorCode::io : ErrorCode::bad_input, messages.error().message};
  }
  return std::unique_ptr<RosBag>(
      std::make_unique<Rosbag2Database>(*std::move(database), *std::move(messages), std::move(topics)));
}
#else
Result<std::unique_ptr<RosBag>> open_rosbag2_database(const std::string&) {
  return Error{ErrorCode::bad_input,
               "this build of scarf has no SQLite (Debian: libsqlite3-dev); install it and build again"};
}
#endif

}  // namespace scarf
