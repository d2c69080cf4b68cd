#include <scree/geometry/triangle_readers.h>

#include <boost/algorithm/string/predicate.hpp>
#include <cstdint>
#include <cstring>

namespace scree
{
using namespace dealii;

namespace
{
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
                          surface_remedy());
        growing.soup.triangles.push_back({{corners[0], corners[1], corners[2]}});
        corners.clear();
      }
    else if (word != "outer" && word != "loop" && word != "endloop")
      throw UserError(words.where(), "'" + word.substr(0, 40) + "' is no word of an STL file",
                      surface_remedy());
  require(corners.empty(), words.where(), "the file ends within a facet", surface_remedy());
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
                    surface_remedy());
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
            throw UserError(words.where(), "a face has fewer than 3 corners", surface_remedy());
          growing.add_face(face);
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
  else if (bytes.compare(0, 3, "ply") == 0)
    soup = read_ply(bytes, name);
  else if (bytes.size() >= n_header && bytes.size() == n_header + n_record * n_told)
    soup = read_binary_stl(bytes, name, n_told);
  else
    {
      require(bytes.compare(0, 5, "solid") == 0, name,
              "this is no STL file: it neither begins with 'solid' nor has the size of "
                + std::to_string(n_told) + " binary facets",
              surface_remedy());
      soup = read_text_stl(bytes, name);
    }
  require(!soup.triangles.empty(), name, "the file has no facet", surface_remedy());
  return soup;
}
} // namespace scree
