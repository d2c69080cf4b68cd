#pragma once

#include <scree/base/exceptions.h>
#include <scree/geometry/triangle_soup.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

namespace scree
{
/** What to do about a file that cannot be read. */
inline std::string
surface_remedy()
{
  return "write the surface anew, as STL, OBJ or PLY";
}

/** A soup that grows by corners, of which equal ones become one. */
class GrowingSoup
{
public:
  /** The number of a point of finite coordinates. @param where tells its place in the file */
  template <typename Where>
  std::size_t corner(const std::array<double, 3> &x, const Where &where)
  {
    if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]))
      throw UserError(where(), "a coordinate is no finite number", surface_remedy());
    const auto [known, is_new] = numbers.emplace(x, soup.points.size());
    if (is_new)
      soup.points.emplace_back(x[0], x[1], x[2]);
    return known->second;
  }

  /** The triangles of a face of three and more corners, as a fan. */
  void add_face(const std::vector<std::size_t> &corners)
  {
    for (std::size_t i = 2; i < corners.size(); ++i)
      soup.triangles.push_back({{corners[0], corners[i - 1], corners[i]}});
  }

  TriangleSoup soup;

private:
  std::map<std::array<double, 3>, std::size_t> numbers;
};

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
      throw UserError(where(), "'" + word.substr(0, 40) + "' is no number", surface_remedy());
    return result;
  }

  std::string where() const
  {
    return name + ":" + std::to_string(line);
  }

  /** The first byte that is not read. */
  std::size_t position() const
  {
    return place;
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

/** PLY: text or binary, elements vertex and face; faces of more than three corners become fans. */
TriangleSoup read_ply(const std::string &bytes, const std::string &name);
} // namespace scree
