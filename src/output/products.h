// The products of scarf render: pictures, tensors, sparse events.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "output/event_list_writer.h"
#include "output/frame_product.h"
#include "output/frame_writer.h"
#include "output/hdf5_writer.h"
#include "scarf/core/encoding.h"
#include "scarf/core/representation.h"

namespace scarf {

/// A representation, and its title in a mosaic.
struct Shown {
  std::unique_ptr<Representation> representation;
  std::string title;
};

/// 8-bit pictures: of one representation as it is, of several as a mosaic. `shown` outlives the product.
std::unique_ptr<FrameProduct> picture_product(const std::vector<Shown>& shown,
                                              std::unique_ptr<FrameWriter> writer);
/// Pictures of floats, for a writer that takes them.
std::unique_ptr<FrameProduct> float_product(Representation& representation,
                                            std::unique_ptr<FrameWriter> writer);
/// The active events of each frame.
std::unique_ptr<FrameProduct> event_product(Representation& representation,
                                            std::unique_ptr<EventListWriter> writer);
/// An encoding of the active events as a tensor (n, planes, height, width): of a SCARF on a device computed
/// there, of others on the CPU. Errors: illegal_parameter as checked_encoding; io.
Result<std::unique_ptr<FrameProduct>> tensor_product(Representation& representation,
                                                     const EncodingParameters& encoding,
                                                     const std::string& path, const OutputRule& rule);

}  // namespace scarf
