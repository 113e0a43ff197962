// The tiles whose lists hold an event.
layout(push_constant) uniform Push { TileListsPush pushed; };
TileListsPush push = pushed;

struct Tiles {
  uint left;  // columns left .. right and rows top .. bottom of tiles
  uint right;
  uint top;
  uint bottom;
};

bool is_inside(uint xy) { return (xy & 0xFFFF) < push.width && xy >> 16 < push.height; }

// Of an event inside the sensor.
Tiles tiles_of(uint xy) {
  const uint x = xy & 0xFFFF;
  const uint y = xy >> 16;
  return Tiles((x - min(x, push.halo)) / push.tile, min((x + push.halo) / push.tile, push.tiles_x - 1),
               (y - min(y, push.halo)) / push.tile, min((y + push.halo) / push.tile, push.tiles_y - 1));
}

// Whether the list of a tile holds an event inside the sensor.
bool holds(uint column, uint row, uint xy) {
  // Differences below zero wrap to large numbers.
  const uint x = (xy & 0xFFFF) - (column * push.tile - push.halo);
  const uint y = (xy >> 16) - (row * push.tile - push.halo);
  return x < push.tile + 2 * push.halo && y < push.tile + 2 * push.halo;
}
