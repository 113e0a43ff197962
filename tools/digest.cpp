// scarf digest: the final state, image and stream of a recording as three lines of text.
#include "scarf/digest/digest.h"

#include <iostream>

#include "compare/state_dump.h"
#include "core/text.h"
#include "session/play.h"
#include "session/progress.h"
#include "session/request.h"
#include "tools/commands.h"
#include "tools/options.h"

namespace scarf::tools {
namespace {

struct DigestOptions {
  StreamRequest stream;
  std::string dump;
};

Result<int> digest(const DigestOptions& options, const OutputRule& rule) {
  if (!options.dump.empty()) {
    if (auto r = rule.check(options.dump); !r) return r.error();
  }
  auto recording = open_recording(options.stream);
  if (!recording) return recording.error();
  const auto implementation = make_implementation(options.stream, recording->sensor);
  if (!implementation) return implementation.error();
  Representation& representation = *implementation->representation;

  EventDigest events;
  {
    Progress progress(*recording->source);
    const auto take = [&](std::span<const Event> batch) -> Result<void> {
      for (const Event& e : batch) events.add(e);
      const auto pushed = representation.push(batch);
      if (!pushed) return pushed.error();
      progress.add(batch.size());
      return {};
    };
    const auto played = play(*recording->source, {.batches = options.stream.batches}, {.events = take});
    if (!played) return played.error();
  }
  if (auto r = require_events(options.stream.file, recording->source->report(), options.stream.allow_empty);
      !r) {
    return r.error();
  }
  const auto state = representation.state().wait();
  if (!state) return state.error();
  const auto image = representation.u8_image().wait();
  if (!image) return image.error();
  if (!options.dump.empty()) {
    auto* const scarf = dynamic_cast<Scarf*>(&representation);
    if (scarf == nullptr) {
      return Error{ErrorCode::illegal_parameter,
                   text("--dump is offered for scarf only; leave it out with --representation ",
                        options.stream.representation)};
    }
    const auto snapshot = scarf->snapshot().wait();
    if (!snapshot) return snapshot.error();
    if (auto r = write_state_dump(options.dump, *snapshot, rule); !r) return r.error();
  }
  const auto filtered = filter_lines(options.stream, representation);
  if (!filtered) return filtered.error();
  Digest of_state;
  of_state.add(*state);
  std::cout << text("state ", of_state.hex(), "\nimage ", image_digest(*image), "\nevents ", events.hex(),
                    "\n", *filtered);
  return 0;
}

}  // namespace

void add_digest(CLI::App& program, Command& command) {
  CLI::App* app =
      program.add_subcommand("digest", "SHA-256 of the final state, image and events of a recording");
  auto options = std::make_shared<DigestOptions>();
  add_settings(*app, stream_settings(options->stream));
  add_output_option(*app, "--dump", options->dump, "File for the hashed state, for scarf compare");
  app->callback([&command, app, options] {
    command.run = [app, options] { return digest(*options, output_rule(*app)); };
  });
}

}  // namespace scarf::tools
