#include <scree/base/exceptions.h>
#include <scree/base/log.h>
#include <scree/geometry/volume_header.h>

#include <boost/algorithm/string.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>
#include <zlib.h>

namespace scree
{
namespace
{
/** Numbers with blanks between them. */
template <typename T>
std::vector<T>
numbers_of(const VolumeHeader &header, const std::string &key, const std::size_t n)
{
  std::istringstream stream(header.value(key));
  std::vector<T>     numbers(n);
  for (T &number : numbers)
    require(static_cast<bool>(stream >> number), header.name,
            "the field '" + key + "' holds no " + std::to_string(n) + " numbers: '"
              + header.value(key).substr(0, 40) + "'",
            label_remedy());
  return numbers;
}

template <typename T>
T
number_of(const VolumeHeader &header, const std::string &key)
{
  return numbers_of<T>(header, key, 1)[0];
}

/** The lengths of pixels, if all of them are told; they must be equal. */
std::optional<double>
common_length(const std::vector<double> &lengths, const std::string &name)
{
  for (const double length : lengths)
    if (!std::isfinite(length) || length <= 0.)
      return {};
  for (const double length : lengths)
    require(std::abs(length - lengths[0]) <= 1e-3 * lengths[0], name,
            "the pixels have sides of different lengths, " + short_number(lengths[0]) + " and "
              + short_number(length),
            "resample the image to squares or cubes");
  return lengths.empty() ? std::optional<double>() : lengths[0];
}

/** Of NRRD: "spacings: 1 1 2" or "space directions: (1,0,0) (0,1,0) (0,0,2)". */
std::optional<double>
nrrd_pixel_size(const VolumeHeader &header)
{
  std::vector<double> lengths;
  const bool          has_directions = header.find("spacedirections") != nullptr;
  if (!has_directions && header.find("spacings") == nullptr)
    return {};
  std::string text = header.value(has_directions ? "spacedirections" : "spacings");
  for (char &c : text)
    if (c == ',')
      c = ' ';
  std::istringstream stream(text);
  std::string        part;
  while (has_directions && std::getline(stream, part, ')'))
    {
      std::istringstream numbers(part.substr(std::min(part.find('(') + 1, part.size())));
      double             square = 0., number;
      while (numbers >> number)
        square += number * number;
      if (!boost::algorithm::trim_copy(part).empty())
        lengths.push_back(std::sqrt(square));
    }
  while (!has_directions && stream >> part)
    lengths.push_back(std::strtod(part.c_str(), nullptr));
  return common_length(lengths, header.name);
}

/** What gzip or zlib packed, n_bytes of it. */
std::string
unpacked(const std::string &bytes, const std::size_t begin, const std::size_t n_bytes,
         const std::string &name)
{
  require_enough_bytes(n_bytes, bytes.size(), name);
  std::string result(n_bytes, '\0');
  z_stream    stream{};
  // 32: it finds out which of the two formats it is.
  bool is_good     = inflateInit2(&stream, 15 + 32) == Z_OK;
  stream.next_in   = reinterpret_cast<Bytef *>(const_cast<char *>(bytes.data() + begin));
  stream.next_out  = reinterpret_cast<Bytef *>(result.data());
  std::size_t left = bytes.size() - begin, wanted = n_bytes;
  while (is_good && wanted > 0)
    {
      constexpr std::size_t most = std::numeric_limits<uInt>::max();
      stream.avail_in            = std::min(left, most);
      stream.avail_out           = std::min(wanted, most);
      const uInt n_in = stream.avail_in, n_out = stream.avail_out;
      const int  status = inflate(&stream, Z_NO_FLUSH);
      left -= n_in - stream.avail_in;
      wanted -= n_out - stream.avail_out;
      is_good = status == Z_OK || (status == Z_STREAM_END && wanted == 0);
    }
  inflateEnd(&stream);
  require(is_good, name, "the compressed labels are damaged or end too early", label_remedy());
  return result;
}

/** Throws UserError unless `n_bytes` follow. */
void
require_bytes_behind(const std::string &bytes, const std::size_t begin, const std::size_t n_bytes,
                     const std::string &name)
{
  require(begin <= bytes.size() && n_bytes <= bytes.size() - begin, name,
          "the file ends too early: of " + std::to_string(n_bytes) + " bytes of labels there are "
            + std::to_string(bytes.size() - std::min(begin, bytes.size())),
          label_remedy());
}

std::vector<std::uint32_t>
labels_of_text(const std::string &bytes, std::size_t place, const std::size_t n,
               const std::string &name)
{
  // A number and a blank each.
  require_bytes_behind(bytes, place, 2 * n - 1, name);
  std::vector<std::uint32_t> labels;
  labels.reserve(n);
  const char *first = bytes.c_str() + place;
  for (std::size_t i = 0; i < n; ++i)
    {
      char        *end    = nullptr;
      const double number = std::strtod(first, &end);
      if (end == first)
        throw UserError(name, "the text ends after " + std::to_string(i) + " labels",
                        label_remedy());
      append_labels(reinterpret_cast<const char *>(&number), 1, NumberType::float64, false, name,
                    labels);
      first = end;
    }
  return labels;
}

/** Where and how a volume holds its numbers. */
struct Numbers
{
  enum class Encoding
  {
    raw,
    packed,
    text
  };

