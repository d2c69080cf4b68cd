#include <scree/geometry/number_type.h>
#include <scree/geometry/triangle_readers.h>

#include <limits>

namespace scree
{
namespace
{
/** A property of an element: a number, or a list of them behind its length. */
struct PlyProperty
{
  std::string name;
  NumberType  type      = NumberType::float32;
  bool        is_list   = false;
  NumberType  of_length = NumberType::uint8;
};

struct PlyElement
{
  std::string              name;
  std::size_t              n = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader
{
  enum class Format
  {
    ascii,
    binary_little_endian,
    binary_big_endian
  };

  Format                  format = Format::ascii;
  std::vector<PlyElement> elements;
  std::size_t             data_begin = 0;
};

NumberType
ply_type(const Words &words, const std::string &name)
{
  static const std::map<std::string, NumberType> types
    = {{"char", NumberType::int8},      {"int8", NumberType::int8},
       {"uchar", NumberType::uint8},    {"uint8", NumberType::uint8},
       {"short", NumberType::int16},    {"int16", NumberType::int16},
       {"ushort", NumberType::uint16},  {"uint16", NumberType::uint16},
       {"int", NumberType::int32},      {"int32", NumberType::int32},
       {"uint", NumberType::uint32},    {"uint32", NumberType::uint32},
       {"float", NumberType::float32},  {"float32", NumberType::float32},
       {"double", NumberType::float64}, {"float64", NumberType::float64}};
  const auto type = types.find(name);
  require(type != types.end(), words.where(),
          "'" + name.substr(0, 40) + "' is no type of a PLY file", surface_remedy());
  return type->second;
}

PlyProperty
read_property(Words &words)
{
  PlyProperty property;
  std::string word = words.next();
  if (word == "list")
    {
      property.is_list   = true;
      property.of_length = ply_type(words, words.next());
      word               = words.next();
    }
  property.type = ply_type(words, word);
  property.name = words.next();
  return property;
}

PlyHeader::Format
read_format(Words &words)
{
  const std::string word = words.next();
  if (word == "binary_little_endian")
    return PlyHeader::Format::binary_little_endian;
  if (word == "binary_big_endian")
    return PlyHeader::Format::binary_big_endian;
  require(word == "ascii", words.where(), "'" + word.substr(0, 40) + "' is no format of a PLY file",
          surface_remedy());
  return PlyHeader::Format::ascii;
}

PlyHeader
read_header(Words &words, const std::size_t n_bytes)
{
  PlyHeader   header;
  std::string word = words.next();
  while (word != "end_header")
    {
      require(!word.empty(), words.where(), "the header of the PLY file does not end",
              surface_remedy());
      if (word == "format")
        header.format = read_format(words);
      else if (word == "element")
        {
          const std::string name   = words.next();
          const double      number = words.number();
          require(number >= 0. && number <= n_bytes, words.where(),
                  "the file cannot hold so many elements '" + name.substr(0, 40) + "'",
                  surface_remedy());
          header.elements.push_back({name, static_cast<std::size_t>(number), {}});
        }
      else if (word == "property" && !header.elements.empty())
        header.elements.back().properties.push_back(read_property(words));
      words.skip_line();
      word = words.next();
    }
  words.skip_line();
  header.data_begin = std::min(words.position() + 1, n_bytes);
  return header;
}

/** The numbers behind the header, one after the other. */
class PlyNumbers
{
public:
  PlyNumbers(const std::string &bytes, const std::string &name, Words &words,
             const PlyHeader &header)
      : bytes(bytes)
      , name(name)
      , words(words)
      , is_text(header.format == PlyHeader::Format::ascii)
      , swaps((header.format == PlyHeader::Format::binary_little_endian)
              != machine_is_little_endian())
      , place(header.data_begin)
  {
  }

  double next(const NumberType type)
  {
    if (is_text)
      return words.number();
    const std::size_t size = size_of(type);
    if (size > bytes.size() - place)
      throw UserError(name, "the PLY file ends too early", surface_remedy());
    const double number = number_at(bytes.data() + place, type, swaps);
    place += size;
    return number;
  }

  /** A whole number from 0 to below `end`. */
  std::size_t next_index(const NumberType type, const std::size_t end, const std::string &what)
  {
    const double number = next(type);
    if (!(number >= 0. && number < end && number == std::floor(number)))
      throw UserError(where(), "a " + what + " lies outside 0 to " + std::to_string(end) + " - 1",
                      surface_remedy());
    return static_cast<std::size_t>(number);
  }

  std::string where() const
  {
    return is_text ? words.where() : name + ", byte " + std::to_string(place);
  }

private:
  const std::string &bytes, &name;
  Words             &words;
  const bool         is_text, swaps;
  std::size_t        place;
};

/** Reads a property: a number, or those of a list. */
void
read_values(const PlyProperty &property, const std::size_t n_bytes, PlyNumbers &numbers,
            std::vector<double> &values)
{
  const std::size_t n
    = property.is_list ? numbers.next_index(property.of_length, n_bytes, "length of a list") : 1;
  values.clear();
  for (std::size_t i = 0; i < n; ++i)
    values.push_back(numbers.next(property.type));
}

/** The soup of the elements of a file, one after the other. */
class PlySoup
{
public:
  PlySoup(const std::size_t n_bytes, PlyNumbers &numbers)
      : n_bytes(n_bytes)
      , numbers(numbers)
  {
  }

  void add(const PlyElement &element);

  GrowingSoup growing;

private:
  /** Keeps what counts of `values`: coordinates of a vertex or corners of a face. */
  void take(const PlyProperty &property);

  const std::size_t        n_bytes; // of the file
  PlyNumbers              &numbers;
  std::vector<std::size_t> vertices; // their points
  std::vector<double>      values;   // of a property
  std::array<double, 3>    x = {};   // of an element
  std::vector<std::size_t> face;     // of an element
};

void
PlySoup::take(const PlyProperty &property)
{
  if (property.name.size() == 1 && property.name >= "x" && property.name <= "z" && !values.empty())
    x[property.name[0] - 'x'] = values[0];
  if (property.name != "vertex_indices" && property.name != "vertex_index")
    return;
  for (const double value : values)
    {
      if (!(value >= 0. && value < vertices.size()))
        throw UserError(numbers.where(),
                        "a face names none of the " + std::to_string(vertices.size())
                          + " vertices before it",
                        surface_remedy());
      face.push_back(vertices[static_cast<std::size_t>(value)]);
    }
}

void
PlySoup::add(const PlyElement &element)
{
  x.fill(std::numeric_limits<double>::quiet_NaN());
  face.clear();
  for (const PlyProperty &property : element.properties)
    {
      read_values(property, n_bytes, numbers, values);
      take(property);
    }
  if (element.name == "vertex")
    vertices.push_back(growing.corner(x, [&]() { return numbers.where(); }));
  if (element.name == "face")
    {
      if (face.size() < 3)
        throw UserError(numbers.where(), "a face has fewer than 3 corners", surface_remedy());
      growing.add_face(face);
    }
}
} // namespace

TriangleSoup
read_ply(const std::string &bytes, const std::string &name)
{
  Words           words(bytes, name);
  const PlyHeader header = read_header(words, bytes.size());
  PlyNumbers      numbers(bytes, name, words, header);
  PlySoup         soup(bytes.size(), numbers);
  for (const PlyElement &element : header.elements)
    for (std::size_t i = 0; i < element.n; ++i)
      soup.add(element);
  return soup.growing.soup;
}
} // namespace scree
