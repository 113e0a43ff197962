#include "reprocess/job.h"

#include <nlohmann/json.hpp>

namespace scarf::reprocess {
namespace {

using Json = nlohmann::json;

// CBOR rather than text: names of files need not be UTF-8.
Result<Json> parsed(const std::vector<uint8_t>& bytes) {
  Json json = Json::from_cbor(bytes, /*strict=*/true, /*allow_exceptions=*/false);
  if (!json.is_object()) return Error{ErrorCode::bad_input, "another process sent something unreadable"};
  return json;
}

}  // namespace

std::string name_of(Status status) {
  switch (status) {
    case Status::done:
      return "done";
    case Status::kept:
      return "finished before";
    case Status::skipped:
      return "skipped";
    case Status::failed:
      return "failed";
    case Status::left:
      return "not tried";
    case Status::identical:
      return "identical";
    case Status::differs:
      return "differs";
  }
  return {};
}

std::vector<uint8_t> bytes_of(const Task& task) {
  return Json::to_cbor({{"kind", task.kind},
                        {"relative", task.job.relative},
                        {"path", task.job.path},
                        {"settings", task.job.settings},
                        {"listed", task.job.listed},
                        {"bytes", task.job.bytes}});
}

std::vector<uint8_t> bytes_of(const Outcome& o) {
  return Json::to_cbor({{"relative", o.relative},
                        {"status", o.status},
                        {"message", o.message},
                        {"code", o.code},
                        {"events", o.events},
                        {"frames", o.frames},
                        {"bytes", o.bytes},
                        {"seconds", o.seconds}});
}

Result<Task> task_from(const std::vector<uint8_t>& bytes) {
  const auto json = parsed(bytes);
  if (!json) return json.error();
  return Task{(*json)["kind"].get<Task::Kind>(),
              {(*json)["relative"], (*json)["path"], (*json)["settings"].get<SettingWords>(),
               (*json)["listed"], (*json)["bytes"]}};
}

Result<Outcome> outcome_from(const std::vector<uint8_t>& bytes) {
  const auto json = parsed(bytes);
  if (!json) return json.error();
  return Outcome{(*json)["relative"], (*json)["status"].get<Status>(),
                 (*json)["message"],  (*json)["code"].get<ErrorCode>(),
                 (*json)["events"],   (*json)["frames"],
                 (*json)["bytes"],    (*json)["seconds"]};
}

}  // namespace scarf::reprocess
