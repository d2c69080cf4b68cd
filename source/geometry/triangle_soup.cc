#include <scree/base/exceptions.h>
#include <scree/geometry/triangle_soup.h>

#include <algorithm>
#include <boost/algorithm/string/predicate.hpp>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <map>

namespace scree
{
using namespace dealii;

namespace
{
const std::string surface_remedy = "write the surface anew, as STL or OBJ";

/** A soup that grows by corners, of which equal ones become one. */
class GrowingSoup
{
public:
  /** The number of a point of finite coordinates. @param where tells its place in the file */
  template <typename Where>
  std::size_t corner(const std::array<double, 3> &x, const Where &where)
  {
    if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]))
      throw UserError(where(), "a coordinate is no finite number", surface_remedy);
    const auto [known, is_new] = numbers.emplace(x, soup.points.size());
    if (is_new)
      soup.points.emplace_back(x[0], x[1], x[2]);
    return known->second;
  }

  TriangleSoup soup;

private:
  std::map<std::array<double, 3>, std::size_t> numbers;
};

TriangleSoup
read_binary_stl(const std::string &bytes, const std::string &name, const std::size_t n)
{
  GrowingSoup           growing;
  constexpr std::size_t n_header = 84, n_record = 50, n_normal = 12;
  for (std::size_t t = 0; t < n; ++t)
    {
      std::array<float, 9> numbers;
      std::memcpy(numbers.data(), bytes.data() + n_header + t * n_record + n_normal,
                  sizeof numbers);
      TriangleSoup::Triangle triangle;
      for (unsigned int c = 0; c < 3; ++c)
        triangle[c] = growing.corner({{numbers[3 * c], numbers[3 * c + 1], numbers[3 * c + 2]}},
                                     [&]() { return name + ", facet " + std::to_string(t + 1); });
      growing.soup.triangles.push_back(triangle);
    }
  return growing.soup;
}

/** The words of a text, line by line. */
class Words
{
public:
  Words(const std::string &text, const std::string &name)
      : text(text)
      , name(name)
  {
  }

  /** The next word; empty at the end. */
  std::string next()
  {
    while (place < text.size() && is_space(text[place]))
      line += text[place++] == '\n';
    const std::size_t first = place;
    while (place < text.size() && !is_space(text[place]))
      ++place;
    return text.substr(first, place - first);
  }

  void skip_line()
  {
    place = std::min(text.find('\n', place), text.size());
  }

  /** Whether another word stands on this line. */
  bool line_goes_on()
  {
    while (place < text.size() && text[place] != '\n' && is_space(text[place]))
      ++place;
    return place < text.size() && text[place] != '\n';
  }

  double number()
  {
    const std::string word   = next();
    char             *end    = nullptr;
    const double      result = std::strtod(word.c_str(), &end);
    if (word.empty() || *end != '\0')
      throw UserError(where(), "'" + word.substr(0, 40) + "' is no number", surface_remedy);
    return result;
  }

  std::string where() const
  {
    return name + ":" + std::to_string(line);
  }

private:
  static bool is_space(const char c)
  {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v';
  }

  const std::string &text;
  const std::string  name;
  std::size_t        place = 0, line = 1;
};

TriangleSoup
read_text_stl(const std::string &bytes, const std::string &name)
{
  GrowingSoup              growing;
  Words                    words(bytes, name);
  std::vector<std::size_t> corners;
  for (std::string word = words.next(); !word.empty(); word = words.next())
    if (word == "solid" || word == "endsolid" || word == "facet")
      words.skip_line();
    else if (word == "vertex")
      {
        std::array<double, 3> x;
        for (double &coordinate : x)
          coordinate = words.number();
        corners.push_back(growing.corner(x, [&]() { return words.where(); }));
      }
    else if (word == "endfacet")
      {
        if (corners.size() != 3)
          throw UserError(words.where(),
                          "a facet has " + std::to_string(corners.size()) + " vertices, not 3",
                          surface_remedy);
        growing.soup.triangles.push_back({{corners[0], corners[1], corners[2]}});
        corners.clear();
      }
    else if (word != "outer" && word != "loop" && word != "endloop")
      throw UserError(words.where(), "'" + word.substr(0, 40) + "' is no word of an STL file",
                      surface_remedy);
  require(corners.empty(), words.where(), "the file ends within a facet", surface_remedy);
  return growing.soup;
}

/** The vertex that a corner of an OBJ file names, "3", "-1" or "3/1/2". */
std::size_t
vertex_of(const std::string &word, const std::size_t n_vertices, const Words &words)
{
  char      *end    = nullptr;
  const long number = std::strtol(word.c_str(), &end, 10);
  const long vertex = number < 0 ? static_cast<long>(n_vertices) + number : number - 1;
  if (end == word.c_str() || (*end != '\0' && *end != '/') || vertex < 0
      || static_cast<std::size_t>(vertex) >= n_vertices)
    throw UserError(words.where(),
                    "'" + word.substr(0, 40) + "' names none of the " + std::to_string(n_vertices)
                      + " vertices before it",
                    surface_remedy);
  return vertex;
}

TriangleSoup
read_obj(const std::string &bytes, const std::string &name)
{
  GrowingSoup              growing;
  Words                    words(bytes, name);
  std::vector<std::size_t> vertices; // their points
  for (std::string word = words.next(); !word.empty(); word = words.next())
    {
      if (word == "v")
        {
          std::array<double, 3> x;
          for (double &coordinate : x)
            coordinate = words.number();
          vertices.push_back(growing.corner(x, [&]() { return words.where(); }));
        }
      else if (word == "f")
        {
          std::vector<std::size_t> face;
          while (words.line_goes_on())
            face.push_back(vertices[vertex_of(words.next(), vertices.size(), words)]);
          if (face.size() < 3)
            throw UserError(words.where(), "a face has fewer than 3 corners", surface_remedy);
          for (std::size_t i = 2; i < face.size(); ++i)
            growing.soup.triangles.push_back({{face[0], face[i - 1], face[i]}});
        }
      words.skip_line();
    }
  return growing.soup;
}

} // namespace

TriangleSoup
TriangleSoup::read(const std::string &bytes, const std::string &name)
{
  constexpr std::size_t n_header = 84, n_record = 50;
  std::uint32_t         n_told = 0;
  if (bytes.size() >= n_header)
    std::memcpy(&n_told, bytes.data() + 80, sizeof n_told);
  TriangleSoup soup;
  if (boost::algorithm::ends_with(name, ".obj") || boost::algorithm::ends_with(name, ".OBJ"))
    soup = read_obj(bytes, name);
  else if (bytes.size() >= n_header && bytes.size() == n_header + n_record * n_told)
    soup = read_binary_stl(bytes, name, n_told);
  else
    {
      require(bytes.compare(0, 5, "solid") == 0, name,
              "this is no STL file: it neither begins with 'solid' nor has the size of "
                + std::to_string(n_told) + " binary facets",
              surface_remedy);
      soup = read_text_stl(bytes, name);
    }
  require(!soup.triangles.empty(), name, "the file has no facet", surface_remedy);
  return soup;
}
} // namespace scree
