#include "io/base/streams.h"

#include "core/text.h"

namespace scarf {
namespace {

std::string list(std::span<const StreamName> streams) {
  constexpr size_t kMost = 20;
  std::string all;
  for (size_t i = 0; i < streams.size() && i < kMost; ++i) {
    all += text(i == 0 ? "" : ", ", streams[i].name, " (", streams[i].about, ")");
  }
  return streams.size() > kMost ? text(all, " and ", streams.size() - kMost, " more") : all;
}

}  // namespace

Result<size_t> choose_stream(const std::string& wanted, std::span<const StreamName> streams,
                             std::string_view what) {
  if (streams.empty()) return Error{ErrorCode::unrecognised, text("the recording has no ", what)};
  if (!wanted.empty()) {
    for (size_t i = 0; i < streams.size(); ++i) {
      if (streams[i].name == wanted) return i;
    }
    return Error{ErrorCode::illegal_parameter,
                 text("ReadOptions::stream ", wanted, " is not among the ", what, ": ", list(streams))};
  }
  if (streams.size() == 1) return size_t{0};
  return Error{ErrorCode::bad_input, text("the recording has several ", what,
                                          "; choose one with ReadOptions::stream: ", list(streams))};
}

}  // namespace scarf
