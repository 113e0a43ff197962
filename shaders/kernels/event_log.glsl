// Which events of a buffer are copied to another, in order. Include it after event_log_layout.h. Needs 64-bit integers.
layout(constant_id = 0) const uint kKeep = kKeepInside;

layout(std430, binding = 0) readonly buffer From { uvec4 from[]; };  // t low, t high, x | y << 16, p
layout(std430, binding = 2) readonly buffer Length { uint log_length; };
layout(std430, binding = 3) readonly buffer KeepFrom { uint keep_from[]; };  // per block
layout(push_constant) uniform Push { EventLogPush pushed; };
EventLogPush push = pushed;

uint events_in_buffer() { return kKeep == kKeepInside ? push.events : min(push.events, log_length); }

bool is_kept(uint index) {
  if (kKeep == kKeepSince) {
    const int64_t t = packInt2x32(ivec2(from[index].xy));
    return index >= push.start && t >= packInt2x32(ivec2(push.since_low, push.since_high));
  }
  const uint xy = from[index].z;
  const uint x = xy & 0xFFFF;
  const uint y = xy >> 16;
  if (kKeep == kKeepInside) return x < push.width && y < push.height;
  return index >= keep_from[y / push.block_height * push.block_columns + x / push.block_width];
}
