// SPDX-License-Identifier: MIT
#include "renderer/sensor/mcap.h"

#include <cmath>

#include "renderer/sensor/put_bytes.h"

namespace minkray {
namespace {

/// Kinds of records.
enum class McapRecord : std::uint8_t {
  header = 1,
  footer,
  schema,
  channel,
  message,
  chunk,
  message_index,
  chunk_index,
  statistics = 11,
  data_end = 15
};

constexpr std::string_view mcap_magic("\x89MCAP0\r\n", 8);

/// Definitions of PointCloud2 and of its parts.
constexpr std::string_view point_cloud_schema =
    "std_msgs/Header header\nuint32 height\nuint32 width\nsensor_msgs/PointField[] fields\n"
    "bool is_bigendian\nuint32 point_step\nuint32 row_step\nuint8[] data\nbool is_dense\n"
    "================================================================================\n"
    "MSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n"
    "================================================================================\n"
    "MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n"
    "================================================================================\n"
    "MSG: sensor_msgs/PointField\nuint8 INT8=1\nuint8 UINT8=2\nuint8 INT16=3\nuint8 UINT16=4\n"
    "uint8 INT32=5\nuint8 UINT32=6\nuint8 FLOAT32=7\nuint8 FLOAT64=8\nstring name\n"
    "uint32 offset\nuint8 datatype\nuint32 count\n";

void put_string(FileBytes& bytes, std::string_view text) {
  put(bytes, static_cast<std::uint32_t>(text.size()));
  put_text(bytes, text);
}

void put_record(FileBytes& bytes, McapRecord kind, const FileBytes& content) {
  put(bytes, static_cast<std::uint8_t>(kind));
  put(bytes, static_cast<std::uint64_t>(content.size()));
  bytes.insert(bytes.end(), content.begin(), content.end());
}

/// Writes a message in CDR: numbers are aligned to their size, counted from after the first four
/// bytes.
class CdrWriter {
 public:
  CdrWriter() { put_text(bytes_, std::string_view("\0\1\0\0", 4)); }

  template <class Number>
  void add(const Number& number) {
    while ((bytes_.size() - 4) % sizeof number != 0) bytes_.push_back(0);
    put(bytes_, number);
  }
  void add(std::string_view text) {
    add(static_cast<std::uint32_t>(text.size() + 1));
    put_text(bytes_, text);
    bytes_.push_back(0);
  }
  void add(const FileBytes& sequence) {
    add(static_cast<std::uint32_t>(sequence.size()));
    bytes_.insert(bytes_.end(), sequence.begin(), sequence.end());
  }
  FileBytes take() { return std::move(bytes_); }

