#include "gpu/stream_group.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace scarf {

using vulkan::Commands;

// Pictures in flight.
struct StreamGroup::Lease {
  struct Picture {
    size_t first_result = 0;
    size_t results = 0;
    std::function<Result<Image<uint8_t>>(HostParts)> read;
  };

  std::shared_ptr<StreamGroup> group;
  std::unique_ptr<Query> query;
  std::vector<Picture> pictures;

  ~Lease() {
    std::lock_guard lock(group->mutex_);
    if (query) group->query_pool_.give_back(std::move(query));
  }

  Result<std::vector<Image<uint8_t>>> wait() const {
    if (auto r = query->commands.wait(); !r) return r.error();
    std::vector<Image<uint8_t>> images;
    for (const Picture& picture : pictures) {
      std::vector<const void*> parts;
      for (size_t i = 0; i < picture.results; ++i)
        parts.push_back(query->results[picture.first_result + i].mapped());
      auto image = picture.read(parts);
      if (!image) return image.error();
      images.push_back(*std::move(image));
    }
    return images;
  }
};

StreamGroup::StreamGroup(std::shared_ptr<GpuContext> context)
    : context_(std::move(context)), device_(context_->vulkan()) {}

StreamGroup::~StreamGroup() {
  // Nothing may be destroyed while the device uses it; see ~Stream.
  const bool idle =
      device_.compute().wait(last_submission_).ok() && device_.transfer().wait(last_transfer_).ok();
  if (!idle) device_.calls().DeviceWaitIdle(device_.handle());
}

Result<void> StreamGroup::add(const StreamFed& member) {
  const std::shared_ptr<Stream> stream = member.stream();
  std::lock_guard lock(mutex_);
  if (&stream->device() != &device_) {
    return Error{ErrorCode::illegal_parameter,
                 "the representation was made with another context; make it with that of the group"};
  }
  for (const Member& other : members_) {
    if (other.stream.lock() == stream)
      return Error{ErrorCode::illegal_parameter, "the representation is a member of this group already"};
  }
  members_.push_back({stream, member.u8_picture()});
  return {};
}

// Those destroyed since the last time are forgotten.
std::vector<StreamGroup::Locked> StreamGroup::lock_members() {
  std::vector<Locked> alive;
  std::erase_if(members_, [](const Member& member) { return member.stream.expired(); });
  for (const Member& member : members_) {
    if (auto stream = member.stream.lock()) alive.push_back({std::move(stream), &member.picture, {}});
  }
  std::vector<Locked*> ordered;
  for (Locked& member : alive) ordered.push_back(&member);
  std::sort(ordered.begin(), ordered.end(),
            [](const Locked* a, const Locked* b) { return std::less<>()(a->stream.get(), b->stream.get()); });
  for (Locked* member : ordered) member->lock = std::unique_lock(member->stream->mutex_);
  return alive;
}

Result<void> StreamGroup::flush() {
  std::lock_guard lock(mutex_);
  const auto members = lock_members();
  return submit_gathered(members);
}

Result<void> StreamGroup::finish() {
  uint64_t last = 0;
  {
    std::lock_guard lock(mutex_);
    const auto members = lock_members();
    if (auto r = submit_gathered(members); !r) return r;
    for (const Locked& member : members) last = std::max(last, member.stream->last_submission_);
  }
  return device_.compute().wait(last);
}

// Each stream's part reads and writes memory of that stream only, so parts may run side by side.
Result<void> StreamGroup::submit_gathered(std::span<const Locked> members) {
  Result<void> first_error;
  std::vector<Stream*> ready;
  for (const Locked& member : members) {
    const auto any = member.stream->prepare_gathered();
    if (!any && first_error) first_error = any.error();
    if (any && *any) ready.push_back(member.stream.get());
  }
  if (ready.empty()) return first_error;
  const auto upload = ready.front()->upload_;  // the same for all streams of a device
  auto commands = push_pool_.take([&] { return PushCommands::create(device_, upload); });
  if (!commands) return commands.error();
  PushCommands& push = **commands;
  stage_times_.collect(push.compute);
  const auto submitted = [&]() -> Result<void> {
    const auto copy_all = [&](Commands& c) {
      for (const Stream* stream : ready) stream->record_copies(c);
    };
    if (auto r = push.begin(upload, copy_all); !r) return r;
    for (Stream* stream : ready) {
      push.compute.begin_part();
      stream->record_open(push.compute);
    }
    return push.submit(device_);
  }();
  if (push.transferred != 0) {
    last_transfer_ = push.transferred;
    for (Stream* stream : ready) stream->last_transfer_ = push.transferred;
  }
  const uint64_t place = push.compute.value();
  // Also after a failure: the transfer may be in flight.
  push_pool_.give_back(std::move(*commands));
  if (!submitted) return submitted;
  last_submission_ = place;
  for (Stream* stream : ready) {
    stream->last_submission_ = place;
    stream->open_is_submitted();
  }
  return first_error;
}

