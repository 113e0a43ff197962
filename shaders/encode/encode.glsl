// What the stages of the encodings share: events in two buffers, of which only the device knows how many there are,
// and the span of their times.
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "common/invocation.glsl"

layout(std430, binding = 0) readonly buffer First { uvec4 first_part[]; };    // t low, t high, x | y << 16, p
layout(std430, binding = 1) readonly buffer Second { uvec4 second_part[]; };
layout(std430, binding = 2) readonly buffer Total { uint total; };
layout(push_constant) uniform Push { EncodePush pushed; };
EncodePush push = pushed;

uint events() { return min(total, push.most_events); }

uvec4 event_at(uint i) {
  return i < push.first_events ? first_part[i] : second_part[i - push.first_events];
}

bool is_inside(uvec4 event) { return (event.z & 0xFFFF) < push.width && event.z >> 16 < push.height; }

uint pixel_of(uvec4 event) { return (event.z >> 16) * push.width + (event.z & 0xFFFF); }

// ON before OFF, as networks have it.
uint polarity_plane(uvec4 event) { return 1 - (event.w & 1); }

// Microseconds since the smallest time that there is.
uint64_t time_of(uvec4 event) { return packUint2x32(uvec2(event.x, event.y ^ 0x80000000u)); }