  std::size_t n; //!< how many
  NumberType  type;
  Encoding    encoding       = Encoding::raw;
  bool        is_little      = true; //!< the lowest byte is the first
  std::size_t begin          = 0;    //!< byte of the file
  bool        ends_with_file = false;

  std::vector<std::uint32_t> labels(const std::string &bytes, const std::string &name) const;
};

std::vector<std::uint32_t>
Numbers::labels(const std::string &bytes, const std::string &name) const
{
  const std::size_t n_bytes = n * size_of(type);
  const std::size_t first = ends_with_file ? bytes.size() - std::min(n_bytes, bytes.size()) : begin;
  if (encoding == Encoding::text)
    return labels_of_text(bytes, first, n, name);
  const bool                 swaps = size_of(type) > 1 && is_little != machine_is_little_endian();
  std::vector<std::uint32_t> labels;
  require_bytes_behind(bytes, first, encoding == Encoding::raw ? n_bytes : 0, name);
  if (encoding == Encoding::raw)
    append_labels(bytes.data() + first, n, type, swaps, name, labels);
  else
    append_labels(unpacked(bytes, first, n_bytes, name).data(), n, type, swaps, name, labels);
  return labels;
}

NumberType
type_named(const std::map<std::string, NumberType> &types, const VolumeHeader &header,
           const std::string &key)
{
  const auto type = types.find(boost::algorithm::to_lower_copy(header.value(key)));
  require(type != types.end(), header.name,
          "'" + header.value(key).substr(0, 40) + "' is no type of labels",
          "write them as whole numbers of 8, 16 or 32 bits");
  return type->second;
}

const std::map<std::string, NumberType> nrrd_types = {{"signed char", NumberType::int8},
                                                      {"int8", NumberType::int8},
                                                      {"int8_t", NumberType::int8},
                                                      {"uchar", NumberType::uint8},
                                                      {"unsigned char", NumberType::uint8},
                                                      {"uint8", NumberType::uint8},
                                                      {"uint8_t", NumberType::uint8},
                                                      {"short", NumberType::int16},
                                                      {"short int", NumberType::int16},
                                                      {"signed short", NumberType::int16},
                                                      {"signed short int", NumberType::int16},
                                                      {"int16", NumberType::int16},
                                                      {"int16_t", NumberType::int16},
                                                      {"ushort", NumberType::uint16},
                                                      {"unsigned short", NumberType::uint16},
                                                      {"unsigned short int", NumberType::uint16},
                                                      {"uint16", NumberType::uint16},
                                                      {"uint16_t", NumberType::uint16},
                                                      {"int", NumberType::int32},
                                                      {"signed int", NumberType::int32},
                                                      {"int32", NumberType::int32},
                                                      {"int32_t", NumberType::int32},
                                                      {"uint", NumberType::uint32},
                                                      {"unsigned int", NumberType::uint32},
                                                      {"uint32", NumberType::uint32},
                                                      {"uint32_t", NumberType::uint32},
                                                      {"longlong", NumberType::int64},
                                                      {"long long", NumberType::int64},
                                                      {"int64", NumberType::int64},
                                                      {"int64_t", NumberType::int64},
                                                      {"ulonglong", NumberType::uint64},
                                                      {"unsigned long long", NumberType::uint64},
                                                      {"uint64", NumberType::uint64},
                                                      {"uint64_t", NumberType::uint64},
                                                      {"float", NumberType::float32},
                                                      {"double", NumberType::float64}};

const std::map<std::string, NumberType> meta_image_types
  = {{"met_uchar", NumberType::uint8},       {"met_char", NumberType::int8},
     {"met_ushort", NumberType::uint16},     {"met_short", NumberType::int16},
     {"met_uint", NumberType::uint32},       {"met_int", NumberType::int32},
     {"met_ulong", NumberType::uint32},      {"met_long", NumberType::int32},
     {"met_ulong_long", NumberType::uint64}, {"met_long_long", NumberType::int64},
     {"met_float", NumberType::float32},     {"met_double", NumberType::float64}};

bool
is_true(const VolumeHeader &header, const std::string &key)
{
  const VolumeHeader::Field *field = header.find(key);
  return field != nullptr && boost::algorithm::iequals(field->value, "true");
}

/** Moves the begin of numbers as a field of the header says, -1 to where the file ends with them.
 */
void
skip_bytes(const VolumeHeader &header, const std::string &key, Numbers &numbers)
{
  if (header.find(key) == nullptr)
    return;
  numbers.ends_with_file = header.value(key) == "-1";
  if (!numbers.ends_with_file)
    numbers.begin += number_of<std::uint32_t>(header, key);
}

Numbers::Encoding
nrrd_encoding(const VolumeHeader &header)
{
  const std::string name = boost::algorithm::to_lower_copy(header.value("encoding"));
  if (name == "txt" || name == "text" || name == "ascii")
    return Numbers::Encoding::text;
  if (name == "gz" || name == "gzip")
    return Numbers::Encoding::packed;
  require(name == "raw", header.name, "the encoding '" + name.substr(0, 40) + "' is not read",
          "write raw, gzip or text");
  return Numbers::Encoding::raw;
}

/** The sizes of an array of two or three dimensions. */
std::vector<std::size_t>
sizes_of(const VolumeHeader &header, const std::string &dimension_key, const std::string &size_key)
{
  const auto dimension = number_of<std::size_t>(header, dimension_key);
  require(dimension == 2 || dimension == 3, header.name,
          "the array has dimension " + std::to_string(dimension),
          "write two or three dimensions, and one number for each pixel");
  return numbers_of<std::size_t>(header, size_key, dimension);
}
} // namespace

LabelArray
read_nrrd(const std::string &bytes, const std::string &name)
{
  const VolumeHeader header = volume_header(bytes, name);
  LabelArray         array;
  array.n_pixels   = sizes_of(header, "dimension", "sizes");
  array.pixel_size = nrrd_pixel_size(header);
  Numbers numbers{number_of_pixels(array.n_pixels, name), type_named(nrrd_types, header, "type")};
  numbers.encoding = nrrd_encoding(header);
  numbers.begin    = header.data_begin;
  if (header.find("lineskip") != nullptr)
    for (auto n = number_of<std::size_t>(header, "lineskip"); n > 0 && numbers.begin < bytes.size();
         --n)
      numbers.begin = std::min(bytes.find('\n', numbers.begin), bytes.size() - 1) + 1;
  skip_bytes(header, "byteskip", numbers);
  if (numbers.encoding != Numbers::Encoding::text && size_of(numbers.type) > 1)
    numbers.is_little = !boost::algorithm::iequals(header.value("endian"), "big");
  array.labels = numbers.labels(bytes, name);
  return array;
}

LabelArray
read_meta_image(const std::string &bytes, const std::string &name)
{
  const VolumeHeader header = volume_header(bytes, name);
  require(boost::algorithm::iequals(header.value("elementdatafile"), "LOCAL"), name,
          "the data are in another file", "name the header, which is beside them");
  require(header.find("elementnumberofchannels") == nullptr
            || header.value("elementnumberofchannels") == "1",
          name, "the array has several numbers for each pixel", "write one, its label");
  LabelArray array;
  array.n_pixels = sizes_of(header, "ndims", "dimsize");
  if (header.find("elementspacing") != nullptr)
    array.pixel_size
      = common_length(numbers_of<double>(header, "elementspacing", array.n_pixels.size()), name);
  Numbers numbers{number_of_pixels(array.n_pixels, name),
                  type_named(meta_image_types, header, "elementtype")};
  numbers.begin = header.data_begin;
  skip_bytes(header, "headersize", numbers);
  numbers.is_little
    = !is_true(header, "binarydatabyteordermsb") && !is_true(header, "elementbyteordermsb");
  if (is_true(header, "compresseddata"))
    numbers.encoding = Numbers::Encoding::packed;
  else if (header.find("binarydata") != nullptr && !is_true(header, "binarydata"))
    numbers.encoding = Numbers::Encoding::text;
  array.labels = numbers.labels(bytes, name);
  return array;
}
} // namespace scree
