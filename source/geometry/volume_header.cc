#include <scree/base/exceptions.h>
#include <scree/base/text_file.h>
#include <scree/geometry/volume_header.h>

#include <algorithm>
#include <boost/algorithm/string.hpp>
#include <filesystem>

namespace scree
{
namespace
{
constexpr std::size_t longest_header = 1 << 20;

/** A line of a file, from `begin` to before its end of line; `next` begins the one after it. */
struct Line
{
  std::size_t begin, next;
  std::string text;
};

Line
line_at(const std::string &bytes, const std::size_t begin, const std::string &name)
{
  const std::size_t end = std::min(bytes.find('\n', begin), bytes.size());
  require(end < longest_header, name, "the header of the volume does not end", label_remedy());
  return {begin, std::min(end + 1, bytes.size()),
          boost::algorithm::trim_copy(bytes.substr(begin, end - begin))};
}

bool
is_nrrd(const std::string &bytes)
{
  return boost::algorithm::starts_with(bytes, "NRRD000");
}

/** "key: value" until a blank line; "key:=value" and comments are others' affair. */
VolumeHeader
nrrd_header(const std::string &bytes, const std::string &name)
{
  VolumeHeader header{name, {}, 0};
  std::size_t  place = line_at(bytes, 0, name).next;
  while (place < bytes.size())
    {
      const Line line = line_at(bytes, place, name);
      place           = line.next;
      if (line.text.empty())
        break;
      const std::size_t colon = line.text.find(": ");
      if (line.text[0] == '#' || line.text.find(":=") < colon)
        continue;
      require(colon != std::string::npos, name,
              "'" + line.text.substr(0, 40) + "' is no field of a NRRD header", label_remedy());
      std::string key = boost::algorithm::to_lower_copy(line.text.substr(0, colon));
      boost::algorithm::erase_all(key, " ");
      header.fields.push_back(
        {key, boost::algorithm::trim_copy(line.text.substr(colon + 1)), line.begin, line.next});
    }
  header.data_begin = place;
  return header;
}

/** "Key = value"; the last one is ElementDataFile. */
VolumeHeader
meta_image_header(const std::string &bytes, const std::string &name)
{
  VolumeHeader header{name, {}, 0};
  for (std::size_t place = 0; place < bytes.size();)
    {
      const Line line = line_at(bytes, place, name);
      place           = line.next;
      if (line.text.empty())
        continue;
      const std::size_t sign = line.text.find('=');
      require(sign != std::string::npos, name,
              "'" + line.text.substr(0, 40) + "' is no field of a MetaImage header",
              label_remedy());
      const std::string key
        = boost::algorithm::to_lower_copy(boost::algorithm::trim_copy(line.text.substr(0, sign)));
      header.fields.push_back(
        {key, boost::algorithm::trim_copy(line.text.substr(sign + 1)), line.begin, line.next});
      if (key == "elementdatafile")
        {
          header.data_begin = place;
          return header;
        }
    }
  throw UserError(name, "the MetaImage header has no ElementDataFile", label_remedy());
}
} // namespace

const VolumeHeader::Field *
VolumeHeader::find(const std::string &key) const
{
  const auto field
    = std::find_if(fields.begin(), fields.end(), [&](const Field &f) { return f.key == key; });
  return field == fields.end() ? nullptr : &*field;
}

const std::string &
VolumeHeader::value(const std::string &key) const
{
  const Field *field = find(key);
  require(field != nullptr, name, "the header has no field '" + key + "'", label_remedy());
  return field->value;
}

VolumeHeader
volume_header(const std::string &bytes, const std::string &name)
{
  return is_nrrd(bytes) ? nrrd_header(bytes, name) : meta_image_header(bytes, name);
}

bool
has_volume_header(const std::string &bytes)
{
  return is_nrrd(bytes) || boost::algorithm::starts_with(bytes, "ObjectType")
         || boost::algorithm::starts_with(bytes, "NDims");
}

std::string
with_data_attached(const std::string &bytes, const std::string &path,
                   const std::size_t largest_size)
{
  if (!has_volume_header(bytes))
    return bytes;
  const VolumeHeader         header = volume_header(bytes, path);
  const VolumeHeader::Field *field  = header.find(is_nrrd(bytes) ? "datafile" : "elementdatafile");
  if (field == nullptr || boost::algorithm::iequals(field->value, "LOCAL"))
    return bytes;
  require(field->value.find_first_of("% ") == std::string::npos && field->value != "LIST", path,
          "the data are in several files, " + field->value.substr(0, 80),
          "write the volume anew, with its data in one file");
  const auto other = std::filesystem::path(path).parent_path() / field->value;
  require(field->value != "." && !field->value.empty(), path, "the header names no file of data",
          label_remedy());
  const std::string data = read_bytes(other.string(), largest_size, path,
                                      "keep the data beside the header that names them", "labels");
  return is_nrrd(bytes)
           ? bytes.substr(0, field->begin)
               + bytes.substr(field->end, header.data_begin - field->end)
               + (boost::algorithm::ends_with(bytes.substr(0, header.data_begin), "\n\n") ? ""
                                                                                          : "\n")
               + data
           : bytes.substr(0, field->begin) + "ElementDataFile = LOCAL\n" + data;
}
} // namespace scree
