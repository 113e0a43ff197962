#include "device/group.h"

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
    if (!query || group->device_.forked()) return;
    std::lock_guard lock(group->mutex_);
    group->query_pool_.give_back(std::move(query));
  }

  Result<Images> wait() const {
    if (auto r = group->device_.check_process(); !r) return r.error();
    if (auto r = query->commands.wait(); !r) return r.error();
    Images images;
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
  if (device_.forked()) return;
  // Nothing may be destroyed while the device uses it; see ~Stream.
  const bool idle =
      device_.compute().wait(last_submission_).ok() && device_.transfer().wait(last_transfer_).ok();
  if (!idle) device_.calls().DeviceWaitIdle(device_.handle());
}

template <class Call>
std::invoke_result_t<Call&> StreamGroup::exclusively(Call call) {
  using Answer = std::invoke_result_t<Call&>;
  return as_result([&]() -> Answer {
    if (auto r = device_.check_process(); !r) return r.error();
    std::lock_guard lock(mutex_);
    return call();
  });
}

Result<void> StreamGroup::add(const StreamFed& member) {
  return exclusively([&]() -> Result<void> {
    const std::shared_ptr<Stream> stream = member.stream();
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
  });
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
  return exclusively([&] {
    const auto members = lock_members();
    return submit_gathered(members);
  });
}

Result<void> StreamGroup::finish() {
  uint64_t last = 0;
  auto submitted = exclusively([&]() -> Result<void> {
    const auto members = lock_members();
    if (auto r = submit_gathered(members); !r) return r;
    for (const Locked& member : members) last = std::max(last, member.stream->last_submission_);
    return {};
  });
  return submitted ? device_.compute().wait(last) : submitted;
}

// Each stream's part reads and writes memory of that stream only, so parts may run side by side.
Result<void> StreamGroup::submit_gathered(std::span<const Locked> members) {
  Result<void> first_error;
  std::vector<Stream*> ready;
  for (const Locked& member : members) {
    const auto any = as_result([&] { return member.stream->prepare_gathered(); });
    if (!any && first_error) first_error = copy_of(any.error());
    if (any && *any) ready.push_back(member.stream.get());
  }
  if (ready.empty()) return first_error;
  const auto upload = ready.front()->upload_;  // the same for all streams of a device
  auto commands = push_pool_.take([&] { return PushCommands::create(device_, upload); });
  if (!commands) return commands.error();
  PushCommands& push = **commands;
  stage_times_.collect(push.compute);
  auto submitted = as_result([&]() -> Result<void> {
    const auto copy_all = [&](Commands& c) {
      for (const Stream* stream : ready) stream->record_copies(c);
    };
    if (auto r = push.begin(upload, copy_all); !r) return r;
    for (Stream* stream : ready) {
      push.compute.begin_part();
      stream->record_open(push.compute);
    }
    return push.submit(device_);
  });
  if (push.transferred != 0) {
    last_transfer_ = push.transferred;
    for (Stream* stream : ready) stream->last_transfer_ = push.transferred;
  }
  const uint64_t place = push.compute.value();
  // Also after a failure: the transfer may be in flight.
  push_pool_.give_back(std::move(*commands));
  if (!submitted) {
    for (Stream* stream : ready) stream->pipeline_->recording_lost();
    return submitted;
  }
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
  return as_result([&]() -> Pending<Images> {
    const auto lease = std::make_shared<Lease>();  // outlives the lock, which its destructor takes
    lease->group = shared_from_this();
    return exclusively([&]() -> Pending<Images> {
      const auto members = lock_members();
      if (members.empty()) return Images();
      if (auto r = submit_gathered(members); !r) return r.error();
      auto query = take_query();
      if (!query) return query.error();
      lease->query = std::move(*query);
      // Made first: behind the submission nothing may fail.
      Pending<Images> pending(
          [lease] {
            if (lease->group->device_.forked()) return true;
            const auto done = lease->query->commands.done();
            return !done || *done;
          },
          [lease] { return lease->wait(); });
      const uint64_t bytes_before = lease->query->memory_bytes();
      const auto submitted = as_result([&] { return submit_pictures(members, now, *lease); });
      query_bytes_ += lease->query->memory_bytes() - bytes_before;
      if (submitted) return pending;
      // What was recorded for a member, and changes its state, does not get to the device.
      for (size_t i = 0; i < members.size() && i <= lease->pictures.size(); ++i) {
        if (members[i].picture->changes_state) members[i].stream->fail(submitted.error());
      }
      return submitted.error();
    });
  });
}

std::vector<StageTime> StreamGroup::stage_times() {
  if (device_.forked()) return {};
  std::lock_guard lock(mutex_);
  stage_times_.collect_idle(push_pool_);
  stage_times_.collect_idle(query_pool_);
  return stage_times_.all();
}

uint64_t StreamGroup::memory_bytes() {
  if (device_.forked()) return 0;
  std::lock_guard lock(mutex_);
  return query_bytes_;
}

namespace {

class DeviceGroup final : public GpuGroup {
 public:
  explicit DeviceGroup(std::shared_ptr<GpuContext> context)
      : group_(context == nullptr ? nullptr : std::make_shared<StreamGroup>(std::move(context))) {}

  Result<void> add(GpuRepresentation& member) override {
    return as_result([&]() -> Result<void> {
      if (group_ == nullptr) return no_context();
      const auto* const fed = dynamic_cast<const StreamFed*>(&member);
      if (fed != nullptr) return group_->add(*fed);
      return Error{ErrorCode::illegal_parameter,
                   "this GpuRepresentation was not made by make_gpu_representation or make_gpu_scarf"};
    });
  }
  Result<void> flush() override { return group_ == nullptr ? as_result(none) : group_->flush(); }
  Result<void> finish() override { return group_ == nullptr ? as_result(none) : group_->finish(); }
  Pending<std::vector<Image<uint8_t>>> u8_images(std::optional<int64_t> now) override {
    if (group_ != nullptr) return group_->u8_images(now);
    return as_result([]() -> Pending<std::vector<Image<uint8_t>>> { return no_context(); });
  }
  std::vector<StageTime> stage_times() const override {
    return group_ == nullptr ? std::vector<StageTime>() : group_->stage_times();
  }
  uint64_t memory_bytes() const override { return group_ == nullptr ? 0 : group_->memory_bytes(); }

 private:
  static Result<void> none() { return no_context(); }

  const std::shared_ptr<StreamGroup> group_;  // null: made without a context
};

}  // namespace

std::unique_ptr<GpuGroup> make_gpu_group(std::shared_ptr<GpuContext> context) {
  return std::make_unique<DeviceGroup>(std::move(context));
}

}  // namespace scarf