 private:
  FileBytes bytes_;
};

struct PointField {
  std::string_view name;
  std::uint32_t offset;
  std::uint8_t type;
};
constexpr std::uint8_t of_int32 = 5, of_uint16 = 4, of_float32 = 7;
constexpr PointField fields_of_points[] = {{"x", 0, of_float32},    {"y", 4, of_float32},
                                           {"z", 8, of_float32},    {"intensity", 12, of_float32},
                                           {"ring", 16, of_uint16}, {"time", 20, of_float32},
                                           {"object", 24, of_int32}};
constexpr std::uint32_t point_step = 28;
static_assert(most_mcap_points == 0xffffffffu / point_step);

FileBytes point_cloud(const ScanOutput& output, std::uint64_t nanoseconds) {
  FileBytes points;
  const auto several = static_cast<std::size_t>(output.returns);
  for (std::size_t i = 0; i < output.scan.echoes.size(); ++i) {
    const Echo& echo = output.scan.echoes[i];
    if (echo.object < 0) continue;
    for (const double x : echo.point) put(points, static_cast<float>(x));
    put(points, static_cast<float>(echo.intensity));
    put(points, static_cast<std::uint16_t>(output.channel_of(i / several)));
    put(points, std::uint16_t{0});
    put(points, static_cast<float>(output.rays.rays[i / several].time));
    put(points, echo.object);
  }
  constexpr std::uint64_t second = 1000000000;
  CdrWriter cdr;
  cdr.add(static_cast<std::int32_t>(nanoseconds / second));
  cdr.add(static_cast<std::uint32_t>(nanoseconds % second));
  cdr.add(std::string_view("map"));
  cdr.add(std::uint32_t{1});
  cdr.add(static_cast<std::uint32_t>(points.size() / point_step));
  cdr.add(static_cast<std::uint32_t>(std::size(fields_of_points)));
  for (const PointField& field : fields_of_points) {
    cdr.add(field.name);
    cdr.add(field.offset);
    cdr.add(field.type);
    cdr.add(std::uint32_t{1});
  }
  cdr.add(std::uint8_t{0});
  cdr.add(point_step);
  cdr.add(static_cast<std::uint32_t>(points.size()));
  cdr.add(points);
  cdr.add(std::uint8_t{1});
  return cdr.take();
}

}  // namespace

std::vector<unsigned char> mcap_of(const ScanOutput& output) {
  const auto time = static_cast<std::uint64_t>(std::llround(1e9 * std::max(0.0, output.start)));
  constexpr std::uint16_t id = 1;
  FileBytes header, schema, channel, message;
  put_string(header, "ros2");
  put_string(header, "minkray");
  put(schema, id);
  put_string(schema, "sensor_msgs/msg/PointCloud2");
  put_string(schema, "ros2msg");
  put_string(schema, point_cloud_schema);
  put(channel, id);
  put(channel, id);
  put_string(channel, "/points");
  put_string(channel, "cdr");
  put(channel, std::uint32_t{0});  // no metadata
  put(message, id);
  put(message, std::uint32_t{0});
  put(message, time);
  put(message, time);
  const FileBytes cdr = point_cloud(output, time);
  message.insert(message.end(), cdr.begin(), cdr.end());

  FileBytes records;
  put_record(records, McapRecord::schema, schema);
  put_record(records, McapRecord::channel, channel);
  const auto place = static_cast<std::uint64_t>(records.size());
  put_record(records, McapRecord::message, message);
  FileBytes chunk;
  put(chunk, time);
  put(chunk, time);
  put(chunk, static_cast<std::uint64_t>(records.size()));
  put(chunk, std::uint32_t{0});  // no checksum
  put_string(chunk, "");         // nor compression
  put(chunk, static_cast<std::uint64_t>(records.size()));
  chunk.insert(chunk.end(), records.begin(), records.end());

  FileBytes bytes;
  put_text(bytes, mcap_magic);
  put_record(bytes, McapRecord::header, header);
  const auto chunk_begin = static_cast<std::uint64_t>(bytes.size());
  put_record(bytes, McapRecord::chunk, chunk);
  const auto index_begin = static_cast<std::uint64_t>(bytes.size());
  FileBytes index;
  put(index, id);
  put(index, std::uint32_t{16});
  put(index, time);
  put(index, place);
  put_record(bytes, McapRecord::message_index, index);
  const auto index_end = static_cast<std::uint64_t>(bytes.size());
  put_record(bytes, McapRecord::data_end, FileBytes(4));

  const auto summary = static_cast<std::uint64_t>(bytes.size());
  put_record(bytes, McapRecord::schema, schema);
  put_record(bytes, McapRecord::channel, channel);
  FileBytes statistics;
  put(statistics, std::uint64_t{1});
  put(statistics, id);
  for (const std::uint32_t count : {1, 0, 0, 1}) put(statistics, count);
  put(statistics, time);
  put(statistics, time);
  put(statistics, std::uint32_t{10});
  put(statistics, id);
  put(statistics, std::uint64_t{1});
  put_record(bytes, McapRecord::statistics, statistics);
  FileBytes chunk_index;
  put(chunk_index, time);
  put(chunk_index, time);
  put(chunk_index, chunk_begin);
  put(chunk_index, index_begin - chunk_begin);
  put(chunk_index, std::uint32_t{10});
  put(chunk_index, id);
  put(chunk_index, index_begin);
  put(chunk_index, index_end - index_begin);
  put_string(chunk_index, "");
  put(chunk_index, static_cast<std::uint64_t>(records.size()));
  put(chunk_index, static_cast<std::uint64_t>(records.size()));
  put_record(bytes, McapRecord::chunk_index, chunk_index);
  FileBytes footer;
  put(footer, summary);
  put(footer, std::uint64_t{0});
  put(footer, std::uint32_t{0});
  put_record(bytes, McapRecord::footer, footer);
  put_text(bytes, mcap_magic);
  return bytes;
}

}  // namespace minkray