Result<std::unique_ptr<Query>> StreamGroup::take_query() {
  auto query = query_pool_.take([this] { return Query::create(device_); });
  if (query) stage_times_.collect((*query)->commands);
  return query;
}

Result<void> StreamGroup::submit_pictures(std::span<const Locked> members, std::optional<int64_t> now,
                                          Lease& lease) {
  Query& q = *lease.query;
  size_t results = 0;
  if (auto r = q.commands.begin(); !r) return r;
  for (const Locked& member : members) {
    q.commands.begin_part();
    auto answer = member.picture->record(q, member.stream->facts_, now);
    if (!answer) return answer.error();
    if (auto r = q.copy_back(device_, answer->parts, results); !r) return r;
    lease.pictures.push_back({results, answer->parts.size(), std::move(answer->read)});
    results += answer->parts.size();
  }
  if (auto r = q.commands.submit(); !r) return r;
  last_submission_ = q.commands.value();
  for (const Locked& member : members) member.stream->last_submission_ = last_submission_;
  return {};
}

Pending<std::vector<Image<uint8_t>>> StreamGroup::u8_images(std::optional<int64_t> now) {
  const auto lease = std::make_shared<Lease>();  // outlives the lock, which its destructor takes
  lease->group = shared_from_this();
  std::lock_guard lock(mutex_);
  const auto members = lock_members();
  if (members.empty()) return std::vector<Image<uint8_t>>();
  if (auto r = submit_gathered(members); !r) return r.error();
  auto query = take_query();
  if (!query) return query.error();
  lease->query = std::move(*query);
  const uint64_t bytes_before = lease->query->memory_bytes();
  if (auto r = submit_pictures(members, now, *lease); !r) {
    // What was recorded for a member, and changes its state, does not get to the device.
    for (size_t i = 0; i < members.size() && i <= lease->pictures.size(); ++i) {
      if (members[i].picture->changes_state) members[i].stream->fail(r.error());
    }
    query_bytes_ -= bytes_before;
    lease->query.reset();
    return r.error();
  }
  query_bytes_ += lease->query->memory_bytes() - bytes_before;
  return Pending<std::vector<Image<uint8_t>>>(
      [lease] {
        const auto done = lease->query->commands.done();
        return !done || *done;
      },
      [lease] { return lease->wait(); });
}

std::vector<StageTime> StreamGroup::stage_times() {
  std::lock_guard lock(mutex_);
  stage_times_.collect_idle(push_pool_);
  stage_times_.collect_idle(query_pool_);
  return stage_times_.all();
}

uint64_t StreamGroup::memory_bytes() {
  std::lock_guard lock(mutex_);
  return query_bytes_;
}

namespace {

class DeviceGroup final : public GpuGroup {
 public:
  explicit DeviceGroup(std::shared_ptr<GpuContext> context)
      : group_(std::make_shared<StreamGroup>(std::move(context))) {}

  Result<void> add(GpuRepresentation& member) override {
    const auto* const fed = dynamic_cast<const StreamFed*>(&member);
    if (fed != nullptr) return group_->add(*fed);
    return Error{ErrorCode::illegal_parameter,
                 "this GpuRepresentation was not made by make_gpu_representation or make_gpu_scarf"};
  }
  Result<void> flush() override { return group_->flush(); }
  Result<void> finish() override { return group_->finish(); }
  Pending<std::vector<Image<uint8_t>>> u8_images(std::optional<int64_t> now) override {
    return group_->u8_images(now);
  }
  std::vector<StageTime> stage_times() const override { return group_->stage_times(); }
  uint64_t memory_bytes() const override { return group_->memory_bytes(); }

 private:
  const std::shared_ptr<StreamGroup> group_;
};

}  // namespace

std::unique_ptr<GpuGroup> make_gpu_group(std::shared_ptr<GpuContext> context) {
  return std::make_unique<DeviceGroup>(std::move(context));
}

}  // namespace scarf
