// The writers behind create_events.
#pragma once

#include <memory>
#include <string>

#include "io/files/output_files.h"
#include "scarf/io/recordings.h"

namespace scarf {

// Each creates the file; "-" is standard output, or refused. The sensor is a legal one. Errors: as
// OutputFile::create.
Result<std::unique_ptr<EventSink>> create_csv(const std::string& path, SensorSize sensor,
                                              const OutputRule& rule);
Result<std::unique_ptr<EventSink>> create_dat(const std::string& path, SensorSize sensor,
                                              const OutputRule& rule);
Result<std::unique_ptr<EventSink>> create_dsec(const std::string& path, SensorSize sensor,
                                               const OutputRule& rule);
Result<std::unique_ptr<EventSink>> create_event_stream(const std::string& path, SensorSize sensor,
                                                       const OutputRule& rule);
Result<std::unique_ptr<EventSink>> create_evt2(const std::string& path, SensorSize sensor,
                                               const OutputRule& rule);
Result<std::unique_ptr<EventSink>> create_evt21(const std::string& path, SensorSize sensor,
                                                const OutputRule& rule);
Result<std::unique_ptr<EventSink>> create_evt3(const std::string& path, SensorSize sensor,
                                               const OutputRule& rule);
Result<std::unique_ptr<EventSink>> create_evt4(const std::string& path, SensorSize sensor,
                                               const OutputRule& rule);
Result<std::unique_ptr<EventSink>> create_npy(const std::string& path, SensorSize sensor,
                                              const OutputRule& rule);
Result<std::unique_ptr<EventSink>> create_text(const std::string& path, SensorSize sensor,
                                               const OutputRule& rule);

}  // namespace scarf
